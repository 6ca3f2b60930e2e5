/* SPDX-License-Identifier: MIT */
/// @file
/// The levers of the functional joint. See functional/levers.h.
#include "functional/levers.h"

#include "levers/levers.h"
#include "math/scalar.h"

#include <float.h>

/// Share of the mean diagonal that keeps directions in which nothing turned at zero.
#define RIDGE 0.005f

void jcal_functional_levers(const jcal_functional_sums_t *sums, const float *x, jcal_functional_point_t *point)
{
    const jcal_levers_t found = jcal_levers_solve(&sums->levers, x, RIDGE);
    point->r1 = found.r1;
    point->r2 = found.r2;
    point->lack = found.lack;
    point->speed2 = found.own / jcal_max(sums->motion_s, FLT_MIN);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Where the joint's centre is, for headings that are given: a linear problem of six unknowns. Private.
#ifndef JCAL_FUNCTIONAL_LEVERS_H
#define JCAL_FUNCTIONAL_LEVERS_H

#include "jointcal/private/functional/point.h"
#include "jointcal/private/functional/sums.h"

/// r1, r2, lack and speed2 of `point` <- the levers that leave least, with X (4 x 4) of the lever residual (levers/levers.h).
void jcal_functional_levers(const jcal_functional_sums_t *sums, const float *x, jcal_functional_point_t *point);

#endif /* JCAL_FUNCTIONAL_LEVERS_H */

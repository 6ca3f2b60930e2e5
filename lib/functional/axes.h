/* SPDX-License-Identifier: MIT */
/// @file
/// The axes for headings and relative turns that are given, and how large each kind of residual is. Private.
#ifndef JCAL_FUNCTIONAL_AXES_H
#define JCAL_FUNCTIONAL_AXES_H

#include "jointcal/private/functional/point.h"
#include "jointcal/private/functional/sums.h"
#include "math/sphere.h"
#include "math/sym.h"

#include <stdbool.h>

/// Cost of the axes: j' H j / 2 of j = [j1; j2], blocks of H.
typedef struct {
    float h11[6], h22[6];  ///< Packed.
    float h12[9];
} jcal_functional_quadric_t;

/// Cross products of the two kinds of residuals that hold axes: X of turn and of rate (3 x 3).
typedef struct {
    float turn[9], rate[9];
} jcal_functional_cross_t;

/// X of both with the headings and relative turns of `point`. Cost: 230 multiply-adds.
void jcal_functional_cross(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point,
                           jcal_functional_cross_t *out);

/// Residuals that are independent of each other, of each kind, per second of motion.
extern const float jcal_functional_rows_per_s[JCAL_FAMILIES];

/// size, weight and energy of `point` at its axes, lack and the given X.
void jcal_functional_measure(const jcal_functional_sums_t *sums, const jcal_functional_cross_t *x,
                             jcal_functional_point_t *point);

/// H with the weights of `point`.
void jcal_functional_quadric(const jcal_functional_sums_t *sums, const jcal_functional_cross_t *x,
                             const jcal_functional_point_t *point, jcal_functional_quadric_t *out);

/// Second derivative of the cost along the tangents of both axes (4 x 4, packed; j1's first), without what the spheres' bend takes
/// off it if `bend` is false; slope (4) <- the first derivative.
void jcal_functional_tangent_hessian(const jcal_functional_quadric_t *h, const jcal_vec3_t j[2], bool bend,
                                     float *hessian, float *slope);

/// One Newton step of both axes on their spheres, at most 0.4 rad long. Cost: about 250 multiply-adds.
void jcal_functional_step_axes(const jcal_functional_quadric_t *h, jcal_vec3_t *j1, jcal_vec3_t *j2);

/// j1, j2 <- the number `which` (0 or 1) of the two directions that H knows least, each part brought to unit length.
///
/// Returns:  false if a part has no direction; the axes are untouched then.
/// Cost:     about 600 multiply-adds.
bool jcal_functional_open_axes(const jcal_functional_quadric_t *h, unsigned which, jcal_vec3_t *j1, jcal_vec3_t *j2);

#endif /* JCAL_FUNCTIONAL_AXES_H */

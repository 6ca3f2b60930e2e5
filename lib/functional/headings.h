/* SPDX-License-Identifier: MIT */
/// @file
/// Heading and relative turn of a block, for axes and levers that are given. Private.
#ifndef JCAL_FUNCTIONAL_HEADINGS_H
#define JCAL_FUNCTIONAL_HEADINGS_H

#include "jointcal/private/functional/point.h"
#include "jointcal/private/functional/sums.h"

#include <stddef.h>

/// How far a relative turn may be from its heading: 1 / (2 sigma^2), sigma = 4 deg.
#define JCAL_FUNCTIONAL_TILT_WEIGHT 102.586f

/// A block with less motion than this, s, keeps the heading that it began with.
#define JCAL_FUNCTIONAL_BLOCK_MIN_S 1e-3f

/// What one block says of its relative turn: D' (M + Rz / (2 sigma^2)), whose symmetric part is the second derivative.
typedef struct {
    float m[9];  ///< M: rates of both sensors across the axes, weighted.
    float n[9];  ///< D' (M + weight Rz).
} jcal_functional_grip_t;

/// M and D' (M + weight Rz) of block `b` at `point`. Cost: 150 multiply-adds.
void jcal_functional_grip(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                          jcal_functional_grip_t *out);

/// The same from the rates across j1 (jcal_functional_left_rates). Cost: 55 multiply-adds.
void jcal_functional_grip_left(const jcal_functional_point_t *point, size_t b, const float *left,
                               jcal_functional_grip_t *out);

/// tr(N) I - sym N (3 x 3, packed): second derivative of -tr(D' M) for turns about the axes of L2.
void jcal_functional_turn_hessian(const float *n, float *out);

/// (N23 - N32, N31 - N13, N12 - N21): first derivative of -tr(D' M), N = D' M.
void jcal_functional_turn_slope(const float *n, float *out);

/// The pull of turn and lever residuals of block `b` on its heading: their share of the cost is -Re(heading pull).
jcal_plane_t jcal_functional_turn_pull(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point,
                                       size_t b);
jcal_plane_t jcal_functional_lever_pull(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point,
                                        size_t b);

/// Heading and relative turn of block `b` of `point` <- the best for its axes and levers: the heading in closed form, the turn by one
/// Newton step. Cost: about 330 multiply-adds.
void jcal_functional_find_heading(const jcal_functional_sums_t *sums, jcal_functional_point_t *point, size_t b);

/// All headings turn by `by`, and the relative turns are their headings again.
void jcal_functional_turn_all(jcal_functional_point_t *point, jcal_plane_t by);

#endif /* JCAL_FUNCTIONAL_HEADINGS_H */

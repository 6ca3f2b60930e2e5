/* SPDX-License-Identifier: MIT */
/// @file
/// The sums seen from a solution: with headings and relative turns put in, they are small matrices. Private.
///
/// The three residuals of the functional joint, with x = [1; -r]:
///     turn:   R1 j1 - Rz(heading) R2 j2            the axis is one direction in space
///     rate:   Q1 j1 - D Q2 j2                      and so is how it moves, below 5 Hz; D is any rotation near Rz
///     lever:  [U1 B1] x1 - Rz(heading) [U2 B2] x2  the joint's centre has one velocity, 0.4 to 3 Hz
/// Each sum of squares is x1' S11 x1 + x2' S22 x2 - 2 x1' X x2; this makes X.
/// Source: docs/METHOD_PEOPLE.md, section 2.
#ifndef JCAL_FUNCTIONAL_MODEL_H
#define JCAL_FUNCTIONAL_MODEL_H

#include "jointcal/private/functional/point.h"
#include "jointcal/private/functional/sums.h"

#include <stddef.h>

/// out (3 x 3) <- out + sum of the horizontal rows of the products `rate` (9 x 9), turned by a heading. Cost: 54 multiply-adds.
void jcal_functional_level_rates(float *out, const float *rate, jcal_plane_t heading);

/// out (3 x 3) <- out + sum over a, b of turn[a][b] rate[a][.][b][.]. Cost: 81 multiply-adds.
void jcal_functional_free_rates(float *out, const float *rate, const float *turn);

/// out (3 x 3) <- the products of vertical rows of spin of merged blocks alone.
void jcal_functional_old_rate_up(const jcal_functional_sums_t *sums, float *out);

/// X of the first two residuals with the headings and relative turns of `point`: (3 x 3). That of the third: levers/levers.h.
void jcal_functional_cross_turn(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, float *x);
void jcal_functional_cross_rate(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, float *x);

/// X of the rate residual with D = Rz(heading).
void jcal_functional_cross_level(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, float *x);

/// out (3 x 3) <- Rz of a heading, row-major.
void jcal_functional_about_z(jcal_plane_t heading, float *out);

/// a' M b, M (3 x 3).
float jcal_functional_between(const float *m, jcal_vec3_t a, jcal_vec3_t b);

/// M' a, M (3 x 3).
jcal_vec3_t jcal_functional_times_left(const float *m, jcal_vec3_t a);

/// S v, S (3 x 3, packed).
jcal_vec3_t jcal_functional_times_packed(const float *s, jcal_vec3_t v);

/// out <- a' b, all (3 x 3).
void jcal_functional_times_transposed(const float *a, const float *b, float *out);

/// out (3 x 3) <- scale times the rates across j1 and j2: rate[a][.][b][.] between j1 and j2. Cost: 108 multiply-adds.
void jcal_functional_between_rates(const float *rate, jcal_vec3_t j1, jcal_vec3_t j2, float scale, float *out);

/// The same in two parts, for axes that share one of them: out (3 x 3 x 3) <- scale times rate[a][.][b][k] with j1, 81 multiply-adds;
/// out (3 x 3) <- that with j2, 27 multiply-adds.
void jcal_functional_left_rates(const float *rate, jcal_vec3_t j1, float scale, float *out);
void jcal_functional_right_rates(const float *left, jcal_vec3_t j2, float *out);

/// Mean squares of the turn and rate residuals at axes, without floors, given X.
float jcal_functional_turn_size(const jcal_functional_sums_t *sums, const float *x, jcal_vec3_t j1, jcal_vec3_t j2);
float jcal_functional_rate_size(const jcal_functional_sums_t *sums, const float *x, jcal_vec3_t j1, jcal_vec3_t j2);

#endif /* JCAL_FUNCTIONAL_MODEL_H */

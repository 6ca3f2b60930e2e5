/* SPDX-License-Identifier: MIT */
/// @file
/// Residuals of [OLS20] (24), (25) and their derivatives on the tangent planes of the two axes.
///
/// With (u, v, j) orthonormal the rate across the axis is w x j, and |w x j|^2 = (u.w)^2 + (v.w)^2: no cross product,
/// and no cancellation when w is nearly parallel to j.
#ifndef JCAL_HINGE_RESIDUAL_H
#define JCAL_HINGE_RESIDUAL_H

#include "jointcal/vec3.h"
#include "math/sphere.h"

#include <float.h>
#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/// An axis with the tangent basis at its place.
typedef struct {
    jcal_vec3_t j;
    jcal_tangent_t t;
} jcal_hinge_frame_t;

static inline jcal_hinge_frame_t jcal_hinge_frame(jcal_vec3_t j)
{
    const jcal_hinge_frame_t frame = {j, jcal_sphere_tangent(j)};
    return frame;
}

/// |w x j| and its derivative by the two tangent coordinates.
///
/// (37): d|w x j| / dj = (w x j) x w / |w x j| = (j |w|^2 - w (w.j)) / |w x j|. T^T j = 0, so on the tangent plane
/// -(w.j) T^T w / |w x j|. Its length is |w.j| whatever |w x j| is; at w x j = 0, where it jumps, it is taken as zero.
static inline float jcal_hinge_rate_across(const jcal_hinge_frame_t *frame, jcal_vec3_t w, float derivative[2])
{
    const float p = jcal_vec3_dot(frame->t.u, w);
    const float q = jcal_vec3_dot(frame->t.v, w);
    const float across = sqrtf((p * p) + (q * q));
    const float scale = (across > 0.0f) ? (-jcal_vec3_dot(frame->j, w) / across) : 0.0f;
    derivative[0] = scale * p;
    derivative[1] = scale * q;
    return across;
}

/// e_w of (24) without its weight, rad/s, and its derivative (4) by the tangent coordinates of both axes.
static inline float jcal_hinge_gyr_residual(const jcal_hinge_frame_t frames[2], const float w[6], float derivative[4])
{
    const float across1 = jcal_hinge_rate_across(&frames[0], jcal_vec3(w[0], w[1], w[2]), &derivative[0]);
    const float across2 = jcal_hinge_rate_across(&frames[1], jcal_vec3(w[3], w[4], w[5]), &derivative[2]);
    derivative[2] = -derivative[2];
    derivative[3] = -derivative[3];
    return across1 - across2;
}

/// e_a of (25) without its weight, m/s^2; the row is (a1, -a2) as in (53). The paper prints sensor 1 twice.
static inline float jcal_hinge_acc_residual(const jcal_vec3_t j[2], const float a[6])
{
    return jcal_vec3_dot(j[0], jcal_vec3(a[0], a[1], a[2])) + jcal_vec3_dot(j[1], jcal_vec3(a[3], a[4], a[5]));
}

/// A move of one axis, prepared for changes without cancellation.
typedef struct {
    jcal_vec3_t from;
    jcal_vec3_t to;
    jcal_vec3_t less;  ///< to - from
    jcal_vec3_t plus;  ///< to + from
} jcal_hinge_move_t;

/// The move between two unit vectors. For exact ones (to - from).(to + from) = 0; the part of `less` along `plus` is
/// the rounding of their lengths, worth as much as a step of 1e-6 rad, and is taken out.
static inline jcal_hinge_move_t jcal_hinge_move(jcal_vec3_t from, jcal_vec3_t to)
{
    const jcal_vec3_t less = jcal_vec3_sub(to, from);
    const jcal_vec3_t plus = jcal_vec3_add(to, from);
    const float square = jcal_vec3_dot(plus, plus);
    const float along = (square > FLT_EPSILON) ? (jcal_vec3_dot(less, plus) / square) : 0.0f;
    const jcal_hinge_move_t move = {from, to, jcal_vec3_sub(less, jcal_vec3_scale(plus, along)), plus};
    return move;
}

/// |w x to| - |w x from| without cancellation; *before is |w x from|.
///
/// |w x j|^2 = |w|^2 - (w.j)^2, so the difference of squares is -(w.(to - from)) (w.(to + from)).
static inline float jcal_hinge_rate_change(const jcal_hinge_move_t *move, jcal_vec3_t w, float *before)
{
    const float norm_from = jcal_vec3_norm(jcal_vec3_cross(w, move->from));
    const float sum = norm_from + jcal_vec3_norm(jcal_vec3_cross(w, move->to));
    *before = norm_from;
    return (sum > 0.0f) ? (-jcal_vec3_dot(w, move->less) * jcal_vec3_dot(w, move->plus) / sum) : 0.0f;
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_RESIDUAL_H */

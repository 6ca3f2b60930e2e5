/* SPDX-License-Identifier: MIT */
/// @file
/// Headings of the functional joint. See functional/headings.h.
#include "functional/headings.h"

#include "functional/model.h"
#include "jointcal/quat.h"
#include "levers/levers.h"
#include "math/chol_small.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>

/// A relative turn moves by at most this in one step, rad.
#define TURN_STEP_MAX 0.3f

/// M of block b: rates of both sensors across the axes, weighted.
static void grip_rates(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b, float *m)
{
    const float scale = point->weight[JCAL_FAMILY_RATE] / jcal_max(sums->rate2, FLT_MIN);
    jcal_functional_between_rates(sums->block[b].rate, point->j1, point->j2, scale, m);
}

/// n <- D' (M + weight Rz).
static void grip_turn(const jcal_functional_point_t *point, size_t b, const float *m, float *n)
{
    const float re = JCAL_FUNCTIONAL_TILT_WEIGHT * point->heading[b].re;
    const float im = JCAL_FUNCTIONAL_TILT_WEIGHT * point->heading[b].im;
    const float pulled[9] = {
        m[0] + re, m[1] - im, m[2], m[3] + im, m[4] + re, m[5], m[6], m[7], m[8] + JCAL_FUNCTIONAL_TILT_WEIGHT};
    jcal_functional_times_transposed(point->turn[b], pulled, n);
}

void jcal_functional_grip(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                          jcal_functional_grip_t *out)
{
    grip_rates(sums, point, b, out->m);
    grip_turn(point, b, out->m, out->n);
}

void jcal_functional_grip_left(const jcal_functional_point_t *point, size_t b, const float *left,
                               jcal_functional_grip_t *out)
{
    jcal_functional_right_rates(left, point->j2, out->m);
    grip_turn(point, b, out->m, out->n);
}

void jcal_functional_turn_hessian(const float *n, float *out)
{
    out[0] = n[4] + n[8];
    out[1] = -0.5f * (n[1] + n[3]);
    out[2] = n[0] + n[8];
    out[3] = -0.5f * (n[2] + n[6]);
    out[4] = -0.5f * (n[5] + n[7]);
    out[5] = n[0] + n[4];
}

void jcal_functional_turn_slope(const float *n, float *out)
{
    out[0] = n[5] - n[7];
    out[1] = n[6] - n[2];
    out[2] = n[1] - n[3];
}

jcal_plane_t jcal_functional_turn_pull(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point,
                                       size_t b)
{
    const float scale = point->weight[JCAL_FAMILY_TURN] / jcal_max(sums->motion_s, FLT_MIN);
    const jcal_plane_t out = {scale * jcal_functional_between(sums->block[b].turn_re, point->j1, point->j2),
                              scale * jcal_functional_between(sums->block[b].turn_im, point->j1, point->j2)};
    return out;
}

jcal_plane_t jcal_functional_lever_pull(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point,
                                        size_t b)
{
    const float scale = point->weight[JCAL_FAMILY_LEVER] / jcal_max(sums->motion_s, FLT_MIN);
    const jcal_plane_t pull = jcal_levers_pull(&sums->levers, b, point->r1, point->r2);
    const jcal_plane_t out = {scale * pull.re, scale * pull.im};
    return out;
}

/// D <- D exp([turn]x), the exponential by the quaternion (1, turn / 2): exact to third order, and D stays a rotation.
static void turn_by(float *d, const float *turn)
{
    const jcal_quat_t q = jcal_quat_normalise(jcal_quat(1.0f, 0.5f * turn[0], 0.5f * turn[1], 0.5f * turn[2]));
    for (size_t i = 0u; i < 3u; ++i) { /* rows of D: (D E)' = E' D' */
        const jcal_vec3_t row =
            jcal_quat_rotate(jcal_quat_conj(q), jcal_vec3(d[3u * i], d[(3u * i) + 1u], d[(3u * i) + 2u]));
        d[3u * i] = row.x;
        d[(3u * i) + 1u] = row.y;
        d[(3u * i) + 2u] = row.z;
    }
}

/// Rows of D <- orthonormal again, after many turns.
static void tidy(float *d)
{
    const jcal_vec3_t x = jcal_vec3_normalise(jcal_vec3(d[0], d[1], d[2]));
    const jcal_vec3_t z = jcal_vec3_normalise(jcal_vec3_cross(x, jcal_vec3(d[3], d[4], d[5])));
    const jcal_vec3_t y = jcal_vec3_cross(z, x);
    const float rows[9] = {x.x, x.y, x.z, y.x, y.y, y.z, z.x, z.y, z.z};
    for (size_t i = 0u; i < 9u; ++i) {
        d[i] = rows[i];
    }
}

/// D <- Rz(by) D.
static void follow(float *d, jcal_plane_t by)
{
    for (size_t k = 0u; k < 3u; ++k) {
        const float x = d[k];
        const float y = d[3u + k];
        d[k] = (by.re * x) - (by.im * y);
        d[3u + k] = (by.im * x) + (by.re * y);
    }
}

/// One Newton step of the relative turn of block b, with its M.
static void step_turn(jcal_functional_point_t *point, size_t b, const float *m)
{
    float n[9];
    float hessian[JCAL_SYM_SIZE(3u)];
    float turn[3];
    grip_turn(point, b, m, n);
    jcal_functional_turn_hessian(n, hessian);
    jcal_functional_turn_slope(n, turn);
    if (!jcal_chol3_factor(hessian)) {
        jcal_functional_about_z(point->heading[b], point->turn[b]); /* far from a minimum: what the heading says */
        return;
    }
    jcal_chol3_solve(hessian, turn);
    const float length2 = (turn[0] * turn[0]) + (turn[1] * turn[1]) + (turn[2] * turn[2]);
    const float scale = (length2 > (TURN_STEP_MAX * TURN_STEP_MAX)) ? (-TURN_STEP_MAX / sqrtf(length2)) : -1.0f;
    for (size_t i = 0u; i < 3u; ++i) {
        turn[i] *= scale;
    }
    turn_by(point->turn[b], turn);
    tidy(point->turn[b]);
}

void jcal_functional_find_heading(const jcal_functional_sums_t *sums, jcal_functional_point_t *point, size_t b)
{
    if (!(sums->block[b].motion_s > JCAL_FUNCTIONAL_BLOCK_MIN_S)) {
        return;
    }
    float m[9];
    grip_rates(sums, point, b, m); /* knows nothing of heading and turn */
    /* The turn E = Rz' D of the block held, D = Rz E follows the heading: tr(D' M) = tr(Rz' N), N = M E' = M D' Rz. */
    const jcal_plane_t was = point->heading[b];
    float n[4]; /* upper left of M D' */
    const float *const d = point->turn[b];
    for (size_t i = 0u; i < 2u; ++i) {
        const float *const row = &m[3u * i];
        n[2u * i] = (row[0] * d[0]) + (row[1] * d[1]) + (row[2] * d[2]);
        n[(2u * i) + 1u] = (row[0] * d[3]) + (row[1] * d[4]) + (row[2] * d[5]);
    }
    const jcal_plane_t rate = jcal_plane_times(was, (jcal_plane_t){n[0] + n[3], n[2] - n[1]});
    const jcal_plane_t turn = jcal_functional_turn_pull(sums, point, b);
    const jcal_plane_t lever = jcal_functional_lever_pull(sums, point, b);
    const jcal_plane_t all = {rate.re + turn.re + lever.re, rate.im - turn.im - lever.im};
    if (!(jcal_plane_norm2(all) > FLT_MIN)) {
        return;
    }
    point->heading[b] = jcal_plane_direction(all);
    follow(point->turn[b], jcal_plane_against(was, point->heading[b]));
    step_turn(point, b, m);
}

void jcal_functional_turn_all(jcal_functional_point_t *point, jcal_plane_t by)
{
    for (size_t b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
        point->heading[b] = jcal_plane_direction(jcal_plane_times(point->heading[b], by));
        jcal_functional_about_z(point->heading[b], point->turn[b]);
    }
}

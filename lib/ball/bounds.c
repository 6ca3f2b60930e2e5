/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds of heading and levers. See ball/bounds.h.
#include "ball/bounds.h"

#include "ball/solve.h"
#include "jointcal/head.h"
#include "jointcal/vec3.h"
#include "levers/levers.h"
#include "math/chol_small.h"
#include "math/eig3.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>
#include <math.h>

#define HEADING_SHARE 2.0f
#define LEVER_FLOOR_M 0.003f
#define LEVER_SHARE 0.5f
#define SKIN1 0.17f
#define SKIN2 0.10f
/// What is known of each component of a lever beforehand, 1/m^2: none is much longer than a metre. Of a joint that bends about one line
/// only the centre is open along it, and nothing else would be known of such a motion.
#define LEVER_KNOWN 1.0f
/// Square of the least length of the levers that errors of the regressors are spread over, m^2.
#define LENGTH2_MIN 1e-6f

/// q (6) <- derivative of the slope by both levers for a turn of block b's heading, from (C x2) and (x1' C) of C = heading times its products.
static float block_coupling(const jcal_ball_sums_t *sums, const jcal_ball_point_t *point, size_t b, float weight,
                            float *q)
{
    const float *const re = sums->levers.block[b].re;
    const float *const im = sums->levers.block[b].im;
    const jcal_plane_t heading = point->heading[b];
    const float x1[4] = {1.0f, -point->r1.x, -point->r1.y, -point->r1.z};
    const float x2[4] = {1.0f, -point->r2.x, -point->r2.y, -point->r2.z};
    float right[4] = {0.0f};
    float left[4] = {0.0f};
    float own = 0.0f;
    for (size_t i = 0u; i < 4u; ++i) {
        float along = 0.0f;
        for (size_t k = 0u; k < 4u; ++k) {
            const float real = (heading.re * re[(4u * i) + k]) - (heading.im * im[(4u * i) + k]);
            const float imaginary = (heading.re * im[(4u * i) + k]) + (heading.im * re[(4u * i) + k]);
            along += real * x2[k];
            right[i] += imaginary * x2[k];
            left[k] += imaginary * x1[i];
        }
        own += x1[i] * along;
    }
    for (size_t i = 0u; i < 3u; ++i) {
        q[i] = -weight * right[i + 1u];
        q[i + 3u] = -weight * left[i + 1u];
    }
    return jcal_max(weight * own, 0.0f);
}

void jcal_ball_information(const jcal_ball_sums_t *sums, const jcal_ball_past_t *past, const jcal_ball_point_t *point,
                           float *levers, float *coupling, float *headings)
{
    const float weight = jcal_ball_weight(sums, point);
    float x[16];
    float g[JCAL_LEVER_UNKNOWNS];
    jcal_levers_cross(&sums->levers, point->heading, x);
    jcal_levers_normal(&sums->levers, x, levers, g);
    for (size_t i = 0u; i < JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS); ++i) {
        levers[i] *= weight;
    }
    headings[0] = block_coupling(sums, point, 0u, weight, coupling);
    headings[1] = 0.0f;
    headings[2] = 1.0f;
    if (sums->block_motion_s[1] > 0.0f) {
        headings[0] += JCAL_BALL_PULL;
        headings[1] = -JCAL_BALL_PULL;
        headings[2] = block_coupling(sums, point, 1u, weight, &coupling[JCAL_LEVER_UNKNOWNS]) + JCAL_BALL_PULL +
                      jcal_ball_past_pull(past);
    } else {
        for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
            coupling[JCAL_LEVER_UNKNOWNS + i] = 0.0f;
        }
    }
}

static float dot6(const float *a, const float *b)
{
    return (a[0] * b[0]) + (a[1] * b[1]) + (a[2] * b[2]) + (a[3] * b[3]) + (a[4] * b[4]) + (a[5] * b[5]);
}

/// Determinant of a 2 x 2, packed.
static float determinant(const float *m)
{
    return (m[0] * m[2]) - (m[1] * m[1]);
}

static void bound_heading(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const v = &self->verdict;
    float q[2u * JCAL_LEVER_UNKNOWNS];
    jcal_ball_information(&self->sums, &self->past, &self->point, v->factor, q, v->left);
    v->heading_rad = JCAL_BOUND_UNKNOWN_RAD;
    for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
        v->factor[jcal_sym_at(i, i)] += LEVER_KNOWN;
    }
    if (!jcal_chol6_factor(v->factor)) {
        v->left[0] = 0.0f; /* nothing of the kind is known */
        return;
    }
    for (size_t i = 0u; i < (2u * JCAL_LEVER_UNKNOWNS); ++i) {
        v->coupling[i] = q[i];
    }
    jcal_chol6_solve(v->factor, v->coupling);
    jcal_chol6_solve(v->factor, &v->coupling[JCAL_LEVER_UNKNOWNS]);
    v->left[0] -= dot6(q, v->coupling);
    v->left[1] -= dot6(q, &v->coupling[JCAL_LEVER_UNKNOWNS]);
    v->left[2] -= dot6(&q[JCAL_LEVER_UNKNOWNS], &v->coupling[JCAL_LEVER_UNKNOWNS]);
    const float known = determinant(v->left);
    if (!(v->left[2] > 0.0f) || !(known > 0.0f)) {
        v->left[0] = 0.0f;
        return;
    }
    v->heading_rad = jcal_min(HEADING_SHARE * sqrtf(v->left[2] / known), JCAL_BOUND_UNKNOWN_RAD);
}

/// Half of the standard deviation in the direction that is known least, of the lever whose unknowns begin with `first`.
static float spread(const jcal_ball_verdict_t *v, size_t first)
{
    const float known = determinant(v->left);
    float covariance[JCAL_SYM_SIZE(3u)];
    for (size_t i = 0u; i < 3u; ++i) {
        float column[JCAL_LEVER_UNKNOWNS] = {0.0f};
        column[first + i] = 1.0f;
        jcal_chol6_solve(v->factor, column);
        const float a = v->coupling[first + i];
        const float b = v->coupling[JCAL_LEVER_UNKNOWNS + first + i];
        const float by0 = ((v->left[2] * a) - (v->left[1] * b)) / known; /* what the headings add: their covariance */
        const float by1 = ((v->left[0] * b) - (v->left[1] * a)) / known;
        for (size_t k = 0u; k <= i; ++k) {
            covariance[jcal_sym_at(i, k)] = column[first + k] + (by0 * v->coupling[first + k]) +
                                            (by1 * v->coupling[JCAL_LEVER_UNKNOWNS + first + k]);
        }
    }
    jcal_eig3_values(covariance);
    const float widest = jcal_max(covariance[0], jcal_max(covariance[2], covariance[5]));
    return LEVER_SHARE * sqrtf(jcal_max(widest, 0.0f));
}

/// The bounds, from spreads and what errors of the regressors, were they all that is left, shorten the levers by.
static void bound_levers(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const v = &self->verdict;
    const jcal_ball_point_t *const point = &self->point;
    float x[16];
    float h[JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS)];
    float less[JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS)];
    float g[JCAL_LEVER_UNKNOWNS];
    float longer[JCAL_LEVER_UNKNOWNS];
    jcal_levers_cross(&self->sums.levers, point->heading, x);
    jcal_levers_normal(&self->sums.levers, x, h, g);
    const float length2 = jcal_vec3_dot(point->r1, point->r1) + jcal_vec3_dot(point->r2, point->r2);
    const float noise = 0.5f * point->lack / jcal_max(length2, LENGTH2_MIN);
    for (size_t i = 0u; i < JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS); ++i) {
        less[i] = h[i];
    }
    for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
        less[jcal_sym_at(i, i)] -= noise;
        longer[i] = g[i];
    }
    if (!(v->left[0] > 0.0f) || !jcal_chol6_factor(h) || !jcal_chol6_factor(less)) {
        v->bound1_m = JCAL_BOUND_UNKNOWN_M;
        v->bound2_m = JCAL_BOUND_UNKNOWN_M;
        return;
    }
    jcal_chol6_solve(h, g);
    jcal_chol6_solve(less, longer);
    const jcal_vec3_t by1 = {longer[0] - g[0], longer[1] - g[1], longer[2] - g[2]};
    const jcal_vec3_t by2 = {longer[3] - g[3], longer[4] - g[4], longer[5] - g[5]};
    const float bound1 = LEVER_FLOOR_M + v->spread1_m + jcal_vec3_norm(by1) + (SKIN1 * jcal_vec3_norm(point->r1));
    const float bound2 = LEVER_FLOOR_M + v->spread2_m + jcal_vec3_norm(by2) + (SKIN2 * jcal_vec3_norm(point->r2));
    v->bound1_m = jcal_min(bound1, JCAL_BOUND_UNKNOWN_M);
    v->bound2_m = jcal_min(bound2, JCAL_BOUND_UNKNOWN_M);
}

void jcal_ball_bound(jcal_ball_t *self, unsigned part)
{
    if (part == 0u) {
        bound_heading(self);
    } else if (part > 1u) {
        bound_levers(self);
    } else if (self->verdict.left[0] > 0.0f) {
        self->verdict.spread1_m = spread(&self->verdict, 0u);
        self->verdict.spread2_m = spread(&self->verdict, 3u);
    }
}

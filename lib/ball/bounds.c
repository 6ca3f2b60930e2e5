/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds of heading and levers. See ball/bounds.h.
#include "ball/bounds.h"

#include "ball/solve.h"
#include "jointcal/head.h"
#include "jointcal/vec3.h"
#include "levers/levers.h"
#include "math/angle.h"
#include "math/chol_small.h"
#include "math/clear.h"
#include "math/eig3.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>
#include <math.h>

#define HEADING_SHARE 2.0f
/// How fast a heading may drift away while too little moves to tell, rad/s, once what is known of it is older than so much, s: gyroscopes whose
/// biases about the vertical nobody has found yet.
#define DRIFT_RAD_S (0.25f * JCAL_RAD_PER_DEG)
#define FRESH_S 10.0f
#define LEVER_FLOOR_M 0.003f
#define LEVER_SHARE 0.5f
/// Share of the largest diagonal element that every direction is given: three times what rounding takes (chol_small.h).
#define OPEN_SHARE 1e-5f
/// A variance of so much of what that share alone would leave is no knowledge.
#define OPEN_VARIANCE 0.5f
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
                           jcal_ball_information_t *out)
{
    float *const headings = out->headings;
    const float weight = jcal_ball_weight(sums, point);
    float x[16];
    float g[JCAL_LEVER_UNKNOWNS];
    jcal_levers_cross(&sums->levers, point->heading, x);
    jcal_levers_normal(&sums->levers, x, out->levers, g);
    for (size_t i = 0u; i < JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS); ++i) {
        out->levers[i] *= weight;
    }
    headings[0] = block_coupling(sums, point, 0u, weight, out->coupling);
    headings[1] = 0.0f;
    headings[2] = 1.0f;
    if (sums->block_motion_s[1] > 0.0f) {
        headings[0] += JCAL_BALL_PULL;
        headings[1] = -JCAL_BALL_PULL;
        headings[2] = block_coupling(sums, point, 1u, weight, &out->coupling[JCAL_LEVER_UNKNOWNS]) + JCAL_BALL_PULL +
                      jcal_ball_past_pull(past);
    } else {
        for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
            out->coupling[JCAL_LEVER_UNKNOWNS + i] = 0.0f;
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

/// What every direction of an information about both levers (6 x 6, packed) is given.
static float open_information(const float *h)
{
    const float first = jcal_max(h[0], jcal_max(h[2], h[5]));
    const float second = jcal_max(h[9], jcal_max(h[14], h[20]));
    return OPEN_SHARE * jcal_max(first, second);
}

/// Adds to the diagonal (6 x 6, packed): `own1` of lever 1 and `own2` of lever 2.
static void add_diagonal(float own1, float own2, float *h)
{
    h[0] += own1;
    h[2] += own1;
    h[5] += own1;
    h[9] += own2;
    h[14] += own2;
    h[20] += own2;
}

static void bound_heading(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const v = &self->verdict;
    jcal_ball_information_t all;
    const float *const q = all.coupling;
    jcal_ball_information(&self->sums, &self->past, &self->point, &all);
    jcal_copy(v->factor, all.levers, sizeof v->factor);
    jcal_copy(v->left, all.headings, sizeof v->left);
    v->heading_rad = JCAL_BOUND_UNKNOWN_RAD;
    v->open = open_information(v->factor);
    add_diagonal(v->open, v->open, v->factor);
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
    const float drift = DRIFT_RAD_S * jcal_max(self->track.age_s - FRESH_S, 0.0f);
    v->heading_rad = jcal_min((HEADING_SHARE * sqrtf(v->left[2] / known)) + drift, JCAL_BOUND_UNKNOWN_RAD);
}

/// Half of the standard deviation in the direction that is known least, of the lever whose unknowns begin with `first`; without bound if
/// nothing tells of that direction.
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
    const bool is_open = !((widest * v->open) < OPEN_VARIANCE);
    return is_open ? JCAL_BOUND_UNKNOWN_M : (LEVER_SHARE * sqrtf(jcal_max(widest, 0.0f)));
}

/// Both levers, were `noise1` and `noise2` of the information (6 x 6, packed) that of errors of the regressors. False if nothing is left.
static bool lengthen(const float *h, const float *g, float noise1, float noise2, float *longer)
{
    float less[JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS)];
    for (size_t i = 0u; i < JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS); ++i) {
        less[i] = h[i];
    }
    for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
        longer[i] = g[i];
    }
    add_diagonal(-noise1, -noise2, less);
    if (!jcal_chol6_factor(less)) {
        return false;
    }
    jcal_chol6_solve(less, longer);
    return true;
}

/// The bound of a lever `r` that may be `longer` (3); `skin` is the share of it that no IMU can see.
static float lever_bound(const float *longer, jcal_vec3_t r, float spread_m, float skin)
{
    const jcal_vec3_t by = {longer[0] - r.x, longer[1] - r.y, longer[2] - r.z};
    const float bound = LEVER_FLOOR_M + spread_m + jcal_vec3_norm(by) + (skin * jcal_vec3_norm(r));
    return (bound < JCAL_BOUND_UNKNOWN_M) ? bound : JCAL_BOUND_UNKNOWN_M; /* so for NaN, too */
}

/// The bounds, from spreads and from what the ridge of the solve and errors of the regressors, were they all that is left, shorten the
/// levers by.
static void bound_levers(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const v = &self->verdict;
    const jcal_ball_point_t *const point = &self->point;
    float x[16];
    float h[JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS)];
    float g[JCAL_LEVER_UNKNOWNS];
    float longer[JCAL_LEVER_UNKNOWNS];
    v->bound1_m = JCAL_BOUND_UNKNOWN_M;
    v->bound2_m = JCAL_BOUND_UNKNOWN_M;
    if (!(v->left[0] > 0.0f)) {
        return;
    }
    jcal_levers_cross(&self->sums.levers, point->heading, x);
    jcal_levers_normal(&self->sums.levers, x, h, g);
    const float length2 = jcal_vec3_dot(point->r1, point->r1) + jcal_vec3_dot(point->r2, point->r2);
    const float noise = point->lack / jcal_max(length2, LENGTH2_MIN);
    if (lengthen(h, g, noise, noise, longer)) {
        v->bound1_m = lever_bound(&longer[0], point->r1, v->spread1_m, JCAL_BALL_SKIN1);
        v->bound2_m = lever_bound(&longer[3], point->r2, v->spread2_m, JCAL_BALL_SKIN2);
        return;
    }
    const float open = open_information(h);
    if (lengthen(h, g, noise, -open, longer)) {
        v->bound1_m = lever_bound(&longer[0], point->r1, v->spread1_m, JCAL_BALL_SKIN1);
    }
    if (lengthen(h, g, -open, noise, longer)) {
        v->bound2_m = lever_bound(&longer[3], point->r2, v->spread2_m, JCAL_BALL_SKIN2);
    }
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

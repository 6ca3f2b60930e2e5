/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds of the axes. See functional/bounds.h.
#include "functional/bounds.h"

#include "functional/axes.h"
#include "functional/describe.h"
#include "functional/headings.h"
#include "functional/model.h"
#include "jointcal/functional.h"
#include "jointcal/vec3.h"
#include "math/chol_small.h"
#include "math/clear.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/sphere.h"
#include "math/sym.h"

#include <float.h>

/// What is never known, rad: 1 deg of rigid mounts, 2 deg of people, whose axis differs from one activity to the next.
#define FLOOR_RIGID_RAD 0.0174532925f
#define FLOOR_PERSON_RAD 0.0349065850f

/// Square of the share of a residual that never averages out, of rigid mounts and of people, and seconds of motion that one
/// independent reading of all of it takes. A mean squared residual of the rates of PERSON is a person's.
#define LASTING_RIGID 0.25f
#define LASTING_PERSON 1.0f
#define PERSON_RATE 0.01f
#define READING_S 2.5f

/// Longest step of an axis, rad: a quadratic model is good for so much.
#define HOME_MAX_RAD 0.1f

/// Weight of the rates' products.
static float rate_scale(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point)
{
    return point->weight[JCAL_FAMILY_RATE] / jcal_max(sums->rate2, FLT_MIN);
}

/// As jcal_functional_bound_coupling; `rates` (27) <- those of block b across j1, weighted.
static void couple(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b, float *rates,
                   float *out)
{
    const float scale = rate_scale(sums, point);
    const float turn_scale = point->weight[JCAL_FAMILY_TURN] / jcal_max(sums->motion_s, FLT_MIN);
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    const jcal_vec3_t left[4] = {t1.u, t1.v, point->j1, point->j1};
    const jcal_vec3_t right[4] = {point->j2, point->j2, t2.u, t2.v};
    for (size_t i = 0u; i < 4u; ++i) {
        float m[9];
        float n[9];
        if (i < 3u) { /* the last two share j1 */
            jcal_functional_left_rates(sums->block[b].rate, left[i], scale, rates);
        }
        jcal_functional_right_rates(rates, right[i], m);
        jcal_functional_times_transposed(point->turn[b], m, n);
        jcal_functional_turn_slope(n, &out[3u * i]);
        const jcal_plane_t pull = {jcal_functional_between(sums->block[b].turn_re, left[i], right[i]),
                                   jcal_functional_between(sums->block[b].turn_im, left[i], right[i])};
        out[(3u * i) + 2u] += turn_scale * jcal_plane_times(point->heading[b], pull).im;
    }
}

void jcal_functional_bound_coupling(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                    float *out)
{
    float rates[27];
    couple(sums, point, b, rates, out);
}

/// Both derivatives of the cost by a block's turn, as jcal_functional_bound_slope and jcal_functional_bound_nuisance.
typedef struct {
    float slope[3];
    float hessian[JCAL_SYM_SIZE(3u)];
} by_turn_t;

/// With the rates of block b across j1, weighted.
static void turn_of(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                    const float *rates, by_turn_t *out)
{
    jcal_functional_grip_t grip;
    float n[9];
    jcal_functional_grip_left(point, b, rates, &grip);
    jcal_functional_turn_hessian(grip.n, out->hessian);
    jcal_functional_turn_slope(grip.n, out->slope);
    const jcal_plane_t heading = point->heading[b];
    const jcal_plane_t turn = jcal_plane_times(heading, jcal_functional_turn_pull(sums, point, b));
    const jcal_plane_t lever = jcal_plane_times(heading, jcal_functional_lever_pull(sums, point, b));
    /* Heading and turn go together about z: what ties them does not count there. */
    out->hessian[5] += jcal_max(turn.re, 0.0f) + jcal_max(lever.re, 0.0f) - (2.0f * JCAL_FUNCTIONAL_TILT_WEIGHT);
    jcal_functional_times_transposed(point->turn[b], grip.m, n);
    out->slope[2] = (n[1] - n[3]) + turn.im + lever.im;
}

void jcal_functional_bound_nuisance(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                    float *out)
{
    float rates[27];
    by_turn_t by;
    jcal_functional_left_rates(sums->block[b].rate, point->j1, rate_scale(sums, point), rates);
    turn_of(sums, point, b, rates, &by);
    jcal_copy(out, by.hessian, sizeof by.hessian);
}

void jcal_functional_bound_slope(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                 float *out)
{
    float rates[27];
    by_turn_t by;
    jcal_functional_left_rates(sums->block[b].rate, point->j1, rate_scale(sums, point), rates);
    turn_of(sums, point, b, rates, &by);
    jcal_copy(out, by.slope, sizeof by.slope);
}

/// Share of block b in all motion.
static float block_share(const jcal_functional_sums_t *sums, size_t b)
{
    return sums->block[b].motion_s / jcal_max(sums->motion_s, FLT_MIN);
}

/// hessian and slope of the verdict <- what is left of them when block b's turn is free, and where that is best.
static void take_out(jcal_functional_t *self, size_t b)
{
    const jcal_functional_sums_t *const sums = &self->sums;
    const jcal_functional_point_t *const point = &self->point;
    float *const hessian = self->verdict.hessian;
    if (!(sums->block[b].motion_s > JCAL_FUNCTIONAL_BLOCK_MIN_S)) {
        return;
    }
    float q[12];
    float rates[27];
    by_turn_t by;
    couple(sums, point, b, rates, q);
    turn_of(sums, point, b, rates, &by);
    if (!jcal_chol3_factor(by.hessian)) {
        jcal_sym_zero(hessian, 4u); /* the block is not at a minimum: nothing is known */
        return;
    }
    const float scale = self->verdict.block_share[b] / block_share(sums, b); /* ticks may have come in between */
    for (size_t i = 0u; i < 4u; ++i) {
        float solved[3] = {q[3u * i], q[(3u * i) + 1u], q[(3u * i) + 2u]};
        jcal_chol3_solve(by.hessian, solved);
        for (size_t k = 0u; k < 3u; ++k) {
            solved[k] *= scale;
        }
        self->verdict.slope[i] -= (solved[0] * by.slope[0]) + (solved[1] * by.slope[1]) + (solved[2] * by.slope[2]);
        for (size_t k = 0u; k <= i; ++k) {
            const float *const qk = &q[3u * k];
            hessian[jcal_sym_at(i, k)] -= (solved[0] * qk[0]) + (solved[1] * qk[1]) + (solved[2] * qk[2]);
        }
    }
}

/// Root of the larger eigenvalue of a 2 x 2 covariance.
static float widest(float p00, float p01, float p11)
{
    const float mean = 0.5f * (p00 + p11);
    const float half = 0.5f * (p00 - p11);
    return sqrtf(jcal_max(mean + sqrtf((half * half) + (p01 * p01)), 0.0f));
}

/// The last step to the minimum, with headings and turns free: rounds that take turns with them come near it slowly. Each bound grows by
/// how far its axis still had to go.
static void step_home(jcal_functional_t *self, const float *factor)
{
    jcal_functional_verdict_t *const verdict = &self->verdict;
    jcal_functional_point_t *const point = &self->point;
    float *const step = verdict->slope; /* not needed any more */
    jcal_chol4_solve(factor, step);
    const float way1 = sqrtf((step[0] * step[0]) + (step[1] * step[1]));
    const float way2 = sqrtf((step[2] * step[2]) + (step[3] * step[3]));
    const float scale = -jcal_min(1.0f, HOME_MAX_RAD / jcal_max(jcal_max(way1, way2), FLT_MIN));
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    point->j1 = jcal_sphere_move(point->j1, &t1, scale * step[0], scale * step[1]);
    point->j2 = jcal_sphere_move(point->j2, &t2, scale * step[2], scale * step[3]);
    verdict->bound1_rad = jcal_min(verdict->bound1_rad + way1, JCAL_BOUND_UNKNOWN_RAD);
    verdict->bound2_rad = jcal_min(verdict->bound2_rad + way2, JCAL_BOUND_UNKNOWN_RAD);
}

/// Bounds from what is left of the Hessian.
static void finish(jcal_functional_t *self)
{
    jcal_functional_verdict_t *const verdict = &self->verdict;
    verdict->bound1_rad = JCAL_BOUND_UNKNOWN_RAD;
    verdict->bound2_rad = JCAL_BOUND_UNKNOWN_RAD;
    float *const factor = verdict->hessian; /* not needed any more */
    if (jcal_chol4_factor(factor)) {
        float p[4][4]; /* columns of the inverse */
        for (size_t k = 0u; k < 4u; ++k) {
            for (size_t i = 0u; i < 4u; ++i) {
                p[k][i] = (i == k) ? 1.0f : 0.0f;
            }
            jcal_chol4_solve(factor, p[k]);
        }
        const float person = jcal_min(self->point.size[JCAL_FAMILY_RATE] / PERSON_RATE, 1.0f);
        const float lasting = LASTING_RIGID + ((LASTING_PERSON - LASTING_RIGID) * person);
        const float growth = sqrtf(lasting + (READING_S / jcal_max(self->sums.motion_s, FLT_MIN)));
        const float floor_rad = FLOOR_RIGID_RAD + ((FLOOR_PERSON_RAD - FLOOR_RIGID_RAD) * person);
        verdict->bound1_rad =
            jcal_min(floor_rad + (growth * widest(p[0][0], p[0][1], p[1][1])), JCAL_BOUND_UNKNOWN_RAD);
        verdict->bound2_rad =
            jcal_min(floor_rad + (growth * widest(p[2][2], p[2][3], p[3][3])), JCAL_BOUND_UNKNOWN_RAD);
        step_home(self, factor);
    }
}

float jcal_functional_flexion_error(const jcal_functional_t *self, float bound_rad)
{
    if ((self == NULL) || !self->search.has_estimate) {
        return JCAL_BOUND_UNKNOWN_RAD;
    }
    const float leaning = 2.0f * self->point.size[JCAL_FAMILY_TURN];
    const float bent = 0.5f * self->verdict.bend_rad * bound_rad;
    return jcal_min(bound_rad * sqrtf(leaning + (bent * bent)), JCAL_BOUND_UNKNOWN_RAD);
}

void jcal_functional_bound(jcal_functional_t *self, unsigned part)
{
    if (part == 0u) {
        jcal_functional_cross_t x;
        jcal_functional_quadric_t h;
        jcal_functional_cross(&self->sums, &self->point, &x);
        jcal_functional_quadric(&self->sums, &x, &self->point, &h);
        const jcal_vec3_t j[2] = {self->point.j1, self->point.j2};
        jcal_functional_tangent_hessian(&h, j, true, self->verdict.hessian, self->verdict.slope);
        jcal_functional_describe(self, &x);
        for (size_t b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
            self->verdict.block_share[b] = block_share(&self->sums, b);
        }
    } else if (part <= JCAL_FUNCTIONAL_BLOCKS) {
        take_out(self, part - 1u);
    } else {
        finish(self);
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Ties between hip and knee. See chain/tie.h.
#include "chain/tie.h"

#include "center/judge.h"
#include "jointcal/vec3.h"
#include "math/chol.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#define N JCAL_CHAIN_STATES

/// Bounds from here on are none to build on, m.
#define BOUND_MAX_M 1.0f
/// Both joints see the same accelerometer: standard deviation of the difference of its biases, m/s^2.
#define SAME_BIAS 0.01f
/// A tie that is further away than so many standard deviations contradicts what both joints found. Those are wide: they are scaled to
/// the bounds, which the joints' errors fill by a third.
#define CONTRADICTION 3.0f

/// The 9 unknowns of a joint that count here, by their numbers in its sums: r1, r2 and the bias of the thigh's accelerometer.
static void unknowns_of(bool is_hip, size_t *which)
{
    for (size_t i = 0u; i < 6u; ++i) {
        which[i] = i;
    }
    for (size_t i = 0u; i < 3u; ++i) {
        which[6u + i] = (is_hip ? 9u : 6u) + i;
    }
}

/// Their places in the state.
static size_t place_of(bool is_hip, size_t i)
{
    if (is_hip) {
        return i; /* r1, r2, bias */
    }
    return (i < 6u) ? (JCAL_CHAIN_AT_KNEE_THIGH + i) : (JCAL_CHAIN_AT_KNEE_BIAS + (i - 6u));
}

/// By how much the standard deviations of one sensor's vector, by the matrix alone, must grow to make the bound that is stated.
static float growth(const jcal_center_t *joint, bool is_hip, size_t sensor, const jcal_chain_state_t *state)
{
    const float bound_m = (sensor == 0u) ? joint->work.verdict.bound1_m : joint->work.verdict.bound2_m;
    const jcal_vec3_t axis = (sensor == 0u) ? joint->cfg.hinge_axis1 : joint->cfg.hinge_axis2;
    const size_t first = place_of(is_hip, 3u * sensor);
    float c[6];
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            c[jcal_sym_at(i, j)] = state->covariance[jcal_sym_at(first + i, first + j)];
        }
    }
    const float radius = jcal_center_radius_across(c, axis);
    return jcal_max(bound_m - joint->cfg.mismatch_m, 0.0f) / jcal_max(radius, FLT_MIN);
}

/// One joint's covariance by the matrix alone, and what it knows, into its part of the state.
static void copy_joint(const jcal_center_t *joint, bool is_hip, jcal_chain_state_t *state)
{
    const jcal_center_inverse_t *const inverse = &joint->work.as.inverse;
    const jcal_center_point_t *const point = &joint->work.sums.point;
    const jcal_vec3_t parts[3] = {point->place.r1, point->place.r2, is_hip ? point->b2 : point->b1};
    size_t which[9];
    unknowns_of(is_hip, which);
    for (size_t i = 0u; i < 9u; ++i) {
        const jcal_vec3_t part = parts[i / 3u];
        const float values[3] = {part.x, part.y, part.z};
        const size_t row = place_of(is_hip, i);
        float column[JCAL_CENTER_UNKNOWNS] = {0.0f};
        column[which[i]] = 1.0f;
        jcal_chol_solve_scaled(inverse->factor, JCAL_CENTER_UNKNOWNS, inverse->scale, column);
        state->x[row] = values[i % 3u];
        for (size_t j = 0u; j <= i; ++j) {
            state->covariance[jcal_sym_at(row, place_of(is_hip, j))] = column[which[j]];
        }
    }
}

/// One joint into its part of the state, as uncertain as it states.
static void collect(const jcal_center_t *joint, bool is_hip, jcal_chain_state_t *state)
{
    copy_joint(joint, is_hip, state);
    const float grow1 = growth(joint, is_hip, 0u, state);
    const float grow2 = growth(joint, is_hip, 1u, state);
    const float grow[3] = {grow1, grow2, jcal_max(grow1, grow2)};
    for (size_t i = 0u; i < 9u; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            state->covariance[jcal_sym_at(place_of(is_hip, i), place_of(is_hip, j))] *= grow[i / 3u] * grow[j / 3u];
        }
    }
}

bool jcal_chain_collect(const jcal_center_t *hip, const jcal_center_t *knee, jcal_chain_state_t *state)
{
    const jcal_center_verdict_t *const a = &hip->work.verdict;
    const jcal_center_verdict_t *const b = &knee->work.verdict;
    const float worst = jcal_max(jcal_max(a->bound1_m, a->bound2_m), jcal_max(b->bound1_m, b->bound2_m));
    if (!(worst < BOUND_MAX_M) || !hip->work.as.inverse.is_factored || !knee->work.as.inverse.is_factored) {
        return false;
    }
    jcal_clear(state, sizeof *state);
    collect(hip, true, state);
    collect(knee, false, state);
    return true;
}

/// on <- C slope. What the state moves by is on * (what is returned) * apart; 0 if `apart` is more than what is known leaves room for.
static float weigh(const jcal_chain_state_t *state, const float *slope, float apart, float deviation, float *on)
{
    jcal_sym_times(state->covariance, N, slope, on);
    float variance = deviation * deviation;
    for (size_t i = 0u; i < N; ++i) {
        variance += slope[i] * on[i];
    }
    return ((apart * apart) <= (CONTRADICTION * CONTRADICTION * variance)) ? (1.0f / variance) : 0.0f;
}

bool jcal_chain_observe(jcal_chain_state_t *state, const float *slope, float apart, float deviation)
{
    float on[N];
    const float gain = weigh(state, slope, apart, deviation, on);
    for (size_t i = 0u; i < N; ++i) {
        state->x[i] += on[i] * gain * apart;
    }
    jcal_sym_rank1(state->covariance, N, on, -gain);
    return gain > 0.0f;
}

/// slope <- v at the thigh as the hip sees it, -v as the knee does.
static void slope_between(jcal_vec3_t v, float *slope)
{
    const float parts[3] = {v.x, v.y, v.z};
    jcal_clear(slope, N * sizeof *slope);
    for (size_t i = 0u; i < 3u; ++i) {
        slope[JCAL_CHAIN_AT_HIP_THIGH + i] = parts[i];
        slope[JCAL_CHAIN_AT_KNEE_THIGH + i] = -parts[i];
    }
}

static jcal_vec3_t vector_at(const jcal_chain_state_t *state, size_t at)
{
    return jcal_vec3(state->x[at], state->x[at + 1u], state->x[at + 2u]);
}

/// From the hip's centre to the knee's, sensor frame 2.
static jcal_vec3_t segment_of(const jcal_chain_state_t *state)
{
    return jcal_vec3_sub(vector_at(state, JCAL_CHAIN_AT_HIP_THIGH), vector_at(state, JCAL_CHAIN_AT_KNEE_THIGH));
}

/// The distance of both centres is linearised where it is after a first, tentative update.
static bool tie_length(const jcal_chain_config_t *cfg, jcal_chain_state_t *state, float *slope)
{
    float on[N];
    const jcal_vec3_t segment = segment_of(state);
    const float length = jcal_max(jcal_vec3_norm(segment), FLT_MIN);
    slope_between(jcal_vec3_scale(segment, 1.0f / length), slope);
    const float apart = cfg->segment_length_m - length;
    const float move = apart * weigh(state, slope, apart, cfg->segment_tolerance_m, on);
    float moved[3];
    for (size_t i = 0u; i < 3u; ++i) {
        moved[i] = move * (on[JCAL_CHAIN_AT_HIP_THIGH + i] - on[JCAL_CHAIN_AT_KNEE_THIGH + i]);
    }
    const jcal_vec3_t along = jcal_vec3_add(segment, jcal_vec3(moved[0], moved[1], moved[2]));
    const jcal_vec3_t direction = jcal_vec3_scale(along, 1.0f / jcal_max(jcal_vec3_norm(along), FLT_MIN));
    slope_between(direction, slope);
    return jcal_chain_observe(state, slope, cfg->segment_length_m - jcal_vec3_dot(direction, segment),
                              cfg->segment_tolerance_m);
}

bool jcal_chain_tie(const jcal_chain_config_t *cfg, jcal_chain_state_t *state)
{
    float slope[N];
    bool fits = true;
    if ((cfg->center.method != JCAL_CENTER_LS) && (cfg->center.acc_bias_m_s2 > 0.0f)) {
        for (size_t i = 0u; i < 3u; ++i) {
            jcal_clear(slope, sizeof slope);
            slope[JCAL_CHAIN_AT_HIP_BIAS + i] = 1.0f;
            slope[JCAL_CHAIN_AT_KNEE_BIAS + i] = -1.0f;
            const float apart = state->x[JCAL_CHAIN_AT_KNEE_BIAS + i] - state->x[JCAL_CHAIN_AT_HIP_BIAS + i];
            fits = jcal_chain_observe(state, slope, apart, SAME_BIAS) && fits;
        }
    }
    if (jcal_vec3_dot(cfg->plane_normal, cfg->plane_normal) > 0.0f) {
        slope_between(cfg->plane_normal, slope);
        const float apart = -jcal_vec3_dot(cfg->plane_normal, segment_of(state));
        fits = jcal_chain_observe(state, slope, apart, cfg->plane_tolerance_m) && fits;
    }
    if (cfg->segment_length_m > 0.0f) {
        fits = tie_length(cfg, state, slope) && fits;
    }
    return fits;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Hip and knee: samples to both joints, and what comes out of both.
#include "jointcal/chain.h"

#include "center/input.h"
#include "center/judge.h"
#include "chain/tie.h"
#include "joint/head.h"
#include "joint/hysteresis.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sym.h"
#include "sample/ring.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

/// 95 % of a Gaussian along a line.
#define NORMAL_95 1.96f

jcal_status_t jcal_chain_init(jcal_chain_t *self, const jcal_chain_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_chain_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_chain_config_t cfg = *config; /* the caller may hand over self->cfg */
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    self->calm_m[0] = JCAL_BOUND_UNKNOWN_M;
    self->calm_m[1] = JCAL_BOUND_UNKNOWN_M;
    jcal_center_config_t knee = cfg.center;
    knee.hinge_axis1 = cfg.knee_axis2;
    knee.hinge_axis2 = cfg.knee_axis3;
    const jcal_status_t status = jcal_center_init(&self->hip, &cfg.center);
    return (status == JCAL_OK) ? jcal_center_init(&self->knee, &knee) : status;
}

jcal_status_t jcal_chain_reset(jcal_chain_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_chain_init(self, &self->cfg);
}

/// False for null and for what init has never prepared: all zero, say.
static bool is_prepared(const jcal_chain_t *self)
{
    return (self != NULL) && (self->cfg.segment_tolerance_m > 0.0f);
}

static jcal_status_t push_one(jcal_center_t *joint, const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    return (attitudes == NULL) ? jcal_center_push(joint, pair) : jcal_center_push_oriented(joint, pair, attitudes);
}

/// The cause that a joint has just counted: the one whose number has changed.
static size_t cause_of(const jcal_center_t *joint, const uint32_t *before)
{
    size_t cause = 0u;
    for (size_t i = 0u; i < (size_t)JCAL_REJECT_COUNT; ++i) {
        cause = (joint->input.gate.rejected_by[i] != before[i]) ? i : cause;
    }
    return cause;
}

jcal_status_t jcal_chain_push(jcal_chain_t *self, const jcal_triple_t *triple, const jcal_triple_attitudes_t *attitudes)
{
    if (!is_prepared(self) || (triple == NULL) ||
        ((attitudes == NULL) && (self->cfg.center.method == JCAL_CENTER_LS))) {
        return JCAL_ERR_ARG;
    }
    if (jcal_center_input_full(&self->hip.input) || jcal_center_input_full(&self->knee.input)) {
        self->overrun += 1u;
        return JCAL_ERR_FULL; /* before either joint takes anything: a sample that is pushed again must find no trace */
    }
    const jcal_pair_t pairs[2] = {{triple->t_us, triple->imu1, triple->imu2},
                                  {triple->t_us, triple->imu2, triple->imu3}};
    jcal_center_t *const joints[2] = {&self->hip, &self->knee};
    jcal_attitudes_t turns[2] = {{{0.0f, 0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f, 0.0f}}};
    if (attitudes != NULL) {
        turns[0] = (jcal_attitudes_t){attitudes->q1, attitudes->q2};
        turns[1] = (jcal_attitudes_t){attitudes->q2, attitudes->q3};
    }
    size_t cause = (size_t)JCAL_REJECT_COUNT; /* none */
    for (size_t i = 0u; i < 2u; ++i) {
        uint32_t before[JCAL_REJECT_COUNT];
        (void)memcpy(before, joints[i]->input.gate.rejected_by, sizeof before);
        const jcal_status_t status = push_one(joints[i], &pairs[i], (attitudes == NULL) ? NULL : &turns[i]);
        if (status == JCAL_REJECTED) {
            const size_t own = cause_of(joints[i], before);
            cause = (own < cause) ? own : cause;
        }
    }
    self->samples += 1u;
    if (cause < (size_t)JCAL_REJECT_COUNT) {
        self->rejected_by[cause] += 1u;
        return JCAL_REJECTED;
    }
    return JCAL_OK;
}

/// A 3 x 3 block on the diagonal of the state's covariance.
static void block_of(const jcal_chain_state_t *state, size_t first, float *c)
{
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            c[jcal_sym_at(i, j)] = state->covariance[jcal_sym_at(first + i, first + j)];
        }
    }
}

/// Standard deviation of the distance of both centres.
static float segment_deviation(const jcal_chain_state_t *state, jcal_vec3_t direction)
{
    const float parts[3] = {direction.x, direction.y, direction.z};
    float slope[JCAL_CHAIN_STATES] = {0.0f};
    float on[JCAL_CHAIN_STATES];
    float variance = 0.0f;
    for (size_t i = 0u; i < 3u; ++i) {
        slope[JCAL_CHAIN_AT_HIP_THIGH + i] = parts[i];
        slope[JCAL_CHAIN_AT_KNEE_THIGH + i] = -parts[i];
    }
    jcal_sym_times(state->covariance, JCAL_CHAIN_STATES, slope, on);
    for (size_t i = 0u; i < JCAL_CHAIN_STATES; ++i) {
        variance += slope[i] * on[i];
    }
    return sqrtf(jcal_max(variance, 0.0f));
}

/// Places and bounds after all ties. False if a tie contradicts what the joints found.
static bool tell_tied(const jcal_chain_t *self, jcal_chain_state_t *state, jcal_chain_result_t *out)
{
    static const size_t first[JCAL_CHAIN_PLACES] = {JCAL_CHAIN_AT_HIP, JCAL_CHAIN_AT_HIP_THIGH,
                                                    JCAL_CHAIN_AT_KNEE_THIGH, JCAL_CHAIN_AT_KNEE_SHANK};
    const float mismatch_m = self->cfg.center.mismatch_m;
    const jcal_vec3_t none = {0.0f, 0.0f, 0.0f};
    const jcal_vec3_t axes[JCAL_CHAIN_PLACES] = {none, none, self->cfg.knee_axis2, self->cfg.knee_axis3};
    const bool fits = jcal_chain_tie(&self->cfg, state);
    for (size_t i = 0u; i < JCAL_CHAIN_PLACES; ++i) {
        const float *const x = &state->x[first[i]];
        float c[6];
        block_of(state, first[i], c);
        out->place_m[i] = jcal_vec3(x[0], x[1], x[2]);
        out->uncertainty_m[i] = mismatch_m + jcal_center_radius_across(c, axes[i]);
    }
    return fits;
}

/// What the chain takes from a joint's result besides places and bounds.
typedef struct {
    jcal_calibration_t status;
    jcal_hint_t hint;
    jcal_reason_t reason;
    bool has_center;
    uint64_t t_us;
} joint_news_t;

/// Places and bounds of a joint by itself; `first` is that of its two places.
static joint_news_t tell_apart(const jcal_center_t *joint, jcal_chain_place_t first, jcal_chain_result_t *out)
{
    jcal_center_result_t r;
    (void)jcal_center_get(joint, &r);
    const size_t at = (size_t)first;
    out->place_m[at] = r.joint_to_sensor1_m;
    out->place_m[at + 1u] = r.joint_to_sensor2_m;
    out->uncertainty_m[at] = r.uncertainty1_m;
    out->uncertainty_m[at + 1u] = r.uncertainty2_m;
    out->joint_status[at / 2u] = r.head.status;
    out->misfit = jcal_max(out->misfit, r.misfit);
    const joint_news_t news = {r.head.status, r.head.hint, r.head.reason, r.has_center, r.head.t_us};
    return news;
}

/// The knee's centre on a hinge's axis: next to both sensors, (11) and (12) of [SAL15].
static void shift_knee(const jcal_chain_config_t *cfg, jcal_chain_result_t *out)
{
    jcal_vec3_t *const thigh = &out->place_m[JCAL_CHAIN_KNEE_TO_THIGH];
    jcal_vec3_t *const shank = &out->place_m[JCAL_CHAIN_KNEE_TO_SHANK];
    const float shift = 0.5f * (jcal_vec3_dot(*thigh, cfg->knee_axis2) + jcal_vec3_dot(*shank, cfg->knee_axis3));
    *thigh = jcal_vec3_sub(*thigh, jcal_vec3_scale(cfg->knee_axis2, shift));
    *shank = jcal_vec3_sub(*shank, jcal_vec3_scale(cfg->knee_axis3, shift));
}

/// Whether a joint lacks nothing but smaller bounds.
static bool is_sound(const joint_news_t *joint)
{
    return (joint->status == JCAL_READY) ||
           ((joint->status == JCAL_COLLECTING) && (joint->reason == JCAL_REASON_UNCERTAIN));
}

static float own_bound_m(const jcal_center_t *joint)
{
    return jcal_max(joint->work.verdict.bound1_m, joint->work.verdict.bound2_m);
}

/// A joint's own bound with play: down at once, up only as far as the bound is JCAL_HYSTERESIS times larger. So this goes below a limit
/// where the bound does, and above it where the bound is JCAL_HYSTERESIS times the limit.
static float calm_of(const jcal_center_t *joint, float before_m)
{
    const float own_m = own_bound_m(joint);
    return jcal_min(jcal_max(before_m, own_m / JCAL_HYSTERESIS), own_m);
}

/// Whether a joint's worst bound after all ties is small enough. Ties scale with the joint's own bound, so that it breathes as that does
/// and takes over its play.
static bool is_known(const jcal_center_t *joint, float calm_m, float worst_m, float limit_m)
{
    return (worst_m * calm_of(joint, calm_m)) <= (limit_m * own_bound_m(joint));
}

/// Status by the bounds; `fits` if no tie contradicts.
static void tell_status(const jcal_chain_t *self, const joint_news_t *hip, const joint_news_t *knee, bool fits,
                        jcal_chain_result_t *out)
{
    float worst[2];
    for (size_t i = 0u; i < 2u; ++i) {
        worst[i] = jcal_max(out->uncertainty_m[2u * i], out->uncertainty_m[(2u * i) + 1u]);
    }
    const float limit_m = self->cfg.center.max_bound_m;
    const bool hip_known =
        is_sound(hip) && ((hip->status == JCAL_READY) || is_known(&self->hip, self->calm_m[0], worst[0], limit_m));
    const bool knee_known =
        is_sound(knee) && ((knee->status == JCAL_READY) || is_known(&self->knee, self->calm_m[1], worst[1], limit_m));
    if (hip_known && knee_known) {
        out->head.status = fits ? JCAL_READY : JCAL_COLLECTING;
        out->head.reason = fits ? JCAL_REASON_NONE : JCAL_REASON_DOES_NOT_FIT;
        out->head.hint = fits ? JCAL_HINT_NONE : JCAL_HINT_CHECK_SENSORS;
        return;
    }
    const bool hip_first = !hip_known && (knee_known || (worst[0] >= worst[1]));
    const joint_news_t *const weaker = hip_first ? hip : knee;
    out->head.status = ((hip->status == JCAL_MOVED) || (knee->status == JCAL_MOVED)) ? JCAL_MOVED : JCAL_COLLECTING;
    out->head.weak = hip_first ? JCAL_WEAK_CENTER1 : JCAL_WEAK_CENTER2;
    out->head.hint = weaker->hint;
    out->head.reason = weaker->reason;
}

jcal_status_t jcal_chain_get(const jcal_chain_t *self, jcal_chain_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_chain_state_t state;
    jcal_clear(out, sizeof *out);
    const joint_news_t hip = tell_apart(&self->hip, JCAL_CHAIN_HIP_TO_PELVIS, out);
    const joint_news_t knee = tell_apart(&self->knee, JCAL_CHAIN_KNEE_TO_THIGH, out);
    out->uncertainty_segment_m = JCAL_BOUND_UNKNOWN_M;
    out->has_places = hip.has_center && knee.has_center;
    const bool tied = out->has_places && jcal_chain_collect(&self->hip, &self->knee, &state);
    const bool fits = !tied || tell_tied(self, &state, out);
    shift_knee(&self->cfg, out);
    const jcal_vec3_t segment =
        jcal_vec3_sub(out->place_m[JCAL_CHAIN_HIP_TO_THIGH], out->place_m[JCAL_CHAIN_KNEE_TO_THIGH]);
    out->segment_length_m = out->has_places ? jcal_vec3_norm(segment) : 0.0f;
    if (tied && (out->segment_length_m > 0.0f)) {
        const jcal_vec3_t direction = jcal_vec3_scale(segment, 1.0f / out->segment_length_m);
        out->uncertainty_segment_m =
            (2.0f * self->cfg.center.mismatch_m) + (NORMAL_95 * segment_deviation(&state, direction));
    }
    tell_status(self, &hip, &knee, fits, out);
    out->head.t_us = (hip.t_us > knee.t_us) ? hip.t_us : knee.t_us;
    jcal_head_count(&out->head, self->samples, self->rejected_by);
    out->head.overrun = self->overrun;
    return JCAL_OK;
}

/// Remembers each joint's own bound. What ties make of it is left to jcal_chain_get, as they take several times what a step may.
static void follow_bounds(jcal_chain_t *self)
{
    self->calm_m[0] = calm_of(&self->hip, self->calm_m[0]);
    self->calm_m[1] = calm_of(&self->knee, self->calm_m[1]);
}

jcal_status_t jcal_chain_step(jcal_chain_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t hip = jcal_center_step(&self->hip);
    const jcal_status_t knee = jcal_center_step(&self->knee);
    follow_bounds(self);
    return ((hip == JCAL_IDLE) && (knee == JCAL_IDLE)) ? JCAL_IDLE : JCAL_OK;
}

jcal_status_t jcal_chain_update(jcal_chain_t *self, const jcal_triple_t *triple,
                                const jcal_triple_attitudes_t *attitudes)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    const uint32_t hip = jcal_ring_waiting(&self->hip.input.inbox.ring);
    const uint32_t knee = jcal_ring_waiting(&self->knee.input.inbox.ring);
    for (uint32_t left = (hip > knee) ? hip : knee; left > 0u; --left) {
        (void)jcal_chain_step(self); /* pushed without a step */
    }
    const jcal_status_t status = jcal_chain_push(self, triple, attitudes);
    if (status >= JCAL_OK) {
        (void)jcal_chain_step(self);
    }
    return status;
}

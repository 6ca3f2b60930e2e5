/* SPDX-License-Identifier: MIT */
/// @file
/// Results as records, and which of them are worth a write. See jointcal/keep.h.
#include "jointcal/keep.h"

#include "jointcal/vec3.h"

#include <math.h>
#include <stddef.h>

/// A zero that is further from the kept one is a new one: 2 deg; and the cosine of half of that.
#define ZERO_RAD 0.0349f
#define COS_HALF_ZERO 0.99985f

/// What all kinds share, from `out`: who and where it is, and what a result does not hold.
static jcal_kept_t begin(const jcal_kept_t *out, jcal_kept_kind_t kind, jcal_model_t model)
{
    jcal_kept_t kept = {0};
    kept.kind = kind;
    kept.model = model;
    kept.heading = (model == JCAL_MODEL_RIGID) ? JCAL_KEPT_HEADING_BY_AXES : JCAL_KEPT_HEADING_BY_CENTER;
    kept.joint = out->joint;
    kept.sequence = out->sequence;
    kept.serial1 = out->serial1;
    kept.serial2 = out->serial2;
    kept.has_zero = out->has_zero;
    kept.flexion_zero_rad = out->flexion_zero_rad;
    kept.pronation_zero_rad = out->pronation_zero_rad;
    kept.has_lag = out->has_lag;
    kept.lag_s = out->lag_s;
    kept.lag_bound_s = out->lag_bound_s;
    return kept;
}

jcal_status_t jcal_kept_from_hinge(const jcal_hinge_auto_result_t *result, jcal_kept_t *out)
{
    if ((result == NULL) || (out == NULL) || (result->hinge.head.status != JCAL_READY)) {
        return JCAL_ERR_ARG;
    }
    jcal_kept_t kept = begin(out, JCAL_KEPT_HINGE, result->model);
    kept.axis1 = result->hinge.axis1;
    kept.axis2 = result->hinge.axis2;
    kept.bound1_rad = result->hinge.uncertainty1_rad;
    kept.bound2_rad = result->hinge.uncertainty2_rad;
    kept.flexion_bound_rad = result->flexion_uncertainty_rad;
    kept.has_levers = result->has_levers;
    if (kept.has_levers) {
        kept.lever1_m = result->joint_to_sensor1_m;
        kept.lever2_m = result->joint_to_sensor2_m;
        kept.bound_lever1_m = JCAL_BOUND_UNKNOWN_M;
        kept.bound_lever2_m = JCAL_BOUND_UNKNOWN_M;
    }
    *out = kept;
    return JCAL_OK;
}

static void take_levers(const jcal_ball_result_t *result, jcal_kept_t *kept)
{
    kept->has_levers = true;
    kept->lever1_m = result->joint_to_sensor1_m;
    kept->lever2_m = result->joint_to_sensor2_m;
    kept->bound_lever1_m = result->uncertainty1_m;
    kept->bound_lever2_m = result->uncertainty2_m;
}

jcal_status_t jcal_kept_from_two_axes(const jcal_two_axes_result_t *result, jcal_kept_t *out)
{
    if ((result == NULL) || (out == NULL) || (result->ball.head.status != JCAL_READY)) {
        return JCAL_ERR_ARG;
    }
    jcal_kept_t kept = begin(out, JCAL_KEPT_TWO_AXES, JCAL_MODEL_FUNCTIONAL);
    kept.axis1 = result->axis1;
    kept.axis2 = result->axis2;
    kept.bound1_rad = result->uncertainty1_rad;
    kept.bound2_rad = result->uncertainty2_rad;
    take_levers(&result->ball, &kept);
    *out = kept;
    return JCAL_OK;
}

jcal_status_t jcal_kept_from_ball(const jcal_ball_result_t *result, const jcal_joint_frames_t *frames, jcal_kept_t *out)
{
    if ((result == NULL) || (out == NULL) || (result->head.status != JCAL_READY)) {
        return JCAL_ERR_ARG;
    }
    jcal_kept_t kept = begin(out, JCAL_KEPT_BALL, JCAL_MODEL_FUNCTIONAL);
    kept.flexion_zero_rad = 0.0f;
    kept.pronation_zero_rad = 0.0f;
    kept.has_zero = frames != NULL;
    if (kept.has_zero) {
        kept.frames = *frames;
    }
    take_levers(result, &kept);
    *out = kept;
    return JCAL_OK;
}

static bool is_further(jcal_vec3_t a, jcal_vec3_t b, float than)
{
    return jcal_vec3_norm(jcal_vec3_sub(a, b)) > than;
}

static bool is_other_frame(jcal_quat_t a, jcal_quat_t b)
{
    return fabsf((a.w * b.w) + (a.x * b.x) + (a.y * b.y) + (a.z * b.z)) < COS_HALF_ZERO;
}

static bool is_other_zero(const jcal_kept_t *kept, const jcal_kept_t *now)
{
    if (!now->has_zero) {
        return false;
    }
    if (!kept->has_zero) {
        return true;
    }
    if (now->kind == JCAL_KEPT_BALL) {
        return is_other_frame(kept->frames.q_b1_s1, now->frames.q_b1_s1) ||
               is_other_frame(kept->frames.q_b2_s2, now->frames.q_b2_s2);
    }
    return (fabsf(kept->flexion_zero_rad - now->flexion_zero_rad) > ZERO_RAD) ||
           (fabsf(kept->pronation_zero_rad - now->pronation_zero_rad) > ZERO_RAD);
}

static bool is_half(float now, float kept)
{
    return (now < kept) && (now <= (0.5f * kept)); /* none is half of zero */
}

static bool has_better_axes(const jcal_kept_t *kept, const jcal_kept_t *now)
{
    return (now->kind != JCAL_KEPT_BALL) &&
           (is_further(kept->axis1, now->axis1, kept->bound1_rad) ||
            is_further(kept->axis2, now->axis2, kept->bound2_rad) || is_half(now->bound1_rad, kept->bound1_rad) ||
            is_half(now->bound2_rad, kept->bound2_rad));
}

/// Levers without a bound of their own are worth nothing by themselves.
static bool has_better_levers(const jcal_kept_t *kept, const jcal_kept_t *now)
{
    if (!now->has_levers) {
        return false;
    }
    if (!kept->has_levers) {
        return true;
    }
    return is_further(kept->lever1_m, now->lever1_m, kept->bound_lever1_m) ||
           is_further(kept->lever2_m, now->lever2_m, kept->bound_lever2_m) ||
           is_half(now->bound_lever1_m, kept->bound_lever1_m) || is_half(now->bound_lever2_m, kept->bound_lever2_m);
}

bool jcal_kept_worth(const jcal_kept_t *kept, const jcal_kept_t *now)
{
    if (now == NULL) {
        return false;
    }
    if (kept == NULL) {
        return true;
    }
    const bool is_same = (kept->kind == now->kind) && (kept->model == now->model) && (kept->joint == now->joint) &&
                         (kept->serial1 == now->serial1) && (kept->serial2 == now->serial2);
    return !is_same || has_better_axes(kept, now) || has_better_levers(kept, now) || is_other_zero(kept, now);
}

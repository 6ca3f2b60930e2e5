/* SPDX-License-Identifier: MIT */
/// @file
/// The four vectors of hip and knee. See leg/places.h.
#include "leg/places.h"

#include "ball/bounds.h"
#include "joint/hysteresis.h"
#include "jointcal/head.h"
#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <float.h>
#include <math.h>

/// Factors beyond these are not skin's: another thigh's length, sensors exchanged, or nothing is known yet.
#define FACTOR_MIN 0.7f
#define FACTOR_MAX 1.3f
/// Share of a vector that remains in its bound once the common factor is taken out.
#define SHARE_LEFT 0.05f

#define HIP_THIGH ((unsigned)JCAL_CHAIN_HIP_TO_THIGH)
#define KNEE_THIGH ((unsigned)JCAL_CHAIN_KNEE_TO_THIGH)

static void take_joint(const jcal_ball_result_t *joint, unsigned first, jcal_leg_places_t *out)
{
    out->at_m[first] = joint->joint_to_sensor1_m;
    out->at_m[first + 1u] = joint->joint_to_sensor2_m;
    out->bound_m[first] = joint->uncertainty1_m;
    out->bound_m[first + 1u] = joint->uncertainty2_m;
    out->skin_m[first] = JCAL_BALL_SKIN1 * jcal_vec3_norm(joint->joint_to_sensor1_m);
    out->skin_m[first + 1u] = JCAL_BALL_SKIN2 * jcal_vec3_norm(joint->joint_to_sensor2_m);
}

static bool is_bounded(const jcal_leg_places_t *places, unsigned place)
{
    return places->bound_m[place] < JCAL_BOUND_UNKNOWN_M;
}

static void measure_length(jcal_leg_places_t *out)
{
    const bool bounded = is_bounded(out, HIP_THIGH) && is_bounded(out, KNEE_THIGH);
    out->length_m = jcal_vec3_norm(jcal_vec3_sub(out->at_m[HIP_THIGH], out->at_m[KNEE_THIGH]));
    out->length_bound_m = bounded ? jcal_min(out->bound_m[HIP_THIGH] + out->bound_m[KNEE_THIGH], JCAL_BOUND_UNKNOWN_M)
                                  : JCAL_BOUND_UNKNOWN_M;
}

/// Scales both vectors on the thigh, whose bounds are known.
static void scale(float factor, jcal_leg_places_t *out)
{
    const float hip_m = jcal_vec3_norm(out->at_m[HIP_THIGH]);
    const float knee_m = jcal_vec3_norm(out->at_m[KNEE_THIGH]);
    const float share = hip_m / jcal_max(hip_m + knee_m, FLT_MIN);
    const float rest_hip_m = jcal_max(out->bound_m[HIP_THIGH] - out->skin_m[HIP_THIGH], 0.0f);
    const float rest_knee_m = jcal_max(out->bound_m[KNEE_THIGH] - out->skin_m[KNEE_THIGH], 0.0f);
    const float common_m = ((1.0f - share) * rest_hip_m) + (share * rest_knee_m);
    out->at_m[HIP_THIGH] = jcal_vec3_scale(out->at_m[HIP_THIGH], factor);
    out->at_m[KNEE_THIGH] = jcal_vec3_scale(out->at_m[KNEE_THIGH], factor);
    out->skin_m[HIP_THIGH] = SHARE_LEFT * factor * hip_m;
    out->skin_m[KNEE_THIGH] = SHARE_LEFT * factor * knee_m;
    out->bound_m[HIP_THIGH] = (factor * jcal_max(rest_hip_m, common_m)) + out->skin_m[HIP_THIGH];
    out->bound_m[KNEE_THIGH] = (factor * jcal_max(rest_knee_m, common_m)) + out->skin_m[KNEE_THIGH];
    out->factor = factor;
    measure_length(out);
}

/// What the known length says of both vectors on the thigh.
static void apply_length(float known_m, jcal_leg_places_t *out)
{
    const float factor = known_m / jcal_max(out->length_m, FLT_MIN);
    if (jcal_within(factor, FACTOR_MIN, FACTOR_MAX)) {
        scale(factor, out);
        return;
    }
    out->length_refused = true;
    out->length_possible = fabsf(known_m - out->length_m) <= out->length_bound_m;
    out->bound_m[HIP_THIGH] = JCAL_BOUND_UNKNOWN_M;
    out->bound_m[KNEE_THIGH] = JCAL_BOUND_UNKNOWN_M;
    out->length_bound_m = JCAL_BOUND_UNKNOWN_M;
}

void jcal_leg_places(const jcal_leg_t *self, const jcal_ball_result_t joints[2], jcal_leg_places_t *out)
{
    take_joint(&joints[0], 0u, out);
    take_joint(&joints[1], 2u, out);
    out->factor = 1.0f;
    out->length_refused = false;
    out->length_possible = false;
    out->length_m = 0.0f;
    out->length_bound_m = JCAL_BOUND_UNKNOWN_M;
    if (joints[0].has_estimate && joints[1].has_estimate) {
        measure_length(out);
        if ((self->cfg.thigh_length_m > 0.0f) && (out->length_bound_m < JCAL_BOUND_UNKNOWN_M)) {
            apply_length(self->cfg.thigh_length_m, out);
        }
    }
    for (unsigned i = 0u; i < JCAL_CHAIN_PLACES; ++i) {
        const float slack = self->was_known[i] ? JCAL_HYSTERESIS : 1.0f;
        out->known[i] =
            (joints[i / 2u].head.status == JCAL_READY) && (out->bound_m[i] <= (slack * self->cfg.max_lever_m));
    }
}

void jcal_leg_places_now(const jcal_leg_t *self, jcal_ball_result_t joints[2], jcal_leg_places_t *out)
{
    (void)jcal_ball_get(&self->joint[0], &joints[0]); /* the only error is a null pointer */
    (void)jcal_ball_get(&self->joint[1], &joints[1]);
    jcal_leg_places(self, joints, out);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// A hinge of either kind: which of two models is believed. See hinge_auto.h.
#include "joint/hysteresis.h"
#include "jointcal/functional_pair.h"
#include "jointcal/hinge_auto.h"
#include "jointcal/joint_angles.h"
#include "jointcal/joint_heading.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "sample/ring.h"

#include <math.h>
#include <stddef.h>

/// Where the rates agree about an axis to this share of themselves, the segments are rigid, and the rigid model will find the axis
/// better than the functional one, or has a reason not to.
#define RIGID_RATE_SHARE 0.08f

/// What the functional model must say before the rigid one is believed. Lengths of rates, which the rigid model begins with, can be those of
/// a hinge by chance or by a fault: two sensors on one stiff body that vibrate, a component with the wrong sign, frames exchanged. Levels
/// and directions then do not agree. A tenth more or twice of what rigs and simulated soft tissue of 1.5 deg ever showed (docs/METHOD_PEOPLE.md, section 8).
#define STIFFNESS_MIN 0.05f
#define BEND_MIN_RAD 0.14f
#define RATE_SHARE_MAX 0.15f
#define ALONG_MIN 0.9f

/// Memory of the heading that follows from the rigid model's axes, s.
#define HEADING_MEMORY_S 10.0f

jcal_hinge_auto_config_t jcal_hinge_auto_config_default(void)
{
    const jcal_hinge_auto_config_t config = {jcal_hinge_config_default(),
                                             jcal_functional_config_default().max_flexion_rad};
    return config;
}

/// The functional model's part of the settings.
static jcal_functional_config_t functional_config(const jcal_hinge_auto_config_t *config)
{
    jcal_functional_config_t out = jcal_functional_config_default();
    out.max_bound_rad = config->hinge.max_bound_rad;
    out.max_flexion_rad = config->max_flexion_rad;
    out.sign_hint = config->hinge.sign_hint;
    out.axis1_toward = config->hinge.axis1_toward;
    return out;
}

const char *jcal_hinge_auto_config_check(const jcal_hinge_auto_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *const wrong = jcal_hinge_config_check(&config->hinge);
    if (wrong != NULL) {
        return wrong;
    }
    const jcal_functional_config_t functional = functional_config(config);
    return jcal_functional_config_check(&functional);
}

jcal_status_t jcal_hinge_auto_init(jcal_hinge_auto_t *self, const jcal_hinge_auto_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_hinge_auto_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_functional_config_t functional = functional_config(config);
    jcal_clear(&self->inbox, sizeof self->inbox);
    self->believed = false;
    const jcal_status_t status = jcal_hinge_init(&self->rigid, &config->hinge);
    return (status == JCAL_OK) ? jcal_functional_pair_init(&self->functional, &functional, &config->hinge.gate)
                               : status;
}

/// What the functional model has against a rigid hinge.
static jcal_reason_t objection(const jcal_functional_t *functional, float slack)
{
    const jcal_functional_verdict_t *const verdict = &functional->verdict;
    if (!functional->search.has_estimate || !(verdict->bend_rad > 0.0f)) {
        return JCAL_REASON_UNCERTAIN; /* not judged yet */
    }
    if (!((slack * verdict->stiffness) >= STIFFNESS_MIN) || !((slack * verdict->bend_rad) >= BEND_MIN_RAD)) {
        return JCAL_REASON_NO_BEND;
    }
    const float across2 = functional->point.size[JCAL_FAMILY_RATE];
    if (!(across2 <= (slack * slack * RATE_SHARE_MAX * RATE_SHARE_MAX)) || !((slack * verdict->share) >= ALONG_MIN)) {
        return JCAL_REASON_DOES_NOT_FIT;
    }
    return JCAL_REASON_NONE;
}

/// The rigid model says ready, and the functional one objects.
static void say_objection(jcal_head_t *head, jcal_reason_t reason)
{
    head->status = JCAL_COLLECTING;
    head->reason = reason;
    head->weak = JCAL_WEAK_AXIS1;
    head->hint = (reason == JCAL_REASON_DOES_NOT_FIT) ? JCAL_HINT_CHECK_SENSORS : JCAL_HINT_MOVE_JOINT;
}

/// The heading offset by the rigid model's axes: the functional model may take longer to find the pairing of their signs.
static void follow_heading(jcal_hinge_auto_t *self, const jcal_hinge_result_t *hinge, uint64_t t_us, bool goes_on)
{
    const jcal_status_t status =
        goes_on ? jcal_joint_heading_improve(&self->heading, hinge->axis1, hinge->axis2, 0.0f)
                : jcal_joint_heading_hinge(&self->heading, hinge->axis1, hinge->axis2, HEADING_MEMORY_S);
    if (status != JCAL_OK) {
        return; /* axes of a hinge that is ready have directions */
    }
    const jcal_orientation_pair_t pair = {t_us, jcal_hinge_auto_orientation(self, 1u),
                                          jcal_hinge_auto_orientation(self, 2u)};
    (void)jcal_joint_heading_push(&self->heading, &pair);
}

jcal_status_t jcal_hinge_auto_update(jcal_hinge_auto_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_hinge_result_t before;
    jcal_hinge_result_t after;
    (void)jcal_hinge_get(&self->rigid, &before);
    const jcal_status_t status = jcal_hinge_update(&self->rigid, pair);
    (void)jcal_hinge_get(&self->rigid, &after);
    (void)jcal_functional_pair_update(&self->functional, pair);
    if ((after.head.status == JCAL_MOVED) && (before.head.status != JCAL_MOVED)) {
        (void)jcal_functional_reset(&self->functional.joint); /* what it learnt is of the sensors as they sat before */
    }
    const bool was_believed = self->believed;
    const float slack = was_believed ? JCAL_HYSTERESIS : 1.0f;
    self->believed =
        (after.head.status == JCAL_READY) && (objection(&self->functional.joint, slack) == JCAL_REASON_NONE);
    if (self->believed) {
        follow_heading(self, &after, pair->t_us, was_believed);
    }
    return status;
}

jcal_status_t jcal_hinge_auto_push(jcal_hinge_auto_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_room(&self->inbox.ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    self->inbox.slots[slot] = *pair;
    jcal_ring_publish(&self->inbox.ring);
    return JCAL_OK;
}

jcal_status_t jcal_hinge_auto_step(jcal_hinge_auto_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_peek(&self->inbox.ring, &slot)) {
        return JCAL_IDLE;
    }
    const jcal_pair_t pair = self->inbox.slots[slot];
    jcal_ring_release(&self->inbox.ring);
    return jcal_hinge_auto_update(self, &pair);
}

/// True if the rates say that the segments are not rigid, so that the functional model is the one to ask.
static bool is_person(const jcal_functional_result_t *functional)
{
    return functional->has_axes && (functional->rate_share > RIGID_RATE_SHARE);
}

/// The functional model's word in the form of a hinge's.
static void say_functional(const jcal_functional_result_t *from, jcal_hinge_result_t *out)
{
    out->head.status = from->head.status;
    out->head.weak = from->head.weak;
    out->head.hint = from->head.hint;
    out->head.reason = from->head.reason;
    out->has_axes = from->has_axes;
    out->axis1 = from->axis1;
    out->axis2 = from->axis2;
    out->uncertainty1_rad = from->uncertainty1_rad;
    out->uncertainty2_rad = from->uncertainty2_rad;
    out->sign_margin = from->sign_margin;
    out->progress_axis1 = from->progress_axis1;
    out->progress_axis2 = from->progress_axis2;
    out->progress_sign = from->progress_sign;
}

static jcal_ready_for_t purpose(const jcal_hinge_auto_result_t *result, const jcal_functional_result_t *functional)
{
    if (result->hinge.head.status != JCAL_READY) {
        return JCAL_FOR_NOTHING;
    }
    return ((result->model == JCAL_MODEL_RIGID) || functional->for_axes) ? JCAL_FOR_AXES : JCAL_FOR_FLEXION;
}

jcal_status_t jcal_hinge_auto_get(const jcal_hinge_auto_t *self, jcal_hinge_auto_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_functional_result_t functional;
    *out = (jcal_hinge_auto_result_t){0};
    (void)jcal_hinge_get(&self->rigid, &out->hinge);
    (void)jcal_functional_pair_get(&self->functional, &functional);
    jcal_head_t *const rigid = &out->hinge.head;
    if ((rigid->status == JCAL_READY) && !self->believed) {
        const jcal_reason_t reason = objection(&self->functional.joint, 1.0f);
        say_objection(rigid, (reason == JCAL_REASON_NONE) ? JCAL_REASON_UNCERTAIN : reason);
    }
    const bool settled = (rigid->status == JCAL_READY) || (rigid->status == JCAL_MOVED);
    const bool unfit = functional.has_axes && (rigid->reason == JCAL_REASON_DOES_NOT_FIT);
    if (!settled && (is_person(&functional) || (unfit && (functional.head.status != JCAL_READY)))) {
        out->model = JCAL_MODEL_FUNCTIONAL;
        say_functional(&functional, &out->hinge);
    }
    out->hinge.head.overrun += self->inbox.ring.overrun;
    out->ready_for = purpose(out, &functional);
    out->bend_rad = functional.bend_rad;
    out->flexion_uncertainty_rad = jcal_functional_flexion_error(
        &self->functional.joint, jcal_max(out->hinge.uncertainty1_rad, out->hinge.uncertainty2_rad));
    out->gravity_off_m_s2 = functional.gravity_off_m_s2;
    out->heading = functional.heading;
    if (self->believed) {
        (void)jcal_joint_heading_get(&self->heading, &out->heading);
    }
    out->has_levers = functional.has_axes;
    out->joint_to_sensor1_m = functional.joint_to_sensor1_m;
    out->joint_to_sensor2_m = functional.joint_to_sensor2_m;
    return JCAL_OK;
}

/// The angle about the rigid model's axes.
static float rigid_flexion(const jcal_hinge_auto_t *self, const jcal_hinge_auto_result_t *result)
{
    jcal_joint_frames_t frames;
    if (!result->heading.known || (jcal_frames_hinge(result->hinge.axis1, result->hinge.axis2, &frames) != JCAL_OK)) {
        return NAN;
    }
    return jcal_hinge_angles(jcal_joint_orientation(&frames, jcal_hinge_auto_orientation(self, 1u),
                                                    jcal_hinge_auto_orientation(self, 2u), result->heading.heading_rad))
        .flexion_rad;
}

float jcal_hinge_auto_flexion(const jcal_hinge_auto_t *self)
{
    if (self == NULL) {
        return NAN;
    }
    jcal_hinge_auto_result_t result;
    jcal_functional_result_t functional;
    (void)jcal_hinge_auto_get(self, &result);
    (void)jcal_functional_pair_get(&self->functional, &functional);
    if (self->believed) {
        return rigid_flexion(self, &result);
    }
    const float sign = (jcal_vec3_dot(result.hinge.axis1, functional.axis1) < 0.0f) ? -1.0f : 1.0f;
    return sign * jcal_functional_pair_flexion(&self->functional);
}

jcal_quat_t jcal_hinge_auto_orientation(const jcal_hinge_auto_t *self, unsigned which)
{
    if (self == NULL) {
        return jcal_sensor_orientation(NULL);
    }
    return jcal_sensor_orientation((which == 2u) ? &self->functional.sensor2 : &self->functional.sensor1);
}

const char *jcal_model_string(jcal_model_t model)
{
    return (model == JCAL_MODEL_FUNCTIONAL) ? "functional" : "rigid";
}

const char *jcal_ready_for_string(jcal_ready_for_t ready_for)
{
    switch (ready_for) {
    case JCAL_FOR_AXES:
        return "axes";
    case JCAL_FOR_FLEXION:
        return "flexion";
    case JCAL_FOR_NOTHING:
    default:
        return NULL;
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// What a hinge of either kind tells its user.
#include "functional/twist.h"
#include "jointcal/functional_pair.h"
#include "jointcal/hinge_auto.h"
#include "jointcal/joint_heading.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

/// The rigid model says ready, and the functional one objects.
static void say_objection(jcal_head_t *head, jcal_reason_t reason)
{
    head->status = JCAL_COLLECTING;
    head->reason = reason;
    head->weak = JCAL_WEAK_AXIS1;
    head->hint = (reason == JCAL_REASON_DOES_NOT_FIT) ? JCAL_HINT_CHECK_SENSORS : JCAL_HINT_MOVE_JOINT;
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
        say_objection(rigid, (jcal_reason_t)self->objection);
    }
    const bool settled = (rigid->status == JCAL_READY) || (rigid->status == JCAL_MOVED);
    const bool unfit = functional.has_axes && (rigid->reason == JCAL_REASON_DOES_NOT_FIT);
    if (!settled && (self->person || (unfit && (functional.head.status != JCAL_READY)))) {
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
    if (self->follows && (out->model == JCAL_MODEL_RIGID)) {
        (void)jcal_joint_heading_get(&self->heading, &out->heading);
    }
    out->has_levers = functional.has_axes;
    out->joint_to_sensor1_m = functional.joint_to_sensor1_m;
    out->joint_to_sensor2_m = functional.joint_to_sensor2_m;
    return JCAL_OK;
}

float jcal_hinge_auto_flexion(const jcal_hinge_auto_t *self)
{
    if (self == NULL) {
        return NAN;
    }
    jcal_hinge_auto_result_t result;
    (void)jcal_hinge_auto_get(self, &result);
    if (!result.hinge.has_axes || !result.heading.known) {
        return NAN;
    }
    const uint8_t *const zero = self->has_zero ? self->zero : self->functional.joint.track.zero;
    const jcal_twist_t twist = {result.hinge.axis1, result.hinge.axis2, {zero[0], zero[1]}};
    return jcal_twist_angle(&twist, jcal_cis(result.heading.heading_rad), jcal_hinge_auto_orientation(self, 1u),
                            jcal_hinge_auto_orientation(self, 2u));
}

jcal_quat_t jcal_hinge_auto_orientation(const jcal_hinge_auto_t *self, unsigned which)
{
    if (self == NULL) {
        return jcal_sensor_orientation(NULL);
    }
    return jcal_sensor_orientation((which == 2u) ? &self->functional.sensors.sensor2
                                                 : &self->functional.sensors.sensor1);
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
    case JCAL_FOR_ANGLES:
        return "angles";
    case JCAL_FOR_NOTHING:
    default:
        return NULL;
    }
}

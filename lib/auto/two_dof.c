/* SPDX-License-Identifier: MIT */
/// @file
/// A joint with two axes of either kind. See two_dof_auto.h.
#include "jointcal/quat.h"
#include "jointcal/two_axes_pair.h"
#include "jointcal/two_dof_auto.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

/// Memory of the carrying angle, s, and the longest step that counts in it.
#define CARRYING_S 10.0f
#define STEP_MAX_US 1000000u

jcal_two_dof_auto_config_t jcal_two_dof_auto_config_default(void)
{
    const jcal_two_dof_auto_config_t config = {jcal_two_dof_config_default(), jcal_two_axes_config_default()};
    return config;
}

const char *jcal_two_dof_auto_config_check(const jcal_two_dof_auto_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *const wrong = jcal_two_dof_config_check(&config->two_dof);
    return (wrong != NULL) ? wrong : jcal_two_axes_config_check(&config->people);
}

static void forget(jcal_two_dof_auto_t *self)
{
    self->carrying = 0.0f;
    self->has_carrying = false;
    self->last_us = 0u;
}

jcal_status_t jcal_two_dof_auto_init(jcal_two_dof_auto_t *self, const jcal_two_dof_auto_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_two_dof_auto_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    self->max_bound_rad = config->two_dof.max_bound_rad;
    forget(self);
    const jcal_status_t status = jcal_two_dof_init(&self->rigid, &config->two_dof);
    return (status == JCAL_OK) ? jcal_two_axes_pair_init(&self->functional, &config->people, NULL) : status;
}

jcal_status_t jcal_two_dof_auto_reset(jcal_two_dof_auto_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    forget(self);
    const jcal_two_axes_config_t config = self->functional.joint.cfg;
    const jcal_gate_config_t limits = self->functional.sensors.limits;
    const jcal_status_t status = jcal_two_dof_reset(&self->rigid);
    return (status == JCAL_OK) ? jcal_two_axes_pair_init(&self->functional, &config, &limits) : status;
}

jcal_status_t jcal_two_dof_auto_restart(jcal_two_dof_auto_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_two_dof_reset(&self->rigid);
}

/// j1 . R1' Rz R2 j2 is the sine of the carrying angle, but for what the axes are off.
static void follow_carrying(jcal_two_dof_auto_t *self, uint64_t t_us)
{
    const jcal_axis_found_t *const found = self->functional.joint.windows.found;
    const uint64_t step_us = t_us - self->last_us;
    self->last_us = t_us;
    const jcal_quat_t relative = jcal_two_axes_pair_relative(&self->functional);
    if ((found[0].windows == 0u) || (found[1].windows == 0u) || isnan(relative.w)) {
        self->has_carrying = false;
        return;
    }
    const jcal_vec3_t axis2 = jcal_quat_rotate(relative, found[1].axis);
    const float sine = jcal_vec3_dot(found[0].axis, axis2);
    const float step_s = (step_us < STEP_MAX_US) ? (1e-6f * (float)(uint32_t)step_us) : 0.0f;
    const float share = self->has_carrying ? (step_s / (step_s + CARRYING_S)) : 1.0f;
    self->carrying += share * (sine - self->carrying);
    self->has_carrying = true;
}

jcal_status_t jcal_two_dof_auto_update(jcal_two_dof_auto_t *self, const jcal_pair_t *pair,
                                       const jcal_orientation_pair_t *orientations)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t taken = jcal_two_axes_pair_update(&self->functional, pair);
    if (taken == JCAL_OK) {
        follow_carrying(self, pair->t_us);
    }
    if (orientations != NULL) {
        return jcal_two_dof_update(&self->rigid, orientations);
    }
    if (taken != JCAL_OK) {
        return taken;
    }
    const jcal_orientation_pair_t own = {pair->t_us, jcal_two_dof_auto_orientation(self, 1u),
                                         jcal_two_dof_auto_orientation(self, 2u)};
    return jcal_two_dof_update(&self->rigid, &own);
}

/// The functional model's word in the form of the rigid one's; its counters stay.
static void say_functional(const jcal_two_dof_auto_t *self, const jcal_two_axes_result_t *from,
                           jcal_two_dof_result_t *out)
{
    out->head.status = from->ball.head.status;
    out->head.weak = from->ball.head.weak;
    out->head.hint = from->ball.head.hint;
    out->head.reason = from->ball.head.reason;
    out->has_axes = (from->windows1 > 0u) || (from->windows2 > 0u);
    out->axis1 = from->axis1;
    out->axis2 = from->axis2;
    out->uncertainty1_rad = from->uncertainty1_rad;
    out->uncertainty2_rad = from->uncertainty2_rad;
    out->heading_offset_rad = from->ball.heading.heading_rad;
    out->uncertainty_heading_rad = from->ball.uncertainty_heading_rad;
    out->progress_axis1 = from->progress_axis1;
    out->progress_axis2 = from->progress_axis2;
    out->progress_heading = from->ball.progress_heading;
    const jcal_axis_found_t *const found = self->functional.joint.windows.found;
    const float signs = jcal_vec3_dot(found[0].axis, from->axis1) * jcal_vec3_dot(found[1].axis, from->axis2);
    const float sine =
        self->has_carrying ? jcal_max(-1.0f, jcal_min(1.0f, copysignf(1.0f, signs) * self->carrying)) : 0.0f;
    out->carrying_angle_rad = jcal_atan2(sine, sqrtf(jcal_max(1.0f - (sine * sine), 0.0f)));
}

/// True if the rigid model's word stands: it is ready, or was until a sensor moved, or what it is given is no good.
static bool is_settled(const jcal_head_t *rigid)
{
    switch (rigid->reason) {
    case JCAL_REASON_BAD_SAMPLES:
    case JCAL_REASON_WRONG_UNITS_GYR:
    case JCAL_REASON_WRONG_UNITS_ACC:
    case JCAL_REASON_RATE_TOO_LOW:
        return true;
    default:
        return (rigid->status == JCAL_READY) || (rigid->status == JCAL_MOVED);
    }
}

static jcal_ready_for_t purpose(const jcal_two_dof_auto_result_t *result, float max_bound_rad)
{
    const jcal_two_dof_result_t *const said = &result->two_dof;
    if (said->head.status != JCAL_READY) {
        return JCAL_FOR_NOTHING;
    }
    const float axes = jcal_max(said->uncertainty1_rad, said->uncertainty2_rad);
    const bool is_sharp = jcal_max(axes, said->uncertainty_heading_rad) <= max_bound_rad;
    return ((result->model == JCAL_MODEL_RIGID) || is_sharp) ? JCAL_FOR_AXES : JCAL_FOR_ANGLES;
}

jcal_status_t jcal_two_dof_auto_get(const jcal_two_dof_auto_t *self, jcal_two_dof_auto_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_two_axes_result_t functional;
    *out = (jcal_two_dof_auto_result_t){0};
    (void)jcal_two_dof_get(&self->rigid, &out->two_dof);
    (void)jcal_two_axes_pair_get(&self->functional, &functional);
    out->ball = functional.ball;
    const jcal_head_t *const rigid = &out->two_dof.head;
    const bool rigid_ready = rigid->status == JCAL_READY;
    out->for_heading = rigid_ready || functional.for_heading;
    out->for_axis1 = rigid_ready || functional.for_axis1;
    out->for_axis2 = rigid_ready || functional.for_axis2;
    const bool knows_axes = (functional.windows1 > 0u) || (functional.windows2 > 0u);
    const bool is_joint = functional.ball.uncertainty_heading_rad < JCAL_BOUND_UNKNOWN_RAD;
    if (!is_settled(rigid) && is_joint && (knows_axes || (rigid->reason == JCAL_REASON_DOES_NOT_FIT))) {
        out->model = JCAL_MODEL_FUNCTIONAL;
        say_functional(self, &functional, &out->two_dof);
    }
    out->ready_for = purpose(out, self->max_bound_rad);
    return JCAL_OK;
}

jcal_quat_t jcal_two_dof_auto_orientation(const jcal_two_dof_auto_t *self, unsigned which)
{
    if (self == NULL) {
        return jcal_sensor_orientation(NULL);
    }
    const jcal_sensor_pair_t *const sensors = &self->functional.sensors;
    return jcal_sensor_orientation((which == 2u) ? &sensors->sensor2 : &sensors->sensor1);
}

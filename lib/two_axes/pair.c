/* SPDX-License-Identifier: MIT */
/// @file
/// A joint with two axes and sensor stages of its own. See two_axes_pair.h.
#include "imu/pair.h"
#include "joint/head.h"
#include "jointcal/two_axes_pair.h"

#include <stddef.h>

jcal_status_t jcal_two_axes_pair_init(jcal_two_axes_pair_t *self, const jcal_two_axes_config_t *config,
                                      const jcal_gate_config_t *limits)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_two_axes_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_status_t status = jcal_sensor_pair_init(&self->sensors, limits);
    return (status == JCAL_OK) ? jcal_two_axes_init(&self->joint, config) : status;
}

jcal_status_t jcal_two_axes_pair_update(jcal_two_axes_pair_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_sensor_pair_step_t step = jcal_sensor_pair_push(&self->sensors, pair, self->joint.cfg.ball.slices_per_s);
    if (step.has_ticks) {
        (void)jcal_two_axes_add(&self->joint, jcal_sensor_tick(&self->sensors.sensor1),
                                jcal_sensor_tick(&self->sensors.sensor2));
    }
    for (unsigned k = 0u; k < step.slices; ++k) {
        if (jcal_two_axes_step(&self->joint) != JCAL_OK) {
            break;
        }
    }
    return step.status;
}

jcal_status_t jcal_two_axes_pair_get(const jcal_two_axes_pair_t *self, jcal_two_axes_result_t *out)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t status = jcal_two_axes_get(&self->joint, out);
    if (status == JCAL_OK) {
        jcal_head_t *const head = &out->ball.head;
        jcal_head_count(head, self->sensors.gate.samples, self->sensors.gate.rejected_by);
        jcal_head_complain(head, jcal_gate_complaint(&self->sensors.gate), JCAL_WEAK_HEADING);
        const bool trusted = jcal_gate_complaint(&self->sensors.gate) == JCAL_REASON_NONE;
        out->for_heading = out->for_heading && trusted;
        out->for_axis1 = out->for_axis1 && trusted;
        out->for_axis2 = out->for_axis2 && trusted;
        out->ball.for_center1 = out->ball.for_center1 && trusted;
        out->ball.for_center2 = out->ball.for_center2 && trusted;
    }
    return status;
}

jcal_quat_t jcal_two_axes_pair_relative(const jcal_two_axes_pair_t *self)
{
    return jcal_ball_relative((self == NULL) ? NULL : &self->joint.ball,
                              jcal_sensor_orientation((self == NULL) ? NULL : &self->sensors.sensor1),
                              jcal_sensor_orientation((self == NULL) ? NULL : &self->sensors.sensor2));
}

/* SPDX-License-Identifier: MIT */
/// @file
/// A ball joint with sensor stages of its own. See ball_pair.h.
#include "imu/pair.h"
#include "joint/head.h"
#include "jointcal/ball_pair.h"

#include <stddef.h>

jcal_status_t jcal_ball_pair_init(jcal_ball_pair_t *self, const jcal_ball_config_t *config,
                                  const jcal_gate_config_t *limits)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_ball_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_status_t status = jcal_sensor_pair_init(&self->sensors, limits);
    return (status == JCAL_OK) ? jcal_ball_init(&self->joint, config) : status;
}

jcal_status_t jcal_ball_pair_update(jcal_ball_pair_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_sensor_pair_step_t step = jcal_sensor_pair_push(&self->sensors, pair, self->joint.cfg.slices_per_s);
    if (step.has_ticks) {
        (void)jcal_ball_add(&self->joint, jcal_sensor_tick(&self->sensors.sensor1),
                            jcal_sensor_tick(&self->sensors.sensor2));
    }
    for (unsigned k = 0u; k < step.slices; ++k) {
        if (jcal_ball_step(&self->joint) != JCAL_OK) {
            break;
        }
    }
    return step.status;
}

jcal_status_t jcal_ball_pair_get(const jcal_ball_pair_t *self, jcal_ball_result_t *out)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t status = jcal_ball_get(&self->joint, out);
    if (status == JCAL_OK) {
        jcal_head_count(&out->head, self->sensors.gate.samples, self->sensors.gate.rejected_by);
        jcal_head_complain(&out->head, jcal_gate_complaint(&self->sensors.gate), JCAL_WEAK_HEADING);
        out->for_center1 = out->for_center1 && (out->head.status == JCAL_READY);
        out->for_center2 = out->for_center2 && (out->head.status == JCAL_READY);
    }
    return status;
}

jcal_quat_t jcal_ball_pair_relative(const jcal_ball_pair_t *self)
{
    return jcal_ball_relative((self == NULL) ? NULL : &self->joint,
                              jcal_sensor_orientation((self == NULL) ? NULL : &self->sensors.sensor1),
                              jcal_sensor_orientation((self == NULL) ? NULL : &self->sensors.sensor2));
}

/* SPDX-License-Identifier: MIT */
/// @file
/// A functional joint with sensor stages of its own. See functional_pair.h.
#include "imu/pair.h"
#include "joint/head.h"
#include "jointcal/functional_pair.h"

#include <math.h>
#include <stddef.h>

jcal_status_t jcal_functional_pair_init(jcal_functional_pair_t *self, const jcal_functional_config_t *config,
                                        const jcal_gate_config_t *limits)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_functional_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_status_t status = jcal_sensor_pair_init(&self->sensors, limits);
    return (status == JCAL_OK) ? jcal_functional_init(&self->joint, config) : status;
}

jcal_status_t jcal_functional_pair_update(jcal_functional_pair_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_sensor_pair_step_t step = jcal_sensor_pair_push(&self->sensors, pair, self->joint.cfg.slices_per_s);
    if (step.has_ticks) {
        (void)jcal_functional_add(&self->joint, jcal_sensor_tick(&self->sensors.sensor1),
                                  jcal_sensor_tick(&self->sensors.sensor2));
    }
    for (unsigned k = 0u; k < step.slices; ++k) {
        if (jcal_functional_step(&self->joint) != JCAL_OK) {
            break;
        }
    }
    return step.status;
}

jcal_status_t jcal_functional_pair_get(const jcal_functional_pair_t *self, jcal_functional_result_t *out)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t status = jcal_functional_get(&self->joint, out);
    if (status == JCAL_OK) {
        jcal_head_count(&out->head, self->sensors.gate.samples, self->sensors.gate.rejected_by);
        jcal_head_complain(&out->head, jcal_gate_complaint(&self->sensors.gate), JCAL_WEAK_AXIS1);
        out->for_axes = out->for_axes && (out->head.status == JCAL_READY);
        out->for_flexion = out->for_flexion && (out->head.status == JCAL_READY);
    }
    return status;
}

float jcal_functional_pair_flexion(const jcal_functional_pair_t *self)
{
    return (self == NULL) ? NAN
                          : jcal_functional_flexion(&self->joint, jcal_sensor_orientation(&self->sensors.sensor1),
                                                    jcal_sensor_orientation(&self->sensors.sensor2));
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Two sensors whose readings come in pairs. See imu/pair.h.
#include "imu/pair.h"

#include "imu/follow.h"

#include <stddef.h>

jcal_status_t jcal_sensor_pair_init(jcal_sensor_pair_t *self, const jcal_gate_config_t *limits)
{
    const jcal_gate_config_t gate = (limits != NULL) ? *limits : jcal_gate_config_default();
    if (jcal_gate_config_check(&gate) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    self->limits = gate;
    self->last_us = 0u;
    jcal_gate_init(&self->gate);
    const jcal_status_t status = jcal_sensor_init(&self->sensor1);
    return (status == JCAL_OK) ? jcal_sensor_init(&self->sensor2) : status;
}

jcal_sensor_pair_step_t jcal_sensor_pair_push(jcal_sensor_pair_t *self, const jcal_pair_t *pair, float slices_per_s)
{
    const jcal_reject_t reject = jcal_gate_check(&self->gate, &self->limits, pair);
    if (!jcal_follow_may(reject) || !jcal_sensor_may_take(&pair->imu1) || !jcal_sensor_may_take(&pair->imu2)) {
        const jcal_sensor_pair_step_t nothing = {JCAL_REJECTED, false, 0u};
        return nothing; /* the gate does not look at the values of the first reading after a gap */
    }
    const jcal_reading_t reading1 = {pair->t_us, pair->imu1};
    const jcal_reading_t reading2 = {pair->t_us, pair->imu2};
    const jcal_status_t of1 = jcal_sensor_push(&self->sensor1, &reading1);
    const jcal_status_t of2 = jcal_sensor_push(&self->sensor2, &reading2);
    const jcal_sensor_pair_step_t out = {(reject == JCAL_REJECT_NONE) ? JCAL_OK : JCAL_REJECTED,
                                         (of1 == JCAL_TICK) && (of2 == JCAL_TICK),
                                         jcal_follow_slices(slices_per_s, pair->t_us - self->last_us)};
    self->last_us = pair->t_us;
    return out;
}

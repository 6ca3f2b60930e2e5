/* SPDX-License-Identifier: MIT */
/// @file
/// A functional joint with sensor stages of its own. See functional_pair.h.
#include "joint/head.h"
#include "jointcal/functional_pair.h"

#include <math.h>
#include <stddef.h>

/// Readings further apart than this, us, have as many slices between them as fit.
#define LONGEST_US 1000000u
/// Most slices in one update.
#define SLICES_MAX 16u

/// Slices that may be done for a reading so long after the one before: those of a tick are spread over its readings.
static unsigned slices_for(float slices_per_s, uint64_t dt_us)
{
    const float dt_s = (dt_us < LONGEST_US) ? ((float)(uint32_t)dt_us * 1e-6f) : 1.0f;
    const float due = 1.0f + (0.9f * slices_per_s * dt_s); /* less: samples are not evenly apart */
    return (due < (float)SLICES_MAX) ? (unsigned)due : SLICES_MAX;
}

jcal_status_t jcal_functional_pair_init(jcal_functional_pair_t *self, const jcal_functional_config_t *config,
                                        const jcal_gate_config_t *limits)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_gate_config_t gate = (limits != NULL) ? *limits : jcal_gate_config_default();
    if ((jcal_functional_config_check(config) != NULL) || (jcal_gate_config_check(&gate) != NULL)) {
        return JCAL_ERR_CONFIG;
    }
    self->limits = gate;
    self->last_us = 0u;
    jcal_gate_init(&self->gate);
    jcal_status_t status = jcal_sensor_init(&self->sensor1);
    status = (status == JCAL_OK) ? jcal_sensor_init(&self->sensor2) : status;
    return (status == JCAL_OK) ? jcal_functional_init(&self->joint, config) : status;
}

/// True if orientations are better followed with this reading than without: what is clipped, or repeats the one before in place of a lost
/// packet, is the best that is known of its moment, and a turn that is left out is lost.
static bool may_be_followed(jcal_reject_t reject)
{
    return (reject == JCAL_REJECT_NONE) || (reject == JCAL_REJECT_SATURATED) || (reject == JCAL_REJECT_REPEATED) ||
           (reject == JCAL_REJECT_GAP);
}

jcal_status_t jcal_functional_pair_update(jcal_functional_pair_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_reject_t reject = jcal_gate_check(&self->gate, &self->limits, pair);
    if (!may_be_followed(reject) || !jcal_sensor_may_take(&pair->imu1) || !jcal_sensor_may_take(&pair->imu2)) {
        return JCAL_REJECTED; /* the gate does not look at the values of the first reading after a gap */
    }
    const jcal_reading_t reading1 = {pair->t_us, pair->imu1};
    const jcal_reading_t reading2 = {pair->t_us, pair->imu2};
    const jcal_status_t of1 = jcal_sensor_push(&self->sensor1, &reading1);
    const jcal_status_t of2 = jcal_sensor_push(&self->sensor2, &reading2);
    if ((of1 == JCAL_TICK) && (of2 == JCAL_TICK)) {
        (void)jcal_functional_add(&self->joint, jcal_sensor_tick(&self->sensor1), jcal_sensor_tick(&self->sensor2));
    }
    const unsigned most = slices_for(self->joint.cfg.slices_per_s, pair->t_us - self->last_us);
    self->last_us = pair->t_us;
    for (unsigned k = 0u; k < most; ++k) {
        if (jcal_functional_step(&self->joint) != JCAL_OK) {
            break;
        }
    }
    return (reject == JCAL_REJECT_NONE) ? JCAL_OK : JCAL_REJECTED;
}

jcal_status_t jcal_functional_pair_get(const jcal_functional_pair_t *self, jcal_functional_result_t *out)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    const jcal_status_t status = jcal_functional_get(&self->joint, out);
    if (status == JCAL_OK) {
        jcal_head_count(&out->head, self->gate.samples, self->gate.rejected_by);
        jcal_head_complain(&out->head, jcal_gate_complaint(&self->gate), JCAL_WEAK_AXIS1);
        out->for_axes = out->for_axes && (out->head.status == JCAL_READY);
        out->for_flexion = out->for_flexion && (out->head.status == JCAL_READY);
    }
    return status;
}

float jcal_functional_pair_flexion(const jcal_functional_pair_t *self)
{
    return (self == NULL) ? NAN
                          : jcal_functional_flexion(&self->joint, jcal_sensor_orientation(&self->sensor1),
                                                    jcal_sensor_orientation(&self->sensor2));
}

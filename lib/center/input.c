/* SPDX-License-Identifier: MIT */
/// @file
/// Gate, inbox and derivatives in a row. See center/input.h.
#include "center/input.h"

#include "math/clear.h"
#include "math/scalar.h"
#include "sample/ring.h"

#include <stddef.h>

void jcal_center_input_begin(jcal_center_input_t *self)
{
    jcal_clear(self, sizeof *self);
    jcal_gate_init(&self->gate);
    jcal_kinematics_begin(&self->kinematics);
}

/// Length within 0.05 of 1; not so for NaN.
static bool is_unit(jcal_quat_t q)
{
    return jcal_within((q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z), 0.9025f, 1.1025f);
}

jcal_status_t jcal_center_input_push(jcal_center_input_t *self, const jcal_center_config_t *cfg,
                                     const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    uint32_t slot;
    if (!jcal_ring_room(&self->inbox.ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    if ((attitudes != NULL) && (!is_unit(attitudes->q1) || !is_unit(attitudes->q2))) {
        ++self->gate.samples;
        ++self->gate.rejected_by[JCAL_REJECT_OUT_OF_RANGE];
        return JCAL_REJECTED;
    }
    if (jcal_gate_check(&self->gate, &cfg->gate, pair) != JCAL_REJECT_NONE) {
        return JCAL_REJECTED;
    }
    if (attitudes != NULL) {
        self->attitudes[slot] = *attitudes;
    }
    self->inbox.slots[slot] = *pair;
    jcal_ring_publish(&self->inbox.ring);
    return JCAL_OK;
}

jcal_center_input_event_t jcal_center_input_take(jcal_center_input_t *self, const jcal_center_config_t *cfg,
                                                 jcal_kinematic_t *sample)
{
    const bool is_oriented = cfg->method == JCAL_CENTER_LS;
    uint32_t slot;
    if (!jcal_ring_peek(&self->inbox.ring, &slot)) {
        return JCAL_CENTER_NONE;
    }
    const jcal_pair_t pair = self->inbox.slots[slot];
    const jcal_attitudes_t attitudes = self->attitudes[slot];
    jcal_ring_release(&self->inbox.ring);
    if (!jcal_kinematics_put(&self->kinematics, &cfg->kinematics, &pair, is_oriented ? &attitudes : NULL, sample)) {
        return JCAL_CENTER_WAITS;
    }
    const float least = cfg->min_rate_rad_s * cfg->min_rate_rad_s;
    const bool is_slow = (sample->body1.rate2 < least) && (sample->body2.rate2 < least);
    return is_slow ? JCAL_CENTER_SLOW : JCAL_CENTER_SAMPLE;
}

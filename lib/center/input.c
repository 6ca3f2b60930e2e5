/* SPDX-License-Identifier: MIT */
/// @file
/// Gate, inbox and derivatives in a row. See center/input.h.
#include "center/input.h"

#include "math/clear.h"
#include "sample/gate.h"
#include "sample/ring.h"
#include "sample/unit.h"

#include <stddef.h>

#define MICROSECONDS 1e-6f

void jcal_center_input_begin(jcal_center_input_t *self)
{
    jcal_clear(self, sizeof *self);
    jcal_gate_init(&self->gate);
    jcal_kinematics_begin(&self->kinematics);
}

bool jcal_center_input_full(const jcal_center_input_t *self)
{
    return jcal_ring_waiting(&self->inbox.ring) >= JCAL_INBOX_CAPACITY;
}

static bool is_same(jcal_quat_t a, jcal_quat_t b)
{
    return (a.w == b.w) && (a.x == b.x) && (a.y == b.y) && (a.z == b.z);
}

/// True if an orientation has not changed for too long. Equal ones are no lost packets here: a filter may be slower than the readings.
static bool is_frozen(uint64_t *changed_us, bool has_changed, uint64_t t_us, float frozen_s)
{
    if (has_changed || (t_us < *changed_us)) {
        *changed_us = t_us; /* or the clock began anew */
    }
    return ((float)(t_us - *changed_us) * MICROSECONDS) > frozen_s;
}

/// What is wrong with a pair's orientations; order of time, holes and repetitions are the readings' gate's to judge.
static jcal_reject_t check_attitudes(jcal_center_attitudes_t *self, const jcal_gate_config_t *cfg, uint64_t t_us,
                                     const jcal_attitudes_t *attitudes)
{
    const float lengths2 = jcal_unit_length2(attitudes->q1) + jcal_unit_length2(attitudes->q2);
    if (!((lengths2 - lengths2) == 0.0f)) {
        return JCAL_REJECT_NOT_FINITE;
    }
    if (!jcal_is_unit(attitudes->q1) || !jcal_is_unit(attitudes->q2)) {
        return JCAL_REJECT_OUT_OF_RANGE;
    }
    const bool frozen1 = is_frozen(&self->changed1_us, !is_same(attitudes->q1, self->last.q1), t_us, cfg->frozen_s);
    const bool frozen2 = is_frozen(&self->changed2_us, !is_same(attitudes->q2, self->last.q2), t_us, cfg->frozen_s);
    self->last = *attitudes;
    return (frozen1 || frozen2) ? JCAL_REJECT_FROZEN : JCAL_REJECT_NONE;
}

jcal_status_t jcal_center_input_push(jcal_center_input_t *self, const jcal_center_config_t *cfg,
                                     const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    uint32_t slot;
    if (!jcal_ring_room(&self->inbox.ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    const jcal_reject_t cause =
        (attitudes == NULL) ? JCAL_REJECT_NONE : check_attitudes(&self->watched, &cfg->gate, pair->t_us, attitudes);
    if (cause != JCAL_REJECT_NONE) {
        jcal_gate_refuse(&self->gate, cause);
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

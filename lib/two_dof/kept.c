/* SPDX-License-Identifier: MIT */
/// @file
/// Orientations from push to step. See two_dof/kept.h.
#include "two_dof/kept.h"

#include "jointcal/quat.h"
#include "sample/rate.h"
#include "sample/ring.h"

#define MICROSECONDS 1e-6f

/// Two kept orientations further apart than this have no rate between them, s.
#define APART_MAX_S 0.12f

jcal_status_t jcal_two_dof_keep(jcal_two_dof_kept_t *self, jcal_orientation_gate_t *gate, const jcal_gate_config_t *cfg,
                                const jcal_orientation_pair_t *pair, uint32_t apart_us)
{
    uint32_t slot;
    if (!jcal_ring_room(&self->ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    if (jcal_orientation_gate_check(gate, cfg, pair) != JCAL_REJECT_NONE) {
        return JCAL_REJECTED;
    }
    self->pushes = (uint8_t)((self->pushes < UINT8_MAX) ? (self->pushes + 1u) : UINT8_MAX);
    const uint32_t before =
        (self->ring.written - 1u) % JCAL_INBOX_CAPACITY; /* only push writes there, so it is still there */
    if (self->has_kept && ((pair->t_us - self->slots[before].t_us) < apart_us)) {
        return JCAL_OK;
    }
    const jcal_orientation_pair_t unit = {pair->t_us, jcal_quat_normalise(pair->q1), jcal_quat_normalise(pair->q2)};
    self->slots[slot] = unit;
    self->pushes_of[slot] = self->pushes;
    self->pushes = 0u;
    self->has_kept = true;
    jcal_ring_publish(&self->ring);
    return JCAL_OK;
}

bool jcal_two_dof_take(jcal_two_dof_kept_t *self, unsigned *pushes)
{
    uint32_t slot;
    if (!jcal_ring_peek(&self->ring, &slot)) {
        return false;
    }
    self->last[2] = self->last[1];
    self->last[1] = self->last[0];
    self->last[0] = self->slots[slot];
    *pushes = self->pushes_of[slot];
    jcal_ring_release(&self->ring);
    self->count = (uint8_t)((self->count < JCAL_TWO_DOF_KEPT) ? (self->count + 1u) : JCAL_TWO_DOF_KEPT);
    return true;
}

/// Time from one to the next, s; beyond any limit if it does not increase, as after a clock that began anew.
static float since(const jcal_orientation_pair_t *before, const jcal_orientation_pair_t *after)
{
    return (float)(after->t_us - before->t_us) * MICROSECONDS;
}

bool jcal_two_dof_middle(const jcal_two_dof_kept_t *self, jcal_two_dof_middle_t *out)
{
    const jcal_orientation_pair_t *const before = &self->last[2];
    const jcal_orientation_pair_t *const at = &self->last[1];
    const jcal_orientation_pair_t *const after = &self->last[0];
    const float to_s = since(before, at);
    const float on_s = since(at, after);
    if ((self->count < JCAL_TWO_DOF_KEPT) || (to_s > APART_MAX_S) || (on_s > APART_MAX_S)) {
        return false;
    }
    out->at = at;
    out->w1 = jcal_rate_between(before->q1, after->q1, to_s + on_s);
    out->w2 = jcal_rate_between(before->q2, after->q2, to_s + on_s);
    out->dt_s = 0.5f * (to_s + on_s);
    return true;
}

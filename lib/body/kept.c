/* SPDX-License-Identifier: MIT */
/// @file
/// What a body keeps: when something is worth a write, and the write. See body.h; docs/METHOD_HUB.md, sections 2 and 3.
#include "body/engine.h"
#include "body/events.h"
#include "body/line.h"
#include "body/report.h"
#include "body/restore.h"

#include <stddef.h>

/// Time from one joint to the next that is looked at, us.
#define CHECK_US 1000000u

jcal_status_t jcal_body_kept(const jcal_body_t *self, unsigned joint, jcal_kept_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready || (joint >= self->table.joint_count)) {
        return JCAL_ERR_ARG;
    }
    const jcal_body_joint_spec_t *const spec = &self->table.joints[joint];
    const jcal_body_joint_t *const state = &self->table.joint_states[joint];
    jcal_kept_t kept = {0};
    kept.serial1 = self->table.sensors[spec->proximal].serial;
    kept.serial2 = self->table.sensors[spec->distal].serial;
    kept.joint = (uint8_t)joint;
    kept.has_lag = state->lag_known;
    kept.lag_s = state->lag_known ? state->lag_s : 0.0f;
    kept.lag_bound_s = state->lag_known ? state->lag_bound_s : 0.0f;
    jcal_body_joint_result_t result;
    jcal_body_report(self, joint, &result);
    if ((result.head.status != JCAL_READY) || (kept.serial1 == 0u) || (kept.serial2 == 0u) ||
        !jcal_body_engine_kept(spec, &kept) || !jcal_kept_is_valid(&kept)) {
        return JCAL_IDLE;
    }
    *out = kept;
    return JCAL_OK;
}

/// True if what is known of a joint is worth a write. What was handed over from flash is there already.
static bool is_worth(const jcal_body_t *self, unsigned j)
{
    jcal_kept_t now;
    jcal_kept_t kept;
    if (jcal_body_engine_is_adopted(&self->table.joints[j]) || (jcal_body_kept(self, j, &now) != JCAL_OK)) {
        return false;
    }
    const jcal_kept_wanted_t wanted = {now.kind, (uint8_t)j, now.serial1, now.serial2};
    const bool is_there = jcal_keep_load(self->table.flash, &wanted, &kept) == JCAL_KEPT_FITS;
    return jcal_kept_worth(is_there ? &kept : NULL, &now);
}

bool jcal_body_keep_due(jcal_body_t *self)
{
    if ((self == NULL) || !self->is_ready || (self->table.flash == NULL)) {
        return false;
    }
    jcal_body_restore_t *const restore = &self->restore;
    if ((self->round.number - restore->checked) >= jcal_body_rounds(&self->pace, CHECK_US)) {
        const unsigned j = restore->next_check % self->table.joint_count;
        const uint32_t bit = UINT32_C(1) << j;
        restore->checked = self->round.number;
        restore->next_check = (uint8_t)((j + 1u) % self->table.joint_count);
        restore->worth = is_worth(self, j) ? (restore->worth | bit) : (restore->worth & ~bit);
    }
    return jcal_keep_due(&restore->schedule, self->round.now_us, restore->worth != 0u);
}

/// All that is worth it into a slot; false if flash failed. `put`: a bit for each joint that went in.
static bool write(const jcal_body_t *self, uint32_t *put)
{
    jcal_keep_writer_t writer;
    if (jcal_keep_begin(&writer, self->table.flash, self->table.joint_count) != JCAL_OK) {
        return false;
    }
    for (unsigned j = 0u; j < self->table.joint_count; ++j) {
        jcal_kept_t now;
        if (((self->restore.worth & (UINT32_C(1) << j)) != 0u) && (jcal_body_kept(self, j, &now) == JCAL_OK)) {
            if (jcal_keep_put(&writer, &now) != JCAL_OK) {
                return false;
            }
            *put |= UINT32_C(1) << j;
        }
    }
    return jcal_keep_commit(&writer) == JCAL_OK;
}

jcal_status_t jcal_body_keep(jcal_body_t *self)
{
    if ((self == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    if ((self->table.flash == NULL) || (self->restore.worth == 0u)) {
        return JCAL_IDLE;
    }
    uint32_t put = 0u;
    const bool written = write(self, &put);
    jcal_keep_written(&self->restore.schedule, self->round.now_us); /* what failed is not tried again at once */
    if (!written) {
        return JCAL_ERR_FLASH;
    }
    self->restore.worth &= ~put;
    const jcal_body_event_t event = {jcal_body_time(self), 0.0f,           (uint8_t)JCAL_BODY_KEPT,
                                     JCAL_BODY_NONE,       JCAL_BODY_NONE, 0u};
    jcal_body_events_put(&self->events, &event);
    return JCAL_OK;
}

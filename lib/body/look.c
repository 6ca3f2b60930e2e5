/* SPDX-License-Identifier: MIT */
/// @file
/// What changed in a joint, as events. See body/look.h.
#include "body/look.h"

#include "body/events.h"
#include "body/report.h"

void jcal_body_look(jcal_body_t *self, unsigned joint)
{
    jcal_body_joint_t *const state = &self->table.joint_states[joint];
    jcal_body_joint_result_t result;
    jcal_body_report(self, joint, &result);
    const unsigned status = (unsigned)result.head.status;
    const unsigned reason = (unsigned)result.head.reason;
    const bool was_ready = state->status == (uint8_t)JCAL_READY;
    if ((status == (unsigned)JCAL_READY) && !was_ready) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_READY, 0u, 0.0f);
    } else if ((status == (unsigned)JCAL_MOVED) && (state->status != (uint8_t)JCAL_MOVED)) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_MOVED, reason, 0.0f);
    } else if (was_ready && (status != (unsigned)JCAL_READY)) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_LEFT_READY, reason, 0.0f);
    } else {
        /* as before */
    }
    if ((reason == (unsigned)JCAL_REASON_NOT_ONE_JOINT) && (state->reason != (uint8_t)JCAL_REASON_NOT_ONE_JOINT)) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_NOT_ONE, 0u, 0.0f);
    }
    state->status = (uint8_t)status;
    state->reason = (uint8_t)reason;
}

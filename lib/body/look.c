/* SPDX-License-Identifier: MIT */
/// @file
/// What changed in a joint, as events. See body/look.h.
#include "body/look.h"

#include "body/engine.h"
#include "body/events.h"
#include "body/exchange.h"
#include "body/report.h"
#include "body/restore.h"

/// Looks, four a second, at which the engine must have said more often than not that this is not one joint before it is told; and those, once
/// it is, that it must not say so before it is believed again: a minute. A look that says so then counts as so many others.
#define DOUBT_MOST 20u
#define TOLD_MOST JCAL_BODY_AGAINST_MOST
#define TOLD_STEP 12u

/// Tells that the two sensors share no joint, once the engine has said so for long, or that nothing fits where no lag does either; and no lag
/// is to blame: it is known, or none at all explains the motion.
static void doubt(jcal_body_t *self, unsigned joint, bool is_against)
{
    jcal_body_joint_t *const state = &self->table.joint_states[joint];
    const unsigned most = state->not_one ? TOLD_MOST : DOUBT_MOST;
    const unsigned step = state->not_one ? TOLD_STEP : 1u;
    if (is_against) {
        state->against = (uint8_t)(((state->against + step) < most) ? (state->against + step) : most);
    } else {
        state->against = (uint8_t)((state->against > 0u) ? (state->against - 1u) : 0u);
    }
    const bool is_told_by_times = jcal_body_in_step(self, joint) || state->no_lag;
    if (state->not_one) {
        state->not_one = state->against > 0u;
    } else if (is_told_by_times && (state->against == DOUBT_MOST)) {
        state->not_one = true;
        state->against = TOLD_MOST;
        jcal_body_tell_joint(self, joint, JCAL_BODY_NOT_ONE, 0u, 0.0f);
    } else {
        /* as before */
    }
}

void jcal_body_look(jcal_body_t *self, unsigned joint)
{
    jcal_body_joint_t *const state = &self->table.joint_states[joint];
    jcal_body_joint_result_t result;
    jcal_body_engine_get(&self->table.joints[joint], &result);
    const bool fits_nothing = state->no_lag && (result.head.reason == JCAL_REASON_DOES_NOT_FIT);
    doubt(self, joint, fits_nothing || (result.head.reason == JCAL_REASON_NOT_ONE_JOINT));
    jcal_body_report(self, joint, &result);
    if (result.head.status == JCAL_READY) { /* and is believed: times and sensors are right */
        jcal_body_restore_settle(self, joint);
    }
    const unsigned status = (unsigned)result.head.status;
    const unsigned reason = (unsigned)result.head.reason;
    const bool was_ready = state->status == (uint8_t)JCAL_READY;
    if ((status == (unsigned)JCAL_READY) && !was_ready) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_READY, 0u, 0.0f);
    } else if (was_ready && (status == (unsigned)JCAL_MOVED)) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_MOVED, reason, 0.0f);
        jcal_body_restore_moved(self, joint);
    } else if (was_ready && (status != (unsigned)JCAL_READY)) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_LEFT_READY, reason, 0.0f);
    } else {
        /* as before */
    }
    state->status = (uint8_t)status;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Kept calibrations of a body's joints. See body/restore.h.
#include "body/restore.h"

#include "body/engine.h"
#include "body/events.h"
#include "body/line.h"
#include "body/tree.h"
#include "math/scalar.h"

#include <stddef.h>

/// A place is given back after this, us: if the joint moved for less than STILL_S; if it moved for ENOUGH_S without a decision, which is then left to the
/// joint's own estimator; or if another joint waits. After LONG_US it is given back in any case: a joint that has stopped moving must not keep the
/// lag waiting.
#define TURN_US 20000000u
#define LONG_US 60000000u
#define STILL_S 1.0f
#define ENOUGH_S 10.0f
/// If nobody moves the memory is the lag's for so long, us.
#define REST_US 60000000u

/// A radio that connects anew may be later by so much, s: a third of a long connection interval of 30 ms.
#define LAG_ANEW_S 0.01f

static jcal_kept_wanted_t wanted_of(const jcal_body_t *self, unsigned j)
{
    const jcal_body_joint_spec_t *const joint = &self->table.joints[j];
    const jcal_kept_wanted_t wanted = {jcal_body_engine_kind(joint), (uint8_t)j,
                                       self->table.sensors[joint->proximal].serial,
                                       self->table.sensors[joint->distal].serial};
    return wanted;
}

void jcal_body_restore_begin(jcal_body_t *self)
{
    for (unsigned p = 0u; p < JCAL_BODY_PLACES; ++p) {
        self->restore.joint[p] = JCAL_BODY_NONE;
    }
    jcal_keep_schedule_init(&self->restore.schedule);
    if ((self->table.flash == NULL) || (self->table.shared == NULL)) {
        return;
    }
    for (unsigned j = 0u; j < self->table.joint_count; ++j) {
        const jcal_kept_wanted_t wanted = wanted_of(self, j);
        if ((wanted.serial1 != 0u) && (wanted.serial2 != 0u)) {
            self->table.joint_states[j].kept = (uint8_t)JCAL_BODY_KEPT_TO_READ;
        }
    }
}

static bool is_in(const jcal_body_t *self, unsigned j, jcal_body_kept_phase_t phase)
{
    return self->table.joint_states[j].kept == (uint8_t)phase;
}

/// The first joint in a phase, from `from` on and round; JCAL_BODY_NONE if there is none.
static unsigned find(const jcal_body_t *self, jcal_body_kept_phase_t phase, unsigned from)
{
    for (unsigned k = 0u; k < self->table.joint_count; ++k) {
        const unsigned j = (from + k) % self->table.joint_count;
        if (is_in(self, j, phase)) {
            return j;
        }
    }
    return JCAL_BODY_NONE;
}

static bool may_look(const jcal_body_t *self)
{
    return (int32_t)(self->round.number - self->restore.rest) >= 0;
}

bool jcal_body_restore_first(const jcal_body_t *self)
{
    return self->restore.open || (find(self, JCAL_BODY_KEPT_TO_READ, 0u) != JCAL_BODY_NONE) ||
           (may_look(self) && ((find(self, JCAL_BODY_KEPT_WAITS, 0u) != JCAL_BODY_NONE) ||
                               (find(self, JCAL_BODY_KEPT_STILL, 0u) != JCAL_BODY_NONE)));
}

static void drop(jcal_body_t *self, unsigned j, jcal_remember_reason_t reason)
{
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    state->kept = (uint8_t)JCAL_BODY_KEPT_DROPPED;
    state->kept_reason = (uint8_t)reason;
    if (state->lag_is_kept) { /* of other sensors, or other radios, for all that is known */
        state->lag_is_kept = false;
        state->lag_known = false;
        state->lag_bound_s = JCAL_LAG_UNKNOWN_S;
    }
    jcal_body_tell_joint(self, j, JCAL_BODY_DROPPED, (unsigned)reason, 0.0f);
}

/// The lag that was kept is taken off, and believed until it is looked at.
static void take_lag(jcal_body_t *self, unsigned j, const jcal_kept_t *kept)
{
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    if (!kept->has_lag || state->lag_known || !jcal_body_shift(self, j, kept->lag_s - state->lag_s)) {
        return;
    }
    state->lag_s = kept->lag_s;
    state->lag_bound_s = kept->lag_bound_s + LAG_ANEW_S;
    state->lag_known = true;
    state->lag_is_kept = true;
}

static void read_record(jcal_body_t *self, unsigned j)
{
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    const jcal_kept_wanted_t wanted = wanted_of(self, j);
    jcal_kept_t kept;
    const jcal_kept_refusal_t refusal = jcal_keep_load(self->table.flash, &wanted, &kept);
    state->kept = (uint8_t)JCAL_BODY_KEPT_NONE;
    if (refusal == JCAL_KEPT_FITS) {
        state->kept = (uint8_t)JCAL_BODY_KEPT_WAITS;
        state->kept_reason = (uint8_t)JCAL_REMEMBER_NO_MOTION;
        take_lag(self, j, &kept);
        if (!state->lag_known) { /* times that may be off by anything tell nothing of axes */
            state->kept = (uint8_t)JCAL_BODY_KEPT_LEFT;
        }
        jcal_body_tell_joint(self, j, JCAL_BODY_REMEMBERED, 0u, 0.0f);
    } else if (refusal != JCAL_KEPT_NONE) {
        drop(self, j, (refusal == JCAL_KEPT_OTHER_SENSORS) ? JCAL_REMEMBER_OTHER_SENSORS : JCAL_REMEMBER_NO_RECORD);
    } else {
        /* nothing was kept */
    }
}

/// A free place for the next joint that waits; false if there is no such joint, or its record is not to be had any more.
static bool give(jcal_body_t *self, unsigned place)
{
    jcal_body_restore_t *const restore = &self->restore;
    const unsigned j = find(self, JCAL_BODY_KEPT_WAITS, restore->next_joint);
    if (j == JCAL_BODY_NONE) {
        return false;
    }
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    const jcal_kept_wanted_t wanted = wanted_of(self, j);
    jcal_kept_t kept;
    const jcal_kept_refusal_t refusal = jcal_keep_load(self->table.flash, &wanted, &kept);
    restore->next_joint = (uint8_t)((j + 1u) % self->table.joint_count);
    if ((refusal != JCAL_KEPT_FITS) ||
        (jcal_remember_init(&self->table.shared->remember[place], &kept, refusal) != JCAL_OK)) {
        drop(self, j, JCAL_REMEMBER_NO_RECORD);
        return true;
    }
    state->kept = (uint8_t)JCAL_BODY_KEPT_LOOKED_AT;
    restore->joint[place] = (uint8_t)j;
    restore->since[place] = self->round.number;
    return true;
}

/// What motion has confirmed gives angles at once, if it is good enough for any; else the joint's own estimator has the last word.
static void confirm(jcal_body_t *self, unsigned j, const jcal_remember_t *remember,
                    const jcal_remember_result_t *result)
{
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    if (!jcal_body_engine_adopt(&self->table.joints[j], &remember->kept, result)) {
        state->kept = (uint8_t)JCAL_BODY_KEPT_LEFT;
        state->kept_reason = (uint8_t)JCAL_REMEMBER_AXES;
        return;
    }
    state->kept = (uint8_t)JCAL_BODY_KEPT_CONFIRMED;
    state->kept_reason = (uint8_t)JCAL_REMEMBER_NONE;
    jcal_body_tell_joint(self, j, JCAL_BODY_CONFIRMED, 0u, 0.0f);
}

/// The joint at a place is decided upon, or its turn is over.
static void decide(jcal_body_t *self, unsigned place)
{
    jcal_body_restore_t *const restore = &self->restore;
    const jcal_remember_t *const remember = &self->table.shared->remember[place];
    const unsigned j = restore->joint[place];
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    jcal_remember_result_t result;
    (void)jcal_remember_get(remember, &result);
    state->kept_reason = (uint8_t)result.reason;
    const uint32_t since = self->round.number - restore->since[place];
    const bool turn_ends = since >= jcal_body_rounds(&self->pace, TURN_US);
    const bool is_still =
        (turn_ends && (result.motion_s < STILL_S)) || (since >= jcal_body_rounds(&self->pace, LONG_US));
    if (result.state == JCAL_REMEMBER_CONFIRMED) {
        confirm(self, j, remember, &result);
    } else if (result.state == JCAL_REMEMBER_DROPPED) {
        drop(self, j, result.reason);
    } else if (turn_ends && (result.motion_s >= ENOUGH_S)) {
        state->kept = (uint8_t)JCAL_BODY_KEPT_LEFT;
    } else if (is_still) {
        state->kept = (uint8_t)JCAL_BODY_KEPT_STILL;
    } else if (turn_ends && (find(self, JCAL_BODY_KEPT_WAITS, 0u) != JCAL_BODY_NONE)) {
        state->kept = (uint8_t)JCAL_BODY_KEPT_WAITS;
    } else {
        return;
    }
    restore->joint[place] = JCAL_BODY_NONE;
}

/// The memory is free for kept calibrations; those that were still have another chance.
static bool open(jcal_body_t *self)
{
    if ((self->probe.joint != JCAL_BODY_NONE) || !may_look(self)) {
        return false;
    }
    unsigned waiting = 0u;
    for (unsigned j = 0u; j < self->table.joint_count; ++j) {
        jcal_body_joint_t *const state = &self->table.joint_states[j];
        if (is_in(self, j, JCAL_BODY_KEPT_STILL)) {
            state->kept = (uint8_t)JCAL_BODY_KEPT_WAITS;
        }
        waiting += is_in(self, j, JCAL_BODY_KEPT_WAITS) ? 1u : 0u;
    }
    self->restore.open = waiting > 0u;
    return self->restore.open;
}

/// A slice of the next place's look, and what follows from it; a joint for a place that is free. False if nothing was due.
static bool step_places(jcal_body_t *self)
{
    jcal_body_restore_t *const restore = &self->restore;
    bool is_used = false;
    for (unsigned k = 0u; k < JCAL_BODY_PLACES; ++k) {
        const unsigned place = restore->next;
        restore->next = (uint8_t)((place + 1u) % JCAL_BODY_PLACES);
        if (restore->joint[place] == JCAL_BODY_NONE) {
            if (give(self, place)) {
                return true;
            }
            continue;
        }
        is_used = true;
        const bool worked = jcal_remember_step(&self->table.shared->remember[place]) == JCAL_OK;
        decide(self, place);
        if (worked) {
            return true;
        }
    }
    if (!is_used) {
        restore->open = false;
        restore->rest = self->round.number + jcal_body_rounds(&self->pace, REST_US);
    }
    return false;
}

bool jcal_body_restore_step(jcal_body_t *self)
{
    if ((self->table.flash == NULL) || (self->table.shared == NULL)) {
        return false;
    }
    const unsigned to_read = find(self, JCAL_BODY_KEPT_TO_READ, 0u);
    if (to_read != JCAL_BODY_NONE) {
        read_record(self, to_read);
        return true;
    }
    return self->restore.open ? step_places(self) : open(self);
}

void jcal_body_restore_add(jcal_body_t *self, unsigned joint, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if (!is_in(self, joint, JCAL_BODY_KEPT_LOOKED_AT)) {
        return;
    }
    for (unsigned p = 0u; p < JCAL_BODY_PLACES; ++p) {
        if (self->restore.joint[p] == joint) {
            (void)jcal_remember_add(&self->table.shared->remember[p], tick1, tick2);
        }
    }
}

static bool is_remembered(const jcal_body_t *self, unsigned j)
{
    const uint8_t phase = self->table.joint_states[j].kept;
    return (phase >= (uint8_t)JCAL_BODY_KEPT_WAITS) && (phase <= (uint8_t)JCAL_BODY_KEPT_LEFT);
}

/// Takes a joint's place away, if it has one.
static void free_place(jcal_body_t *self, unsigned joint)
{
    for (unsigned p = 0u; p < JCAL_BODY_PLACES; ++p) {
        if (self->restore.joint[p] == joint) {
            self->restore.joint[p] = JCAL_BODY_NONE;
        }
    }
}

void jcal_body_restore_settle(jcal_body_t *self, unsigned joint)
{
    const bool was_confirmed = is_in(self, joint, JCAL_BODY_KEPT_CONFIRMED);
    const bool is_compared = was_confirmed && !jcal_body_engine_is_adopted(&self->table.joints[joint]);
    if (!is_remembered(self, joint) && !is_compared) {
        return;
    }
    const jcal_kept_wanted_t wanted = wanted_of(self, joint);
    jcal_kept_t kept;
    jcal_kept_t now = {0};
    now.serial1 = wanted.serial1;
    now.serial2 = wanted.serial2;
    now.joint = wanted.joint;
    if (!jcal_body_engine_kept(&self->table.joints[joint], &now)) {
        return;
    }
    free_place(self, joint);
    const bool is_there = jcal_keep_load(self->table.flash, &wanted, &kept) == JCAL_KEPT_FITS;
    if (!is_there || !jcal_remember_agrees(&kept, &now)) {
        drop(self, joint, JCAL_REMEMBER_ESTIMATE);
        return;
    }
    jcal_body_joint_t *const state = &self->table.joint_states[joint];
    state->kept = (uint8_t)JCAL_BODY_KEPT_SETTLED;
    state->kept_reason = (uint8_t)JCAL_REMEMBER_NONE;
    if (!was_confirmed) {
        jcal_body_tell_joint(self, joint, JCAL_BODY_CONFIRMED, 0u, 0.0f);
    }
}

static bool is_confirmed(const jcal_body_t *self, unsigned joint)
{
    return is_in(self, joint, JCAL_BODY_KEPT_CONFIRMED) || is_in(self, joint, JCAL_BODY_KEPT_SETTLED);
}

void jcal_body_restore_moved(jcal_body_t *self, unsigned joint)
{
    if (is_confirmed(self, joint)) {
        drop(self, joint, JCAL_REMEMBER_ESTIMATE);
    }
}

void jcal_body_restore_again(jcal_body_t *self, unsigned joint)
{
    if (is_remembered(self, joint) || is_confirmed(self, joint)) {
        free_place(self, joint);
        self->table.joint_states[joint].kept = (uint8_t)JCAL_BODY_KEPT_WAITS;
        self->table.joint_states[joint].kept_reason = (uint8_t)JCAL_REMEMBER_NO_MOTION;
    }
}

bool jcal_body_restore_waits(const jcal_body_t *self, unsigned joint)
{
    return (self->table.joints[joint].kind == JCAL_BODY_HINGE) && is_remembered(self, joint) &&
           !is_in(self, joint, JCAL_BODY_KEPT_LEFT);
}

void jcal_body_restore_report(const jcal_body_t *self, unsigned joint, jcal_body_joint_result_t *out)
{
    const jcal_body_joint_t *const state = &self->table.joint_states[joint];
    out->has_kept = state->kept >= (uint8_t)JCAL_BODY_KEPT_WAITS;
    out->kept_reason = (jcal_remember_reason_t)state->kept_reason;
    out->kept = JCAL_REMEMBERED;
    if (is_confirmed(self, joint)) {
        out->kept = JCAL_REMEMBER_CONFIRMED;
    } else if (is_in(self, joint, JCAL_BODY_KEPT_DROPPED)) {
        out->kept = JCAL_REMEMBER_DROPPED;
    } else {
        /* remembered */
    }
}

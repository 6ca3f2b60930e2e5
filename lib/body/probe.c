/* SPDX-License-Identifier: MIT */
/// @file
/// The estimator of a lag goes from joint to joint. See body/probe.h.
#include "body/probe.h"

#include "body/events.h"
#include "body/exchange.h"
#include "body/line.h"
#include "body/restore.h"
#include "body/tree.h"

#include <math.h>
#include <stddef.h>

#define MICROSECONDS 1e-6f

/// A joint is looked at for so long, us; and for so long if it has moved for less than MOTION_MIN_S by then.
#define PATIENCE_US 40000000u
#define STILL_US 5000000u
#define MOTION_MIN_S 1.0f
/// After so much motion, s, a share that no lag explains says that the two sensors have no joint in common: of joints a tenth is left at most.
#define MOTION_DENY_S 10.0f
#define LEFT_DENY 0.3f
/// Once all lags are known, one is looked at again after this, us.
#define AGAIN_US 60000000u
#define LOOK_US 250000u

/// A lag that was known and is off by more is not known any more, s: what engines keep what they learnt with.
#define DENIED_S 0.02f

/// True if joint `a` is to be looked at before joint `b`: unknown ones first, then longest waiting.
static bool is_before(const jcal_body_joint_t *a, const jcal_body_joint_t *b)
{
    return (a->lag_known != b->lag_known) ? b->lag_known : (a->probed < b->probed);
}

/// The joint that is to be looked at next.
static unsigned next_joint(const jcal_body_t *self)
{
    unsigned best = 0u;
    for (unsigned j = 1u; j < self->table.joint_count; ++j) {
        if (is_before(&self->table.joint_states[j], &self->table.joint_states[best])) {
            best = j;
        }
    }
    return best;
}

static void leave(jcal_body_t *self)
{
    if (self->probe.other == JCAL_BODY_NONE) {
        self->table.joint_states[self->probe.joint].probed = self->round.number;
    }
    self->probe.was_other = self->probe.other != JCAL_BODY_NONE;
    self->probe.other = JCAL_BODY_NONE;
    self->probe.joint = JCAL_BODY_NONE;
    self->probe.since = self->round.number;
    self->probe.due = false;
}

/// Begins with two sensors that may sit on each other's segment, if it is their turn; false if there are none.
static bool choose_other(jcal_body_t *self)
{
    unsigned joint = 0u;
    unsigned other = 0u;
    if (self->probe.was_other || !jcal_body_exchange_next(self, &joint, &other) ||
        (jcal_lag_init(&self->table.shared->lag) != JCAL_OK)) {
        return false;
    }
    self->probe.joint = (uint8_t)joint;
    self->probe.other = (uint8_t)other;
    self->probe.since = self->round.number;
    return true;
}

/// Begins with the next joint, at once if its lag is not known.
static void choose(jcal_body_t *self)
{
    jcal_body_probe_t *const probe = &self->probe;
    const unsigned joint = next_joint(self);
    if (jcal_body_restore_first(self) || choose_other(self)) {
        return;
    }
    self->probe.was_other = false;
    const bool waits = (self->round.number - probe->since) >= jcal_body_rounds(&self->pace, AGAIN_US);
    if ((waits || !self->table.joint_states[joint].lag_known) && (jcal_lag_init(&self->table.shared->lag) == JCAL_OK)) {
        probe->joint = (uint8_t)joint;
        probe->since = self->round.number;
    }
}

void jcal_body_probe_add(jcal_body_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    (void)jcal_lag_add(&self->table.shared->lag, tick1, tick2);
}

/// Takes off what is to be taken off.
static void align(jcal_body_t *self)
{
    jcal_body_joint_t *const state = &self->table.joint_states[self->probe.joint];
    const float off_s = jcal_lag_take(&self->table.shared->lag);
    if (off_s == 0.0f) {
        return;
    }
    if (!jcal_body_shift(self, self->probe.joint, off_s)) {
        state->lag_known = false;
        leave(self);
        return;
    }
    state->lag_s += off_s;
    if (state->off_us == 0) { /* the engine began anew */
        jcal_body_restore_again(self, self->probe.joint);
    }
    if (fabsf(off_s) > DENIED_S) {
        state->lag_known = false;
        state->lag_bound_s = JCAL_LAG_UNKNOWN_S;
    }
}

bool jcal_body_probe_step(jcal_body_t *self)
{
    if (!self->probe.due || (self->probe.joint == JCAL_BODY_NONE)) {
        return false;
    }
    self->probe.due = false;
    if (jcal_lag_step(&self->table.shared->lag) != JCAL_OK) {
        return false;
    }
    if (self->probe.other == JCAL_BODY_NONE) {
        align(self);
    }
    return true;
}

/// Says that the lag is known, once, and goes on to the next joint.
static void found(jcal_body_t *self, const jcal_lag_result_t *result)
{
    jcal_body_joint_t *const state = &self->table.joint_states[self->probe.joint];
    const bool is_new = !state->lag_known;
    state->lag_known = true;
    state->no_lag = false;
    state->lag_is_kept = false;
    state->against = state->not_one ? state->against : 0u; /* with times as they were it said so rightly */
    state->lag_bound_s = result->bound_s;
    if (is_new) {
        jcal_body_tell_joint(self, self->probe.joint, JCAL_BODY_LAG_FOUND, 0u, state->lag_s);
    }
    leave(self);
}

bool jcal_body_probe_look(jcal_body_t *self)
{
    jcal_body_probe_t *const probe = &self->probe;
    if ((self->table.shared == NULL) ||
        ((self->round.number - probe->looked) < jcal_body_rounds(&self->pace, LOOK_US))) {
        return false;
    }
    probe->looked = self->round.number;
    if (probe->joint == JCAL_BODY_NONE) {
        choose(self);
        return true;
    }
    jcal_lag_result_t result;
    (void)jcal_lag_get(&self->table.shared->lag, &result);
    const uint32_t since = self->round.number - probe->since;
    const bool is_still = (since >= jcal_body_rounds(&self->pace, STILL_US)) && (result.taken_s == 0.0f) &&
                          (result.motion_s < MOTION_MIN_S);
    if (result.lag_known && (probe->other != JCAL_BODY_NONE)) {
        jcal_body_exchange_found(self, probe->joint, probe->other);
        leave(self);
    } else if (result.lag_known) {
        found(self, &result);
    } else if (is_still || (since >= jcal_body_rounds(&self->pace, PATIENCE_US))) {
        if (probe->other == JCAL_BODY_NONE) {
            self->table.joint_states[probe->joint].no_lag =
                (result.motion_s >= MOTION_DENY_S) && (result.left >= LEFT_DENY);
        }
        leave(self);
    } else {
        /* it goes on */
    }
    return true;
}

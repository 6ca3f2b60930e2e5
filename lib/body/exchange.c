/* SPDX-License-Identifier: MIT */
/// @file
/// Which two sensors sit on each other's segment. See body/exchange.h.
#include "body/exchange.h"

#include "body/events.h"
#include "body/tree.h"

#include <stddef.h>

/// Joints from the top of the tree down to a joint.
static unsigned depth(const jcal_body_t *self, unsigned joint)
{
    unsigned at = joint;
    unsigned count = 0u;
    while ((count < self->table.joint_count) && (at != JCAL_BODY_NONE)) {
        at = self->table.sensor_states[self->table.joints[at].proximal].joint;
        ++count;
    }
    return count;
}

/// True if the upper sensor of joint j and the lower one of joint k may be a joint of their own. Not if one hangs on the other: what is two joints apart
/// on one limb moves much alike.
static bool may_fit(const jcal_body_t *self, unsigned j, unsigned k)
{
    const jcal_body_joint_spec_t *const a = &self->table.joints[j];
    const jcal_body_joint_spec_t *const b = &self->table.joints[k];
    return (j != k) && self->table.joint_states[k].not_one && (a->kind == b->kind) &&
           (depth(self, j) == depth(self, k)) && (a->proximal != b->distal) && (a->proximal != b->proximal) &&
           !jcal_body_hangs_on(self, a->distal, b->distal) && !jcal_body_hangs_on(self, b->distal, a->distal);
}

bool jcal_body_exchange_next(jcal_body_t *self, unsigned *joint, unsigned *other)
{
    const unsigned joints = self->table.joint_count;
    const unsigned pairs = joints * joints;
    if (self->exchange.half == JCAL_BODY_HALF_FOUND) { /* the other way round comes first */
        self->exchange.half = JCAL_BODY_HALF_TRIED;
        *joint = self->exchange.joint;
        *other = self->exchange.other;
        return true;
    }
    self->exchange.half = JCAL_BODY_HALF_NONE;
    for (unsigned n = 0u; n < joints; ++n) { /* joints from the one at the cursor on */
        const unsigned j = ((self->exchange.next / joints) + n) % joints;
        if (!self->table.joint_states[j].not_one) {
            continue;
        }
        for (unsigned k = (n == 0u) ? (self->exchange.next % joints) : 0u; k < joints; ++k) {
            if (may_fit(self, j, k)) {
                self->exchange.next = (uint16_t)(((j * joints) + k + 1u) % pairs);
                *joint = j;
                *other = self->table.joints[k].distal;
                return true;
            }
        }
    }
    self->exchange.next = 0u;
    return false;
}

/// What is known of the joints next to one, the worst last.
typedef enum { FINE, OPEN, NONE } neighbour_t;

static neighbour_t worse(neighbour_t a, neighbour_t b)
{
    return (a > b) ? a : b;
}

static neighbour_t neighbour(const jcal_body_t *self, unsigned joint)
{
    const jcal_body_joint_t *const state = &self->table.joint_states[joint];
    if (state->not_one) {
        return NONE;
    }
    return (state->status == (uint8_t)JCAL_READY) ? FINE : OPEN;
}

/// The joints below: none if one of them is none; fine if there is no joint below.
static neighbour_t below(const jcal_body_t *self, unsigned joint)
{
    neighbour_t all = FINE;
    for (unsigned k = 0u; k < self->table.joint_count; ++k) {
        if (self->table.joints[k].proximal == self->table.joints[joint].distal) {
            all = worse(all, neighbour(self, k));
        }
    }
    return all;
}

static neighbour_t above(const jcal_body_t *self, unsigned joint)
{
    const unsigned j = self->table.sensor_states[self->table.joints[joint].proximal].joint;
    return (j == JCAL_BODY_NONE) ? FINE : neighbour(self, j);
}

/// No joint of a sensor that sits on another segment is believed, whatever its estimator says: arms that move alike can make one ready.
static void doubt_joints_of(jcal_body_t *self, unsigned sensor)
{
    for (unsigned j = 0u; j < self->table.joint_count; ++j) {
        const jcal_body_joint_spec_t *const joint = &self->table.joints[j];
        if ((joint->proximal == sensor) || (joint->distal == sensor)) {
            self->table.joint_states[j].not_one = true;
            self->table.joint_states[j].against = JCAL_BODY_AGAINST_MOST;
        }
    }
}

void jcal_body_exchange_found(jcal_body_t *self, unsigned joint, unsigned other)
{
    jcal_body_exchange_t *const exchange = &self->exchange;
    const unsigned second = self->table.sensor_states[other].joint;
    if (second == JCAL_BODY_NONE) {
        return;
    }
    if (exchange->half != JCAL_BODY_HALF_TRIED) {
        exchange->half = JCAL_BODY_HALF_FOUND;
        exchange->joint = (uint8_t)second;
        exchange->other = self->table.joints[joint].distal;
        return;
    }
    exchange->half = JCAL_BODY_HALF_NONE;
    const neighbour_t lower = worse(below(self, joint), below(self, second));
    const neighbour_t upper = worse(above(self, joint), above(self, second));
    const bool is_lower = (lower == NONE) || ((lower == FINE) && (upper == FINE));
    if (!is_lower && (upper != NONE)) {
        return; /* which of both sensors it is cannot be told */
    }
    const jcal_body_joint_spec_t *const a = &self->table.joints[joint];
    const jcal_body_joint_spec_t *const b = &self->table.joints[second];
    const uint8_t one = is_lower ? a->distal : a->proximal;
    const uint8_t two = is_lower ? b->distal : b->proximal;
    const bool is_known = ((exchange->sensor1 == one) && (exchange->sensor2 == two)) ||
                          ((exchange->sensor1 == two) && (exchange->sensor2 == one));
    exchange->sensor1 = one;
    exchange->sensor2 = two;
    doubt_joints_of(self, one);
    doubt_joints_of(self, two);
    if (!is_known) {
        jcal_body_tell_sensor(self, one, JCAL_BODY_EXCHANGED, two, 0.0f);
    }
}

bool jcal_body_exchange_explains(const jcal_body_t *self, unsigned joint)
{
    const jcal_body_joint_spec_t *const spec = &self->table.joints[joint];
    const jcal_body_exchange_t *const exchange = &self->exchange;
    return self->table.joint_states[joint].not_one && (exchange->sensor1 != exchange->sensor2) &&
           ((spec->proximal == exchange->sensor1) || (spec->distal == exchange->sensor1) ||
            (spec->proximal == exchange->sensor2) || (spec->distal == exchange->sensor2));
}

static bool shares_sensor(const jcal_body_joint_spec_t *a, const jcal_body_joint_spec_t *b)
{
    return (a->proximal == b->distal) || (a->distal == b->proximal) || (a->proximal == b->proximal);
}

bool jcal_body_exchange_doubts(const jcal_body_t *self, unsigned joint)
{
    for (unsigned k = 0u; k < self->table.joint_count; ++k) {
        if ((k != joint) && self->table.joint_states[k].not_one &&
            shares_sensor(&self->table.joints[joint], &self->table.joints[k]) &&
            !jcal_body_exchange_explains(self, k)) {
            return true;
        }
    }
    return false;
}

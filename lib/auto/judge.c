/* SPDX-License-Identifier: MIT */
/// @file
/// Which of the two models of a hinge is believed. See auto/judge.h.
#include "auto/judge.h"

#include "functional/judge.h"
#include "functional/twist.h"
#include "joint/hysteresis.h"
#include "jointcal/joint_heading.h"

/// What the functional model must say before the rigid one is believed. Lengths of rates, which the rigid model begins with, can be those of
/// a hinge by chance or by a fault: two sensors on one stiff body that vibrate, a component with the wrong sign, frames exchanged. Levels
/// and directions then do not agree. A tenth more or twice of what rigs and simulated soft tissue of 1.5 deg ever showed (docs/METHOD_PEOPLE.md, section 8).
#define STIFFNESS_MIN 0.05f
#define BEND_MIN_RAD 0.14f
#define RATE_SHARE_MAX 0.15f
#define ALONG_MIN 0.9f
/// Share of the joint's motion that may be left where it moves at 0.17 m/s or faster: what the accelerometers see is one joint's.
#define LACK_MAX 0.35f
#define LACK_SPEED2_MIN 0.03f

/// Where the rates agree about an axis to this share of themselves, the segments are rigid, and the rigid model will find the axis
/// better than the functional one, or has a reason not to. Once the functional one is ready, half of it: a calibration that is good is
/// not given up because a calm minute leaves less of skin.
#define RIGID_RATE_SHARE 0.08f
#define RIGID_RATE_SHARE_KEPT 0.04f

/// Memory of the heading that follows from the rigid model's axes, s.
#define HEADING_MEMORY_S 10.0f

void jcal_hinge_auto_begin_anew(jcal_hinge_auto_t *self)
{
    self->follows = false;
    self->has_zero = false;
    self->zero[0] = 0u;
    self->zero[1] = 0u;
}

/// False if the accelerometers see no common centre: a frame of theirs is not that of their gyroscope. Slower, biases of 1 m/s^2 are most of it.
static bool is_one_joint(const jcal_functional_t *functional, float slack)
{
    const float speed2 = functional->point.speed2;
    return (speed2 < (slack * LACK_SPEED2_MIN)) || (jcal_functional_left(functional) <= (slack * LACK_MAX * speed2));
}

/// What the functional model has against a rigid hinge.
static jcal_reason_t objection(const jcal_functional_t *functional, float slack)
{
    const jcal_functional_verdict_t *const verdict = &functional->verdict;
    if (!functional->search.has_estimate || !(verdict->bend_rad > 0.0f)) {
        return JCAL_REASON_UNCERTAIN; /* not judged yet */
    }
    if (!((slack * verdict->stiffness) >= STIFFNESS_MIN) || !((slack * verdict->bend_rad) >= BEND_MIN_RAD)) {
        return JCAL_REASON_NO_BEND;
    }
    const float across2 = functional->point.size[JCAL_FAMILY_RATE];
    if (!(across2 <= (slack * slack * RATE_SHARE_MAX * RATE_SHARE_MAX)) || !((slack * verdict->share) >= ALONG_MIN)) {
        return JCAL_REASON_DOES_NOT_FIT;
    }
    return is_one_joint(functional, slack) ? JCAL_REASON_NONE : JCAL_REASON_NOT_ONE_JOINT;
}

/// The heading offset by the rigid model's axes: the functional model may take longer to find the pairing of their signs.
static void follow_heading(jcal_hinge_auto_t *self, const jcal_hinge_result_t *hinge, uint64_t t_us, bool goes_on)
{
    const jcal_status_t status =
        goes_on ? jcal_joint_heading_improve(&self->heading, hinge->axis1, hinge->axis2, 0.0f)
                : jcal_joint_heading_hinge(&self->heading, hinge->axis1, hinge->axis2, HEADING_MEMORY_S);
    if (status != JCAL_OK) {
        return; /* axes of a hinge that is ready have directions */
    }
    const jcal_orientation_pair_t pair = {t_us, jcal_hinge_auto_orientation(self, 1u),
                                          jcal_hinge_auto_orientation(self, 2u)};
    (void)jcal_joint_heading_push(&self->heading, &pair);
}

/// True if the rates say that the segments are not rigid, so that the functional model is the one to ask.
static bool is_person(const jcal_hinge_auto_t *self)
{
    const jcal_functional_t *const functional = &self->functional.joint;
    const bool keeps = self->person && (functional->verdict.status == (uint8_t)JCAL_READY);
    const float share = keeps ? RIGID_RATE_SHARE_KEPT : RIGID_RATE_SHARE;
    return functional->search.has_estimate && (functional->point.size[JCAL_FAMILY_RATE] > (share * share));
}

/// From the first time that either is ready, the angle counts from one zero, whichever of them speaks.
static void choose_zero(jcal_hinge_auto_t *self)
{
    const uint8_t functional = self->functional.joint.verdict.status;
    if (!self->believed && (functional == (uint8_t)JCAL_MOVED)) {
        self->has_zero = false;
    }
    if (self->has_zero || (!self->believed && (functional != (uint8_t)JCAL_READY))) {
        return;
    }
    jcal_hinge_auto_result_t result;
    (void)jcal_hinge_auto_get(self, &result);
    if (result.ready_for != JCAL_FOR_NOTHING) {
        self->zero[0] = jcal_twist_zero(result.hinge.axis1);
        self->zero[1] = jcal_twist_zero(result.hinge.axis2);
        self->has_zero = true;
    }
}

void jcal_hinge_auto_judge(jcal_hinge_auto_t *self, uint64_t t_us)
{
    jcal_hinge_result_t rigid;
    (void)jcal_hinge_get(&self->rigid, &rigid);
    const float slack = self->believed ? JCAL_HYSTERESIS : 1.0f;
    self->objection = (uint8_t)objection(&self->functional.joint, slack);
    self->person = is_person(self);
    self->believed = (rigid.head.status == JCAL_READY) && (self->objection == (uint8_t)JCAL_REASON_NONE);
    if (self->believed || (self->follows && rigid.has_axes)) {
        follow_heading(self, &rigid, t_us, self->follows);
        self->follows = true;
    }
    choose_zero(self);
}

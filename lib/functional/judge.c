/* SPDX-License-Identifier: MIT */
/// @file
/// Readiness of the functional joint. See functional/judge.h.
#include "functional/judge.h"

#include "joint/hysteresis.h"
#include "joint/sign.h"
#include "jointcal/functional.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <float.h>

/// Judgements in a row, a quarter of a second apart, that must agree before `ready`.
#define AGREED_MIN 3u

/// A specific force whose median is further than this from 9.81 m/s^2 is not to be trusted.
#define GRAVITY_OFF_MAX 0.6f
/// The axis must stay one direction in space to this, rad.
#define LEANING_MAX (20.0f * JCAL_RAD_PER_DEG)
/// What one fixed rotation between both rates must leave of the smaller one, or the joint does not move.
#define STIFFNESS_MIN 0.05f

/// Seconds of motion, bending, the share of the relative motion that must be along the axis, and of the centre's that may be left.
#define MOTION_MIN_S 3.0f
#define BEND_MIN_RAD (15.0f * JCAL_RAD_PER_DEG)
#define SHARE_MIN 0.8f
#define LACK_MAX 0.025f
/// Bending, rms, times the root of what is along the axis over what is across it: what there must be, more the worse the centre's motion
/// fits. Two thighs that move alike do as a joint does, but bend about their line by 18 deg at 88 %, which makes 48 deg, with a share of
/// 0.011 to 0.025 left; a knee that makes as little in its first seconds leaves 0.004.
#define CLEAR_BEND_MIN_RAD (40.0f * JCAL_RAD_PER_DEG)
#define CLEAR_BEND_LACK 0.03f
/// Noise of the centre's velocity, squared, (m/s)^2; what the other pairing must leave beside this one, and evidence of that kind.
#define SPEED_NOISE2 6e-4f
/// The joint's centre must move at this speed, squared, both sides together, (m/s)^2: the sense of an axis hangs on that.
#define SPEED_MIN2 0.03f
/// With a hint about the pairing: twice the noise, or nothing tells whether there is one joint.
#define SPEED_HINTED2 (2.0f * SPEED_NOISE2)
#define OPPOSITE_MIN 4.0f
#define OPPOSITE_LEAST2 3e-4f
#define LEVER_EVIDENCE_MIN 3.0f
/// No axis of a person is good for angles beyond this bound, rad, whatever the angle's own bound says.
#define BOUND_FOR_FLEXION_RAD (10.0f * JCAL_RAD_PER_DEG)

/// True if both sensors' accelerations belong to one joint.
static bool is_one_joint(const jcal_functional_t *self, float slack)
{
    const float speed2 = jcal_max(self->point.speed2, FLT_MIN);
    const float left = jcal_functional_left(self);
    return (left - SPEED_NOISE2) <= (slack * LACK_MAX * speed2);
}

/// True if the joint bends about one line, far enough that this is no chance.
static bool bends_clearly(const jcal_functional_t *self, float slack)
{
    const float across = jcal_max(1.0f - self->verdict.share, FLT_EPSILON);
    const float clear = self->verdict.bend_rad * sqrtf(jcal_max(self->verdict.share, 0.0f) / across);
    const float left = jcal_functional_left(self);
    const float lack = jcal_max(left - SPEED_NOISE2, 0.0f) / jcal_max(self->point.speed2, FLT_MIN);
    return (slack * clear) >= (CLEAR_BEND_MIN_RAD * (1.0f + (lack / CLEAR_BEND_LACK)));
}

/// True if the pairing of signs is certain.
static bool is_paired(const jcal_functional_t *self, float slack)
{
    const jcal_functional_verdict_t *const verdict = &self->verdict;
    const float evidence = jcal_functional_evidence(verdict);
    if (self->cfg.sign_hint != JCAL_SIGN_UNKNOWN) {
        /* The user said it; data that insist on the other pairing contradict. */
        return evidence > -JCAL_FUNCTIONAL_EVIDENCE_MIN;
    }
    if (!((slack * evidence) >= JCAL_FUNCTIONAL_EVIDENCE_MIN)) {
        return false;
    }
    const float left = jcal_functional_left(self);
    return ((slack * (verdict->opposite - SPEED_NOISE2)) >= (OPPOSITE_MIN * jcal_max(left, OPPOSITE_LEAST2))) &&
           ((slack * verdict->evidence[JCAL_FAMILY_LEVER]) >= LEVER_EVIDENCE_MIN);
}

/// What says that this is no joint with one axis: then there is none that a bound could be of.
static jcal_reason_t find_objection(const jcal_functional_t *self, float slack)
{
    const jcal_functional_verdict_t *const verdict = &self->verdict;
    if (!is_one_joint(self, slack)) {
        return JCAL_REASON_NOT_ONE_JOINT;
    }
    if (!((slack * verdict->bend_rad) >= BEND_MIN_RAD) || !((slack * verdict->stiffness) >= STIFFNESS_MIN)) {
        return JCAL_REASON_NO_BEND;
    }
    if (!((slack * verdict->share) >= SHARE_MIN) || !bends_clearly(self, slack)) {
        return JCAL_REASON_MORE_AXES;
    }
    return JCAL_REASON_NONE;
}

/// The first thing that keeps the estimate from being ready, the worst first; `against` is what says that there is no axis.
static jcal_reason_t find_reason(const jcal_functional_t *self, float slack, jcal_reason_t against)
{
    const jcal_functional_verdict_t *const verdict = &self->verdict;
    if (self->ticks.gravity_off > (slack * GRAVITY_OFF_MAX)) {
        return JCAL_REASON_GRAVITY_OFF;
    }
    if ((slack * self->sums.motion_s) < MOTION_MIN_S) {
        return JCAL_REASON_NO_MOTION;
    }
    if (!((2.0f * self->point.size[JCAL_FAMILY_TURN]) <= (slack * LEANING_MAX * LEANING_MAX))) {
        return JCAL_REASON_DOES_NOT_FIT;
    }
    const float needed = (self->cfg.sign_hint == JCAL_SIGN_UNKNOWN) ? SPEED_MIN2 : SPEED_HINTED2;
    if (!((slack * self->point.speed2) >= needed)) {
        return JCAL_REASON_SIGN_OPEN; /* too slow for what follows to mean much */
    }
    if (against != JCAL_REASON_NONE) {
        return against;
    }
    if (!is_paired(self, slack)) {
        return JCAL_REASON_SIGN_OPEN;
    }
    return (verdict->for_axes || verdict->for_flexion) ? JCAL_REASON_NONE : JCAL_REASON_UNCERTAIN;
}

static jcal_hint_t hint_for(jcal_reason_t reason, jcal_weak_t weak)
{
    switch (reason) {
    case JCAL_REASON_NONE:
        return JCAL_HINT_NONE;
    case JCAL_REASON_SIGN_OPEN:
        return JCAL_HINT_MOVE_FASTER;
    case JCAL_REASON_UNCERTAIN:
        return (weak == JCAL_WEAK_AXIS1) ? JCAL_HINT_MOVE_SEGMENT1 : JCAL_HINT_MOVE_SEGMENT2;
    case JCAL_REASON_NO_MOTION:
    case JCAL_REASON_NO_BEND:
    case JCAL_REASON_MORE_AXES:
        return JCAL_HINT_MOVE_JOINT;
    default:
        return JCAL_HINT_CHECK_SENSORS;
    }
}

bool jcal_functional_is_for_flexion(float flexion_rad, float bound_rad, const jcal_functional_config_t *cfg,
                                    float slack)
{
    return (flexion_rad <= (slack * cfg->max_flexion_rad)) && (bound_rad <= (slack * BOUND_FOR_FLEXION_RAD));
}

void jcal_functional_judge(jcal_functional_t *self)
{
    jcal_functional_verdict_t *const verdict = &self->verdict;
    const bool was_ready = verdict->status == (uint8_t)JCAL_READY;
    const float slack = was_ready ? JCAL_HYSTERESIS : 1.0f;
    const float bound = jcal_max(verdict->bound1_rad, verdict->bound2_rad);
    verdict->flexion_rad = jcal_functional_flexion_error(self, bound);
    verdict->for_axes = bound <= (slack * self->cfg.max_bound_rad);
    verdict->for_flexion = jcal_functional_is_for_flexion(verdict->flexion_rad, bound, &self->cfg, slack);
    const jcal_reason_t against = find_objection(self, slack);
    const jcal_reason_t found = find_reason(self, slack, against);
    verdict->is_one_axis =
        (found != JCAL_REASON_GRAVITY_OFF) && (found != JCAL_REASON_DOES_NOT_FIT) && (against == JCAL_REASON_NONE);
    verdict->agreed =
        (uint8_t)((found != JCAL_REASON_NONE) ? 0u : jcal_min((float)verdict->agreed + 1.0f, (float)AGREED_MIN));
    const bool ready = verdict->agreed >= AGREED_MIN;
    const jcal_reason_t reason = (!ready && (found == JCAL_REASON_NONE)) ? JCAL_REASON_UNCERTAIN : found;
    const jcal_weak_t axis = (verdict->bound1_rad > verdict->bound2_rad) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2;
    const jcal_weak_t weak =
        (reason == JCAL_REASON_NONE) ? JCAL_WEAK_NONE : ((reason == JCAL_REASON_SIGN_OPEN) ? JCAL_WEAK_SIGN : axis);
    verdict->status =
        (uint8_t)(ready ? JCAL_READY : ((reason == JCAL_REASON_SIGN_OPEN) ? JCAL_AMBIGUOUS : JCAL_COLLECTING));
    verdict->reason = (uint8_t)reason;
    verdict->weak = (uint8_t)weak;
    verdict->hint = (uint8_t)hint_for(reason, weak);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Readiness of the ball joint. See ball/judge.h.
#include "ball/judge.h"

#include "ball/sums.h"
#include "joint/hysteresis.h"
#include "jointcal/head.h"
#include "jointcal/status.h"
#include "math/scalar.h"

#include <float.h>

/// Judgements in a row that must find nothing.
#define AGREED_MIN 3u

/// The first that does not hold is the reason (docs/METHOD_PEOPLE.md, section 10).
#define GRAVITY_OFF_MAX 0.6f
#define MOTION_MIN_S 3.0f
/// What may be left of the centre's motion, and what noise leaves, (m/s)^2.
#define LACK_MAX 0.05f
/// Motion from which on so much may be left, s; of less motion it is a share of it: what no joint has in common may look small for a moment.
#define LACK_MOTION_S 8.0f
#define SPEED_NOISE2 2e-4f
#define STIFFNESS_MIN 0.07f

/// Slower than this, squared, m/s, faster motion helps the heading more than other directions.
#define SPEED_SLOW2 0.03f

bool jcal_ball_is_joint(const jcal_ball_t *self)
{
    return self->verdict.agreed >= AGREED_MIN;
}

bool jcal_ball_knows_heading(const jcal_ball_t *self)
{
    return self->verdict.heading_rad < JCAL_BOUND_UNKNOWN_RAD;
}

/// What speaks against one joint.
static jcal_reason_t find_objection(const jcal_ball_t *self, float slack)
{
    const float left = self->point.lack / jcal_max(self->sums.motion_s, FLT_MIN);
    if (self->ticks.gravity_off > (slack * GRAVITY_OFF_MAX)) {
        return JCAL_REASON_GRAVITY_OFF;
    }
    if ((slack * self->sums.motion_s) < MOTION_MIN_S) {
        return JCAL_REASON_NO_MOTION;
    }
    const float sure = jcal_min(self->sums.motion_s / LACK_MOTION_S, 1.0f);
    if (!((left - SPEED_NOISE2) <= (slack * sure * LACK_MAX * self->point.speed2))) {
        return JCAL_REASON_NOT_ONE_JOINT;
    }
    return ((slack * self->verdict.stiffness) >= STIFFNESS_MIN) ? JCAL_REASON_NONE : JCAL_REASON_NO_BEND;
}

static jcal_hint_t hint_for(const jcal_ball_t *self, jcal_reason_t reason)
{
    switch (reason) {
    case JCAL_REASON_NONE:
        return JCAL_HINT_NONE;
    case JCAL_REASON_NO_MOTION:
    case JCAL_REASON_NO_BEND:
        return JCAL_HINT_MOVE_JOINT;
    case JCAL_REASON_UNCERTAIN:
        return (self->point.speed2 < SPEED_SLOW2) ? JCAL_HINT_MOVE_FASTER : JCAL_HINT_MORE_DIRECTIONS;
    default:
        return JCAL_HINT_CHECK_SENSORS;
    }
}

void jcal_ball_judge(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const v = &self->verdict;
    const bool was_ready = v->status == (uint8_t)JCAL_READY;
    const float slack = was_ready ? JCAL_HYSTERESIS : 1.0f;
    v->stiffness = jcal_ball_sums_stiffness(&self->sums);
    const jcal_reason_t found = find_objection(self, slack);
    const jcal_reason_t against =
        (self->refused && (found == JCAL_REASON_NO_MOTION)) ? JCAL_REASON_NOT_ONE_JOINT : found;
    v->agreed =
        (against != JCAL_REASON_NONE) ? 0u : (uint8_t)((v->agreed < AGREED_MIN) ? (v->agreed + 1u) : AGREED_MIN);
    v->for_heading = v->heading_rad <= (slack * self->cfg.max_heading_rad);
    const bool is_ready = jcal_ball_is_joint(self) && v->for_heading;
    const float max_m = self->cfg.max_lever_m;
    v->for_center1 = is_ready && (v->bound1_m <= (((was_ready && v->for_center1) ? JCAL_HYSTERESIS : 1.0f) * max_m));
    v->for_center2 = is_ready && (v->bound2_m <= (((was_ready && v->for_center2) ? JCAL_HYSTERESIS : 1.0f) * max_m));
    const jcal_reason_t open = is_ready ? JCAL_REASON_NONE : JCAL_REASON_UNCERTAIN;
    const jcal_reason_t reason = (against != JCAL_REASON_NONE) ? against : open;
    v->status = (uint8_t)(is_ready ? JCAL_READY : JCAL_COLLECTING);
    v->reason = (uint8_t)reason;
    v->hint = (uint8_t)hint_for(self, reason);
    v->weak = (uint8_t)(is_ready ? JCAL_WEAK_NONE : JCAL_WEAK_HEADING);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// The ball joint: ticks into sums, and the schedule of the work. Method: docs/METHOD_PEOPLE.md, section 10.
#include "ball/bounds.h"
#include "ball/judge.h"
#include "ball/solve.h"
#include "ball/sums.h"
#include "ball/track.h"
#include "jointcal/ball.h"
#include "levers/ticks.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/plane.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

/// Motion before anything is estimated, s.
#define MOTION_FIRST_S 0.7f
/// All sums are halved when they hold this much motion, s; less before the first `ready`: what is no joint yet is soon forgotten.
#define MOTION_MAX_S 60.0f
#define MOTION_MAX_BEFORE_S 20.0f
/// Time after a block was closed within which sums are halved, s.
#define FADE_WITHIN_S 1.0f

/// Time from one judgement to the next, s; once ready, and what a slice costs then.
#define JUDGE_EVERY_S 0.25f
#define JUDGE_READY_EVERY_S 1.0f
#define PRICE_READY 4.0f
/// Slices that may be saved up.
#define CREDIT_MAX 8.0f

/// Headings that are tried before the first judgement, 45 deg apart, and rounds of each.
#define FIRST_TRIALS 8u
#define TRIAL_ROUNDS 4u

/// Motion during which nothing but `not_one_joint` is said before the first `ready`, s, until everything is learnt anew: what came before the
/// sensors were put on must not stand in the way.
#define REFUSED_MAX_S 10.0f

/// Logarithm of the odds that another solution must be ahead by before it is taken, of 1.5 readings per second of motion.
#define AHEAD 0.5f
#define READINGS_PER_S 1.5f

/// Slices of a judgement: two rounds, a trial while headings may be begun anew, bounds, judging.
enum {
    ROUNDS_END = 2 * JCAL_BALL_ROUND_SLICES,
    TRIAL_END = ROUNDS_END + (TRIAL_ROUNDS * JCAL_BALL_ROUND_SLICES),
    BOUNDS_END = TRIAL_END + JCAL_BALL_BOUND_SLICES,
    JUDGED = BOUNDS_END,
    IDLE
};

typedef char jcal_ball_fits_its_budget[(sizeof(jcal_ball_t) <= 1024u) ? 1 : -1];

/// Empties what was learnt of the joint: all that follows the settings.
static void clear(jcal_ball_t *self)
{
    const size_t first = offsetof(jcal_ball_t, sums);
    jcal_clear((unsigned char *)self + first, sizeof *self - first);
    for (unsigned b = 0u; b < JCAL_LEVER_BLOCKS; ++b) {
        self->point.heading[b].re = 1.0f;
    }
    self->past.heading.re = 1.0f;
    self->track.heading.re = 1.0f;
    self->verdict.bound1_m = JCAL_BOUND_UNKNOWN_M;
    self->verdict.bound2_m = JCAL_BOUND_UNKNOWN_M;
    self->verdict.heading_rad = JCAL_BOUND_UNKNOWN_RAD;
    self->verdict.reason = (uint8_t)JCAL_REASON_NO_DATA;
    self->verdict.hint = (uint8_t)JCAL_HINT_MOVE_JOINT;
    self->verdict.weak = (uint8_t)JCAL_WEAK_HEADING;
    self->slice = (uint8_t)IDLE;
}

/// Everything is learnt anew, but for what is known of the sensors.
static void begin_anew(jcal_ball_t *self)
{
    const jcal_tick_pair_t ticks = self->ticks;
    const uint8_t status = self->verdict.status;
    clear(self);
    self->ticks = ticks;
    self->verdict.status = (status == (uint8_t)JCAL_READY) ? (uint8_t)JCAL_COLLECTING : status;
    self->verdict.reason = (uint8_t)JCAL_REASON_NO_MOTION;
}

/// A sensor has moved.
static void say_moved(jcal_ball_t *self)
{
    begin_anew(self);
    jcal_ticks_forget(&self->ticks);
    self->verdict.status = (uint8_t)JCAL_MOVED;
}

/// Until the next judgement no heading is known, and nothing is ready without one.
static void lose_heading(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const verdict = &self->verdict;
    verdict->heading_rad = JCAL_BOUND_UNKNOWN_RAD;
    if (verdict->status == (uint8_t)JCAL_READY) {
        verdict->status = (uint8_t)JCAL_COLLECTING;
        verdict->reason = (uint8_t)JCAL_REASON_UNCERTAIN;
        verdict->weak = (uint8_t)JCAL_WEAK_HEADING;
        verdict->hint = (uint8_t)JCAL_HINT_MORE_DIRECTIONS;
    }
}

jcal_status_t jcal_ball_init(jcal_ball_t *self, const jcal_ball_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_ball_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    self->cfg = *config;
    clear(self);
    return JCAL_OK;
}

jcal_status_t jcal_ball_reset(jcal_ball_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_ball_init(self, &self->cfg);
}

/// The closed block is merged with its heading, the open one closed, and another begins with its heading.
static void close(jcal_ball_t *self)
{
    if (self->sums.block_motion_s[1] > 0.0f) {
        jcal_ball_past_add(&self->past, &self->point, self->verdict.left);
        self->merged = true;
    }
    jcal_ball_sums_close(&self->sums, self->point.heading[1]); /* of a block without motion nothing is merged */
    self->point.heading[1] = self->point.heading[0];
}

/// Features began anew: the headings of before are not those of now.
static void cut(jcal_ball_t *self)
{
    if (!jcal_ball_is_joint(self)) { /* no heading is known that any block could be merged with */
        begin_anew(self);
        return;
    }
    close(self);
    close(self); /* both blocks: nothing ties their headings to what comes */
    self->past.known = 0.0f;
    self->slice = (uint8_t)IDLE; /* a judgement would be of other blocks than it began with */
    jcal_ball_track_clear(self);
    lose_heading(self);
}

jcal_status_t jcal_ball_add(jcal_ball_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_ticks_t kind = jcal_ticks_take(&self->ticks, tick1, tick2);
    if (kind == JCAL_TICKS_REJECTED) {
        return JCAL_REJECTED;
    }
    if ((kind == JCAL_TICKS_GO_ON) && !jcal_ticks_are_cold(tick1, tick2)) {
        const jcal_tick_weights_t weights = jcal_ticks_weigh(&self->ticks, tick1, tick2);
        self->motion_s += weights.motion_s;
        jcal_ball_sums_add(&self->sums, tick1, tick2, &weights);
        jcal_ball_track_add(self, tick1, tick2, weights.motion_s);
        self->refused_s += weights.motion_s; /* until a judgement says otherwise */
    } else if (kind == JCAL_TICKS_ANEW) {
        cut(self); /* work enough for one tick, which is left out */
    } else {
        /* left out */
    }
    const float period_s = tick1->dt_s;
    const float price = (self->verdict.status == (uint8_t)JCAL_READY) ? PRICE_READY : 1.0f;
    self->credit = jcal_min(self->credit + (period_s * self->cfg.slices_per_s / price), CREDIT_MAX);
    self->since_s += period_s;
    return JCAL_OK;
}

/// True if the trial's heading is within the bound of the estimate's: the same for all that is known.
static bool is_near(const jcal_ball_t *self)
{
    const jcal_plane_t off = jcal_plane_against(self->point.heading[0], self->trial.heading[0]);
    return fabsf(jcal_atan2(off.im, off.re)) <= self->verdict.heading_rad;
}

/// The trial is the estimate if it leaves less. Once ready, one that is near goes on as if it were the same; any other begins anew.
static void compare(jcal_ball_t *self)
{
    jcal_ball_verdict_t *const verdict = &self->verdict;
    const float ahead = READINGS_PER_S * self->sums.motion_s * jcal_ln(self->point.size / self->trial.size);
    if (!self->has_estimate || (ahead > AHEAD)) {
        const bool was_ready = verdict->status == (uint8_t)JCAL_READY;
        const bool goes_on = was_ready && is_near(self);
        self->point = self->trial;
        self->has_estimate = true;
        if (!goes_on) {
            verdict->agreed = 0u;
            jcal_ball_track_begin(self);
            lose_heading(self);
        }
    }
    self->turn = (uint8_t)((self->turn + 1u) % FIRST_TRIALS);
    self->tried = (uint8_t)((self->tried < UINT8_MAX) ? (self->tried + 1u) : UINT8_MAX);
}

static void try_other(jcal_ball_t *self)
{
    const unsigned part = (unsigned)self->slice - ROUNDS_END;
    if (part == 0u) {
        self->trial = self->point;
        jcal_ball_turn(&self->trial, self->turn);
    }
    jcal_ball_round(&self->sums, &self->past, &self->trial, part % JCAL_BALL_ROUND_SLICES);
    if (part + 1u == (unsigned)(TRIAL_END - ROUNDS_END)) {
        compare(self);
    }
}

/// The slice that follows `slice`; the search goes on only while headings may be begun anew.
static uint8_t next_of(const jcal_ball_t *self, unsigned slice)
{
    if ((slice + 1u == ROUNDS_END) && self->merged) {
        return (uint8_t)TRIAL_END;
    }
    if ((slice + 1u == TRIAL_END) && (self->tried < FIRST_TRIALS)) {
        return (uint8_t)ROUNDS_END; /* all starts, one after the other, before the first judgement */
    }
    return (uint8_t)(slice + 1u);
}

static void work(jcal_ball_t *self)
{
    const unsigned slice = self->slice;
    if (slice < ROUNDS_END) {
        jcal_ball_round(&self->sums, &self->past, &self->point, slice % JCAL_BALL_ROUND_SLICES);
    } else if (slice < TRIAL_END) {
        try_other(self);
    } else if (slice < BOUNDS_END) {
        jcal_ball_bound(self, slice - TRIAL_END);
    } else {
        jcal_ball_judge(self);
        if (!self->was_ready) {
            jcal_ball_track_begin(self); /* what it was until now came from levers that were hardly known */
        }
        self->was_ready = self->was_ready || (self->verdict.status == (uint8_t)JCAL_READY);
        if (self->verdict.reason != (uint8_t)JCAL_REASON_NOT_ONE_JOINT) {
            self->refused_s = 0.0f;
            self->refused = false;
        }
    }
    self->slice = next_of(self, slice);
}

/// What is due beside the judgement, and not in the midst of one; false if nothing is.
static bool tend(jcal_ball_t *self)
{
    if (self->was_ready && jcal_ball_track_alarm(&self->track)) {
        say_moved(self);
        return true;
    }
    if (self->slice < (uint8_t)IDLE) {
        return false;
    }
    if (!self->was_ready && (self->refused_s > REFUSED_MAX_S)) {
        begin_anew(self);
        self->refused = true;
        self->verdict.reason = (uint8_t)JCAL_REASON_NOT_ONE_JOINT; /* until there is motion enough to say otherwise */
        self->verdict.hint = (uint8_t)JCAL_HINT_CHECK_SENSORS;
        return true;
    }
    if (jcal_ball_sums_full(&self->sums)) {
        close(self);
        return true;
    }
    const bool is_new = self->sums.block_time_s < FADE_WITHIN_S;
    if (is_new && (self->sums.motion_s > (self->was_ready ? MOTION_MAX_S : MOTION_MAX_BEFORE_S))) {
        jcal_ball_sums_fade(&self->sums, 0.5f);
        return true;
    }
    return false;
}

jcal_status_t jcal_ball_step(jcal_ball_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    if (!(self->credit >= 1.0f)) {
        return JCAL_IDLE;
    }
    if (tend(self)) {
        self->credit -= 1.0f;
        return JCAL_OK;
    }
    if (!(self->motion_s >= MOTION_FIRST_S)) {
        return JCAL_IDLE;
    }
    if (self->slice >= (uint8_t)IDLE) {
        const bool is_ready = self->verdict.status == (uint8_t)JCAL_READY;
        if (!(self->since_s >= (is_ready ? JUDGE_READY_EVERY_S : JUDGE_EVERY_S))) {
            return JCAL_IDLE;
        }
        self->since_s = 0.0f;
        const unsigned first = is_ready ? JCAL_BALL_ROUND_SLICES : 0u; /* one round follows what changes in a second */
        self->slice = (uint8_t)(self->has_estimate ? first : (unsigned)ROUNDS_END);
    }
    self->credit -= 1.0f;
    work(self);
    return JCAL_OK;
}

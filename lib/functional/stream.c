/* SPDX-License-Identifier: MIT */
/// @file
/// The functional joint: ticks into sums, and the schedule of the work. Method: docs/METHOD_PEOPLE.md.
#include "functional/bounds.h"
#include "functional/describe.h"
#include "functional/judge.h"
#include "functional/rival.h"
#include "functional/search.h"
#include "functional/sums.h"
#include "functional/track.h"
#include "joint/sign.h"
#include "jointcal/functional.h"
#include "jointcal/vec3.h"
#include "levers/ticks.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sphere.h"

#include <float.h>
#include <stddef.h>

#define MICROSECONDS 1e-6f

/// Motion before anything is estimated, s.
#define MOTION_FIRST_S 0.7f
/// All sums are halved when they hold this much motion, s: what is learnt of a person follows slow change; and what is no joint yet, such
/// as sensors that are handled before they are strapped on, is soon forgotten.
#define MOTION_MAX_S 60.0f
#define MOTION_MAX_BEFORE_S 20.0f

/// Time after a block was closed within which sums are halved, s: next to nothing of the new one is lost.
#define FADE_WITHIN_S 1.0f

/// Time from one judgement to the next, s; once ready, and what a slice costs then. Slips are looked for at every tick, and bounds that
/// grow are seen early enough.
#define JUDGE_EVERY_S 0.25f
#define JUDGE_READY_EVERY_S 1.0f
#define PRICE_READY 4.0f
/// Slices that may be saved up.
#define CREDIT_MAX 8.0f

/// Evidence at which the other pairing takes over.
#define EVIDENCE_TURN (-1.0f)

/// Slices of a judgement: two rounds, a trial while headings may be begun anew, the other pairing, bounds, judging.
enum {
    ROUNDS_END = 2 * JCAL_FUNCTIONAL_ROUND_SLICES,
    TRIAL_END = ROUNDS_END + JCAL_FUNCTIONAL_TRIAL_SLICES,
    RIVAL_END = TRIAL_END + JCAL_FUNCTIONAL_RIVAL_SLICES,
    BOUNDS_END = RIVAL_END + JCAL_FUNCTIONAL_BOUND_SLICES,
    JUDGED = BOUNDS_END,
    IDLE
};

typedef char jcal_functional_fits_its_budget[(sizeof(jcal_functional_t) <= 3072u) ? 1 : -1];

/// Empties what was learnt of the joint: all that follows the settings.
static void clear(jcal_functional_t *self)
{
    const size_t first = offsetof(jcal_functional_t, sums);
    jcal_clear((unsigned char *)self + first, sizeof *self - first);
    self->point.j1 = jcal_vec3(0.0f, 0.0f, 1.0f);
    self->point.j2 = jcal_vec3(0.0f, 0.0f, 1.0f);
    for (unsigned b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
        self->point.heading[b].re = 1.0f;
    }
    self->track.heading.re = 1.0f;
    self->verdict.bound1_rad = JCAL_BOUND_UNKNOWN_RAD;
    self->verdict.bound2_rad = JCAL_BOUND_UNKNOWN_RAD;
    self->verdict.flexion_rad = JCAL_BOUND_UNKNOWN_RAD;
    self->verdict.reason = (uint8_t)JCAL_REASON_NO_DATA;
    self->verdict.hint = (uint8_t)JCAL_HINT_MOVE_JOINT;
    self->verdict.weak = (uint8_t)JCAL_WEAK_AXIS1;
    self->slice = (uint8_t)IDLE;
}

/// A sensor has moved: everything is learnt anew.
static void begin_anew(jcal_functional_t *self)
{
    jcal_tick_pair_t ticks = self->ticks;
    jcal_ticks_forget(&ticks);
    clear(self);
    self->ticks = ticks;
    self->verdict.status = (uint8_t)JCAL_MOVED;
}

jcal_status_t jcal_functional_init(jcal_functional_t *self, const jcal_functional_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_functional_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    self->cfg = *config;
    clear(self);
    return JCAL_OK;
}

jcal_status_t jcal_functional_reset(jcal_functional_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_functional_init(self, &self->cfg);
}

/// Features began anew: the headings of before are not those of now.
static void cut(jcal_functional_t *self)
{
    const bool first = self->search.tried < JCAL_FUNCTIONAL_FIRST_TRIALS;
    if (first && (self->sums.block[1].motion_s > 0.0f)) { /* nothing knows a heading yet that it could be merged with */
        jcal_clear(&self->sums, sizeof self->sums);
        jcal_clear(&self->search, sizeof self->search);
        self->motion_s = 0.0f;
    } else if (self->sums.block[0].motion_s > 0.0f) {
        self->merged = self->merged || (self->sums.block[1].motion_s > 0.0f);
        jcal_functional_sums_close(&self->sums, &self->point);
    }
    self->slice = (uint8_t)IDLE; /* a judgement would be of other blocks than it began with */
    self->cut = true;
    jcal_functional_track_clear(self);
}

/// What a sleeping joint does with ticks.
static void follow(jcal_functional_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, jcal_ticks_t kind)
{
    if (kind == JCAL_TICKS_ANEW) {
        jcal_functional_track_clear(self);
    } else if ((kind == JCAL_TICKS_GO_ON) && !jcal_ticks_are_cold(tick1, tick2)) {
        const jcal_tick_weights_t weights = jcal_ticks_weigh(&self->ticks, tick1, tick2);
        jcal_functional_track_add(self, tick1, tick2, weights.motion_s);
    } else {
        /* left out */
    }
}

jcal_status_t jcal_functional_add(jcal_functional_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_ticks_t kind = jcal_ticks_take(&self->ticks, tick1, tick2);
    if (kind == JCAL_TICKS_REJECTED) {
        return JCAL_REJECTED;
    }
    if (self->asleep) {
        follow(self, tick1, tick2, kind);
        return JCAL_OK;
    }
    if ((kind == JCAL_TICKS_GO_ON) && !jcal_ticks_are_cold(tick1, tick2)) {
        const jcal_tick_weights_t weights = jcal_ticks_weigh(&self->ticks, tick1, tick2);
        self->motion_s += weights.motion_s;
        jcal_functional_sums_add(&self->sums, tick1, tick2, &weights);
        jcal_functional_track_add(self, tick1, tick2, weights.motion_s);
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

/// There is another estimate, in the sense of the one before. One within its bounds is the same for all that is known: the angle goes on.
/// Any other begins anew, and what was ready is not.
static void take_over(jcal_functional_t *self, jcal_vec3_t was1, jcal_vec3_t was2)
{
    jcal_functional_point_t *const point = &self->point;
    jcal_functional_verdict_t *const verdict = &self->verdict;
    const float along = jcal_vec3_dot(was1, point->j1) + jcal_vec3_dot(was2, point->j2);
    if (along < 0.0f) {
        point->j1 = jcal_vec3_scale(point->j1, -1.0f);
        point->j2 = jcal_vec3_scale(point->j2, -1.0f);
    }
    const bool was_ready = verdict->status == (uint8_t)JCAL_READY;
    const bool is_near = (jcal_sphere_angle(was1, point->j1) <= verdict->bound1_rad) &&
                         (jcal_sphere_angle(was2, point->j2) <= verdict->bound2_rad);
    if (was_ready && is_near) {
        return;
    }
    verdict->agreed = 0u;
    if (was_ready) {
        verdict->status = (uint8_t)JCAL_COLLECTING;
        verdict->reason = (uint8_t)JCAL_REASON_UNCERTAIN;
    }
    jcal_functional_track_begin(self);
}

static void try_other(jcal_functional_t *self)
{
    const jcal_vec3_t was1 = self->point.j1;
    const jcal_vec3_t was2 = self->point.j2;
    const bool had = self->search.has_estimate;
    if (jcal_functional_try(&self->search, &self->sums, &self->point, (unsigned)self->slice - ROUNDS_END)) {
        take_over(self, had ? was1 : self->point.j1, had ? was2 : self->point.j2);
    }
}

static void look_at_rival(jcal_functional_t *self)
{
    const unsigned part = (unsigned)self->slice - TRIAL_END;
    jcal_functional_compare(self, part);
    if (part < (JCAL_FUNCTIONAL_RIVAL_SLICES - 1u)) {
        return;
    }
    const bool hinted = self->cfg.sign_hint != JCAL_SIGN_UNKNOWN;
    const bool wrong = hinted ? !jcal_sign_obeys(self->cfg.sign_hint, self->point.j1, self->point.j2, self->kept_sign)
                              : (jcal_functional_evidence(&self->verdict) < EVIDENCE_TURN);
    if (wrong) {
        const jcal_vec3_t was1 = self->point.j1;
        const jcal_vec3_t was2 = self->point.j2;
        jcal_functional_turn_round(self);
        take_over(self, was1, was2);
    }
}

/// The slice that follows `slice`; the search goes on only while headings may be begun anew.
static uint8_t next_of(const jcal_functional_t *self, unsigned slice)
{
    const bool first = self->search.tried < JCAL_FUNCTIONAL_FIRST_TRIALS;
    if ((slice + 1u == ROUNDS_END) && self->merged) {
        return (uint8_t)TRIAL_END;
    }
    if ((slice + 1u == TRIAL_END) && first) {
        return (uint8_t)ROUNDS_END; /* all starts, one after the other, before the first judgement */
    }
    return (uint8_t)(slice + 1u);
}

/// The slice that a judgement begins with. Once ready one round follows what changes in a second; after a gap it must not begin with a heading
/// from before that: places and axes would be fitted to it.
static uint8_t first_of(const jcal_functional_t *self, bool is_ready)
{
    if (!self->search.has_estimate) {
        return (uint8_t)ROUNDS_END;
    }
    if (self->cut) {
        return (uint8_t)(JCAL_FUNCTIONAL_ROUND_SLICES - 1u);
    }
    return (uint8_t)(is_ready ? JCAL_FUNCTIONAL_ROUND_SLICES : 0u);
}

static void work(jcal_functional_t *self)
{
    const unsigned slice = self->slice;
    if (slice < ROUNDS_END) {
        jcal_functional_round(&self->sums, &self->point, slice % JCAL_FUNCTIONAL_ROUND_SLICES);
    } else if (slice < TRIAL_END) {
        try_other(self);
    } else if (slice < RIVAL_END) {
        look_at_rival(self);
    } else if (slice < BOUNDS_END) {
        jcal_functional_bound(self, slice - RIVAL_END);
    } else {
        jcal_functional_stiffness(self);
        jcal_functional_judge(self);
        if (self->verdict.status == (uint8_t)JCAL_READY) {
            if (self->kept_sign[0] == 0) {
                jcal_functional_track_trust(self);
            }
            jcal_sign_keep(&self->kept_sign[0], self->point.j1, self->cfg.axis1_toward);
            jcal_sign_keep(&self->kept_sign[1], self->point.j2, jcal_vec3(0.0f, 0.0f, 0.0f));
        }
    }
    self->slice = next_of(self, slice);
}

/// What is due beside the judgement, and not in the midst of one; false if nothing is.
static bool tend(jcal_functional_t *self)
{
    const bool was_ready = self->kept_sign[0] != 0;
    if (was_ready && jcal_functional_track_alarm(&self->track)) {
        begin_anew(self);
        return true;
    }
    if (self->slice < (uint8_t)IDLE) {
        return false;
    }
    if (jcal_functional_sums_full(&self->sums)) {
        self->merged = self->merged || (self->sums.block[1].motion_s > 0.0f);
        jcal_functional_sums_close(&self->sums, &self->point);
        return true;
    }
    const bool is_new = self->sums.block[0].time_s < FADE_WITHIN_S;
    if (is_new && (self->sums.motion_s > (was_ready ? MOTION_MAX_S : MOTION_MAX_BEFORE_S))) {
        jcal_functional_sums_fade(&self->sums, 0.5f);
        return true;
    }
    return false;
}

/// A sleeping joint looks for a slip, which wakes it.
static jcal_status_t watch(jcal_functional_t *self)
{
    if (!jcal_functional_track_alarm(&self->track)) {
        return JCAL_IDLE;
    }
    begin_anew(self);
    return JCAL_OK;
}

jcal_status_t jcal_functional_sleep(jcal_functional_t *self, bool asleep)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    if (asleep == self->asleep) {
        return JCAL_OK;
    }
    if (asleep) {
        self->asleep = self->verdict.status == (uint8_t)JCAL_READY;
        return self->asleep ? JCAL_OK : JCAL_REJECTED;
    }
    self->asleep = false;
    if (self->adopted) {
        return jcal_functional_reset(self);
    }
    cut(self); /* headings of before are not those of now */
    return JCAL_OK;
}

jcal_status_t jcal_functional_step(jcal_functional_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    if (self->asleep) {
        return watch(self);
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
        if (self->cut && self->search.has_estimate && !jcal_functional_sums_has_heading(&self->sums)) {
            return JCAL_IDLE;
        }
        self->since_s = 0.0f;
        self->slice = first_of(self, is_ready);
        self->cut = false;
    }
    self->credit -= 1.0f;
    work(self);
    return JCAL_OK;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// The lag of two sensors: ticks into sums, the schedule of the work, and what is said. See lag.h.
#include "jointcal/lag.h"

#include "levers/ticks.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "pairing/lag_search.h"
#include "pairing/lag_sums.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/// Largest lag that is believed, s.
#define RANGE_S 0.25f
/// Time that filters must have run, s: from the first reading on, when sensors mostly rest, and after a gap.
#define WARM_FIRST_S 2.0f
#define WARM_S 3.0f

/// Bound: a floor, s, and so many standard deviations. Motion that takes one independent reading of each of three components, s. Share
/// that the filters of two sensors leave of themselves.
#define FLOOR_S 0.002f
#define DEVIATIONS 1.1f
#define READING_S 1.0f
#define SHARE_FLOOR 0.002f

/// What must hold: share that is left, how much more any other lag leaves, beside a floor, the centre's squared velocity, (m/s)^2,
/// motion, s, bound, s, and judgements in a row.
#define SHARE_MAX 0.05f
#define RIVAL_MIN 2.5f
#define RIVAL_FLOOR 0.01f
#define SPEED2_MIN 1.6e-3f
#define MOTION_MIN_S 3.0f
#define BOUND_MAX_S 0.010f
#define AGREED_MIN 3u
#define AGREED_MOST 200u
/// What speaks against a lag that is known: a share above this, or another lag; after so much motion, s.
#define SHARE_DENIES 0.1f
#define MOTION_DENIES_S 6.0f

typedef char jcal_lag_fits_its_budget[(sizeof(jcal_lag_t) <= 4352u) ? 1 : -1];

/// Everything that was learnt with other times is forgotten.
static void begin(jcal_lag_t *self)
{
    jcal_clear(&self->sums, sizeof self->sums);
    jcal_clear(&self->search, sizeof self->search);
    jcal_clear(&self->verdict, sizeof self->verdict);
    self->verdict.bound_s = JCAL_LAG_UNKNOWN_S;
    self->verdict.share = 1.0f;
    self->filled = 0u;
    self->skips = false;
    self->half_done = false;
}

jcal_status_t jcal_lag_init(jcal_lag_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    jcal_clear(self, sizeof *self);
    self->prepared = true;
    self->known_bound_s = JCAL_LAG_UNKNOWN_S;
    begin(self);
    return JCAL_OK;
}

static bool is_warm(const jcal_tick_t *tick)
{
    return tick->since_s >= ((tick->epoch > 1u) ? WARM_S : WARM_FIRST_S);
}

jcal_status_t jcal_lag_add(jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL) || !self->prepared) {
        return JCAL_ERR_ARG;
    }
    (void)jcal_lag_sums_finish(self);
    const jcal_ticks_t kind = jcal_ticks_take(&self->ticks, tick1, tick2);
    if (kind == JCAL_TICKS_REJECTED) {
        return JCAL_REJECTED;
    }
    const bool warm = is_warm(tick1) && is_warm(tick2); /* until then inclinations are wrong, each by its own */
    if ((kind == JCAL_TICKS_ANEW) || !warm) {
        self->filled = 0u;
        self->skips = false;
    }
    if (!warm) {
        return JCAL_OK;
    }
    self->sums.motion_s += jcal_ticks_weigh(&self->ticks, tick1, tick2).motion_s;
    self->node_s = tick1->dt_s;
    jcal_lag_sums_keep(self, tick1, tick2);
    if (!self->skips) {
        jcal_lag_sums_begin(self);
    }
    self->skips = !self->skips;
    return JCAL_OK;
}

/// 95 % bound of the lag, s, from the curvature: of so many readings J is known to share / readings, and it grows by bend lag^2 / 2.
static float bound_of(const jcal_lag_t *self, float share)
{
    const float readings = 3.0f * self->sums.motion_s / READING_S;
    const float information = self->search.bend * readings;
    if (!(information > FLT_MIN)) {
        return JCAL_LAG_UNKNOWN_S;
    }
    const float spread_s = self->node_s * sqrtf(2.0f * (share + SHARE_FLOOR) / information);
    return jcal_min(FLOOR_S + (DEVIATIONS * spread_s), JCAL_LAG_UNKNOWN_S);
}

/// True if there is a lag at which both sensors tell of one centre, but for such a share, and no other.
static bool is_one_joint(const jcal_lag_verdict_t *verdict, float share_max)
{
    return (verdict->share <= share_max) && (verdict->rival >= RIVAL_MIN);
}

/// True if nothing speaks against what was found.
static bool fits(const jcal_lag_t *self)
{
    const jcal_lag_verdict_t *const verdict = &self->verdict;
    const bool has_moved = (self->sums.motion_s >= MOTION_MIN_S) && (verdict->speed2 >= SPEED2_MIN);
    return has_moved && is_one_joint(verdict, SHARE_MAX) && (verdict->bound_s <= BOUND_MAX_S) &&
           (fabsf(self->taken_s + verdict->lag_s) <= (RANGE_S + verdict->bound_s));
}

/// True if what was judged contradicts what is known; sums that began anew do not yet tell the lag, but do not deny it either.
static bool is_denied(const jcal_lag_t *self)
{
    const jcal_lag_verdict_t *const verdict = &self->verdict;
    const bool is_other = fabsf(verdict->lag_s - self->left_s) > (verdict->bound_s + self->known_bound_s);
    return self->known && (self->sums.motion_s >= MOTION_DENIES_S) &&
           (!is_one_joint(verdict, SHARE_DENIES) || is_other);
}

/// What is known stays so until something speaks against it. Then the sums are of two lags, or of ticks that tell of none, and begin anew.
static void decide(jcal_lag_t *self)
{
    const jcal_lag_verdict_t *const verdict = &self->verdict;
    if (verdict->agreed >= AGREED_MIN) {
        self->known = true;
        self->left_s = verdict->lag_s;
        self->known_bound_s = verdict->bound_s;
    } else if (is_denied(self)) {
        self->known = false;
        self->left_s = 0.0f;
        self->known_bound_s = JCAL_LAG_UNKNOWN_S;
        begin(self);
    } else {
        /* nothing new */
    }
}

static void judge(jcal_lag_t *self)
{
    const jcal_lag_point_t *const best = &self->search.best;
    jcal_lag_verdict_t *const verdict = &self->verdict;
    const float before_s = verdict->lag_s;
    verdict->share = jcal_lag_share(best);
    verdict->rival = jcal_lag_rival(&self->search, best->lag) / jcal_max(verdict->share, RIVAL_FLOOR);
    verdict->speed2 = 0.5f * best->own / jcal_max(self->sums.count, 1.0f);
    verdict->lag_s = best->lag * self->node_s;
    verdict->bound_s = bound_of(self, verdict->share);
    const bool agrees = fabsf(verdict->lag_s - before_s) <= verdict->bound_s;
    if (!fits(self)) {
        verdict->agreed = 0u;
    } else if (agrees && (verdict->agreed < AGREED_MOST)) {
        verdict->agreed = (uint8_t)(verdict->agreed + 1u);
    } else if (!agrees) {
        verdict->agreed = 1u;
    } else {
        /* often enough */
    }
    decide(self);
}

jcal_status_t jcal_lag_step(jcal_lag_t *self)
{
    if ((self == NULL) || !self->prepared) {
        return JCAL_ERR_ARG;
    }
    if (self->sums.count < (float)JCAL_LAG_NODES) {
        return JCAL_IDLE;
    }
    if (jcal_lag_sums_finish(self)) {
        return JCAL_OK; /* that was the slice: what is left needs all nodes to have the same terms */
    }
    if (jcal_lag_search(self)) {
        judge(self);
    }
    return JCAL_OK;
}

float jcal_lag_due(const jcal_lag_t *self)
{
    if ((self == NULL) || (self->verdict.agreed < AGREED_MIN)) {
        return 0.0f;
    }
    return (fabsf(self->verdict.lag_s) > self->verdict.bound_s) ? self->verdict.lag_s : 0.0f;
}

float jcal_lag_take(jcal_lag_t *self)
{
    const float due_s = jcal_lag_due(self);
    if (due_s != 0.0f) {
        self->taken_s += due_s;
        self->left_s = 0.0f;
        begin(self);
    }
    return due_s;
}

jcal_status_t jcal_lag_get(const jcal_lag_t *self, jcal_lag_result_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->prepared) {
        return JCAL_ERR_ARG;
    }
    const jcal_lag_result_t result = {
        .lag_known = self->known,
        .lag_s = self->taken_s + self->left_s,
        .bound_s = self->known_bound_s,
        .taken_s = self->taken_s,
        .left = jcal_min(self->verdict.share, 1.0f), /* between nodes a polynomial may be above */
        .motion_s = self->sums.motion_s,
    };
    *out = result;
    return JCAL_OK;
}

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

/// Ticks from node to node, until the lag is roughly taken off.
#define STRIDE_FIRST 2u
/// Largest lag that is believed, s.
#define RANGE_S 0.25f
/// Time that filters must have run, s: before the lag is roughly taken off, and then.
#define WARM_FIRST_S 1.0f
#define WARM_S 2.0f

/// Bound: a floor, s, and so many standard deviations. Motion that takes one independent reading of each of three components, s. Share
/// that the filters of two sensors leave of themselves.
#define FLOOR_S 0.002f
#define DEVIATIONS 1.1f
#define READING_S 1.0f
#define SHARE_FLOOR 0.002f

/// What must hold: share that is left, how much more any other lag leaves, beside a floor, and the centre's squared velocity, (m/s)^2.
#define SHARE_MAX 0.1f
#define RIVAL_MIN 2.5f
#define RIVAL_FLOOR 0.01f
#define SPEED2_MIN 1.6e-3f
/// Motion and bound, s, before the lag is roughly taken off and before it is known.
#define MOTION_FIRST_S 2.0f
#define MOTION_MIN_S 6.0f
#define BOUND_FIRST_S 0.050f
#define BOUND_MAX_S 0.010f
/// Judgements in a row, the same.
#define AGREED_FIRST 2u
#define AGREED_MIN 3u
#define AGREED_MOST 200u
/// A rough lag below this is left where it is, s.
#define STAYS_S 0.04f

typedef char jcal_lag_fits_its_budget[(sizeof(jcal_lag_t) <= 2560u) ? 1 : -1];

/// Everything that was learnt with other times is forgotten.
static void begin(jcal_lag_t *self)
{
    jcal_clear(&self->sums, sizeof self->sums);
    jcal_clear(&self->search, sizeof self->search);
    jcal_clear(&self->verdict, sizeof self->verdict);
    self->verdict.bound_s = JCAL_LAG_UNKNOWN_S;
    self->verdict.share = 1.0f;
    self->filled = 0u;
    self->skipped = 0u;
}

jcal_status_t jcal_lag_init(jcal_lag_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    jcal_clear(self, sizeof *self);
    self->stride = STRIDE_FIRST;
    self->known_bound_s = JCAL_LAG_UNKNOWN_S;
    begin(self);
    return JCAL_OK;
}

static bool is_rough(const jcal_lag_t *self)
{
    return self->stride > 1u;
}

/// True once the sensors' filters have run for long enough: until then inclinations are wrong by degrees, each by its own.
static bool is_warm(const jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    return jcal_min(tick1->since_s, tick2->since_s) >= (is_rough(self) ? WARM_FIRST_S : WARM_S);
}

jcal_status_t jcal_lag_add(jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    if ((self == NULL) || (tick1 == NULL) || (tick2 == NULL) || (self->stride == 0u)) {
        return JCAL_ERR_ARG;
    }
    const jcal_ticks_t kind = jcal_ticks_take(&self->ticks, tick1, tick2);
    if (kind == JCAL_TICKS_REJECTED) {
        return JCAL_REJECTED;
    }
    const bool warm = is_warm(self, tick1, tick2);
    if ((kind == JCAL_TICKS_ANEW) || !warm) {
        self->filled = 0u;
        self->skipped = 0u;
    }
    if (!warm) {
        return JCAL_OK;
    }
    self->sums.motion_s += jcal_ticks_weigh(&self->ticks, tick1, tick2).motion_s;
    self->skipped = (uint8_t)(self->skipped + 1u);
    if (self->skipped >= self->stride) {
        self->skipped = 0u;
        self->node_s = (float)self->stride * tick1->dt_s;
        jcal_lag_sums_take(self, tick1, tick2);
    }
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

/// True if there is a lag at which both sensors tell of one centre, and no other.
static bool is_one_joint(const jcal_lag_verdict_t *verdict)
{
    return (verdict->share <= SHARE_MAX) && (verdict->rival >= RIVAL_MIN);
}

/// True if nothing speaks against what was found.
static bool fits(const jcal_lag_t *self)
{
    const jcal_lag_verdict_t *const verdict = &self->verdict;
    const bool has_moved =
        (self->sums.motion_s >= (is_rough(self) ? MOTION_FIRST_S : MOTION_MIN_S)) && (verdict->speed2 >= SPEED2_MIN);
    const bool is_sharp = verdict->bound_s <= (is_rough(self) ? BOUND_FIRST_S : BOUND_MAX_S);
    return has_moved && is_one_joint(verdict) && is_sharp &&
           (fabsf(self->taken_s + verdict->lag_s) <= (RANGE_S + verdict->bound_s));
}

/// What is known stays so until something speaks against it: sums that began anew do not yet tell the lag, but do not deny it either.
static void decide(jcal_lag_t *self)
{
    const jcal_lag_verdict_t *const verdict = &self->verdict;
    const bool is_denied =
        !is_one_joint(verdict) || (fabsf(verdict->lag_s - self->left_s) > (verdict->bound_s + self->known_bound_s));
    if (verdict->agreed >= AGREED_MIN) {
        self->known = true;
        self->left_s = verdict->lag_s;
        self->known_bound_s = verdict->bound_s;
    } else if (is_denied) {
        self->known = false;
        self->left_s = 0.0f;
        self->known_bound_s = JCAL_LAG_UNKNOWN_S;
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
    if (!is_rough(self) && (self->sums.motion_s >= MOTION_MIN_S)) {
        decide(self);
    }
}

jcal_status_t jcal_lag_step(jcal_lag_t *self)
{
    if ((self == NULL) || (self->stride == 0u)) {
        return JCAL_ERR_ARG;
    }
    if (self->sums.count < (float)JCAL_LAG_NODES) {
        return JCAL_IDLE;
    }
    if (jcal_lag_search(self)) {
        judge(self);
    }
    return JCAL_OK;
}

float jcal_lag_take(jcal_lag_t *self)
{
    if ((self == NULL) || (self->verdict.agreed < (is_rough(self) ? AGREED_FIRST : AGREED_MIN))) {
        return 0.0f;
    }
    const bool rough = is_rough(self);
    const bool is_off = fabsf(self->verdict.lag_s) > (rough ? STAYS_S : self->verdict.bound_s);
    const float off_s = is_off ? self->verdict.lag_s : 0.0f;
    self->stride = 1u;
    if (rough || is_off) {
        self->taken_s += off_s;
        self->left_s = 0.0f;
        begin(self);
    }
    return off_s;
}

jcal_status_t jcal_lag_get(const jcal_lag_t *self, jcal_lag_result_t *out)
{
    if ((self == NULL) || (out == NULL) || (self->stride == 0u)) {
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

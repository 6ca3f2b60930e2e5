/* SPDX-License-Identifier: MIT */
/// @file
/// Checks of single pairs of orientations. See orientation.h.
#include "jointcal/orientation.h"

#include "math/scalar.h"
#include "sample/clock.h"
#include "sample/unit.h"

#include <stddef.h>

/// As in gate.c: share of bad samples that may be lived with, and the weight of the newest.
#define BAD_SHARE_MAX 0.2f
#define BAD_STEP 0.02f
#define BAD_TIME_S 2.0f

static bool same(jcal_quat_t a, jcal_quat_t b)
{
    return (a.w == b.w) && (a.x == b.x) && (a.y == b.y) && (a.z == b.z);
}

/* A sensor that keeps still turns a little all the time, if only by noise: equal bits mean that no new value came. */
static float still(float still_s, bool same_bits, float dt_s)
{
    return same_bits ? (still_s + dt_s) : 0.0f;
}

static jcal_reject_t verdict(jcal_orientation_gate_t *self, const jcal_gate_config_t *config,
                             const jcal_orientation_pair_t *pair, float *dt_s)
{
    *dt_s = 0.0f;
    const float square1 = jcal_unit_length2(pair->q1);
    const float square2 = jcal_unit_length2(pair->q2);
    if (!jcal_is_finite(square1) || !jcal_is_finite(square2)) {
        return JCAL_REJECT_NOT_FINITE;
    }
    const jcal_reject_t time = jcal_clock_check(&self->clock, config->gap_s, pair->t_us, dt_s);
    if (time == JCAL_REJECT_TIME_ORDER) {
        return time;
    }
    if (!jcal_is_unit(pair->q1) || !jcal_is_unit(pair->q2)) {
        return JCAL_REJECT_OUT_OF_RANGE;
    }
    const bool begins = !self->has_last || (time == JCAL_REJECT_GAP);
    self->still1_s = still(self->still1_s, !begins && same(pair->q1, self->last.q1), *dt_s);
    self->still2_s = still(self->still2_s, !begins && same(pair->q2, self->last.q2), *dt_s);
    self->last.q1 = pair->q1;
    self->last.q2 = pair->q2;
    self->has_last = true;
    if ((self->still1_s > config->frozen_s) || (self->still2_s > config->frozen_s)) {
        return JCAL_REJECT_FROZEN;
    }
    if ((self->still1_s > 0.0f) || (self->still2_s > 0.0f)) {
        return JCAL_REJECT_REPEATED;
    }
    return time;
}

jcal_reject_t jcal_orientation_gate_check(jcal_orientation_gate_t *self, const jcal_gate_config_t *config,
                                          const jcal_orientation_pair_t *pair)
{
    if ((self == NULL) || (config == NULL) || (pair == NULL)) {
        return JCAL_REJECT_NOT_FINITE;
    }
    float dt_s;
    const jcal_reject_t outcome = verdict(self, config, pair, &dt_s);
    self->samples += 1u;
    if (outcome != JCAL_REJECT_NONE) {
        self->rejected_by[outcome] += 1u;
    }
    const float bad = (outcome == JCAL_REJECT_NONE) ? 0.0f : 1.0f;
    /* While a clock that began anew is not yet believed, samples count for their time. */
    const bool by_time = (outcome == JCAL_REJECT_TIME_ORDER) && (dt_s > 0.0f);
    self->bad_share += (by_time ? (dt_s / (dt_s + BAD_TIME_S)) : BAD_STEP) * (bad - self->bad_share);
    return outcome;
}

jcal_reason_t jcal_orientation_gate_complaint(const jcal_orientation_gate_t *self)
{
    if (jcal_clock_is_slow(&self->clock)) {
        return JCAL_REASON_RATE_TOO_LOW;
    }
    return (self->bad_share > BAD_SHARE_MAX) ? JCAL_REASON_BAD_SAMPLES : JCAL_REASON_NONE;
}

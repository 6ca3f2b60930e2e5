/* SPDX-License-Identifier: MIT */
/// @file
/// Checks of single pairs of orientations. See orientation.h.
#include "jointcal/orientation.h"

#include "math/scalar.h"
#include "sample/clock.h"

#include <stddef.h>

/// Square of the length of a quaternion, least and most: 1 -+ 0.05 in length.
#define LENGTH2_MIN 0.9025f
#define LENGTH2_MAX 1.1025f

/// As in gate.c: time over which bad samples are counted, s, for samples that are this far apart.
#define BAD_STEP 0.02f
#define BAD_TIME_S 2.0f

static float length2(jcal_quat_t q)
{
    return (q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z);
}

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
    const float square1 = length2(pair->q1);
    const float square2 = length2(pair->q2);
    if (!jcal_is_finite(square1) || !jcal_is_finite(square2)) {
        return JCAL_REJECT_NOT_FINITE;
    }
    const jcal_reject_t time = jcal_clock_check(&self->clock, config->gap_s, pair->t_us, dt_s);
    if (time == JCAL_REJECT_TIME_ORDER) {
        return time;
    }
    if (!jcal_within(square1, LENGTH2_MIN, LENGTH2_MAX) || !jcal_within(square2, LENGTH2_MIN, LENGTH2_MAX)) {
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
    const float bad = ((outcome == JCAL_REJECT_NONE) || (outcome == JCAL_REJECT_GAP)) ? 0.0f : 1.0f;
    /* While a clock that began anew is not yet believed, samples count for their time. */
    const bool by_time = (outcome == JCAL_REJECT_TIME_ORDER) && (dt_s > 0.0f);
    self->bad_share += (by_time ? (dt_s / (dt_s + BAD_TIME_S)) : BAD_STEP) * (bad - self->bad_share);
    return outcome;
}

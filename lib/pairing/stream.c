/* SPDX-License-Identifier: MIT */
/// @file
/// Pairs of readings at common times. See pairing.h.
///
/// Common times are numbered; number n is at n periods. A push makes a stretch, from the sensor's reading before to this one. Of the sensor
/// that is ahead its common times go into the ring at once; those of the other one meet them there when they are pulled. When the ring
/// is empty the rest of the stretch goes into it, and the other sensor is ahead. So one ring serves both.
#include "jointcal/pairing.h"

#include "math/clear.h"
#include "pairing/line.h"
#include "sample/clock.h"

#include <stddef.h>

#define MICROSECONDS 1e-6f
/// More common times than any stretch has.
#define STRETCH_MOST 32u

typedef char jcal_pairing_fits_its_budget
    [((sizeof(jcal_pairing_t) - (JCAL_PAIRING_WAITING * (sizeof(jcal_imu_t) + sizeof(uint32_t)))) <= 352u) ? 1 : -1];

jcal_status_t jcal_pairing_init(jcal_pairing_t *self, const jcal_pairing_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_pairing_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    jcal_clear(self, sizeof *self);
    self->cfg = *config;
    self->period_us = (uint32_t)((config->period_s / MICROSECONDS) + 0.5f);
    return JCAL_OK;
}

/// The reading at the next common time of the stretch.
static jcal_imu_t next_of(const jcal_pairing_t *self)
{
    const jcal_pairing_stretch_t *const stretch = &self->stretch;
    const jcal_imu_t *const after = &self->sensor[stretch->sensor].imu;
    const uint32_t since_us = (uint32_t)((stretch->next * self->period_us) - stretch->from_us);
    const float share = (float)since_us / stretch->length_us;
    return jcal_line_at(&stretch->before, after, share);
}

static void drop_oldest(jcal_pairing_t *self)
{
    self->first = (uint16_t)((self->first + 1u) % JCAL_PAIRING_WAITING);
    self->count = (uint16_t)(self->count - 1u);
}

/// Indices that a damaged memory may have put out of their arrays. What is left of a stretch is as long as one can be.
static void stay_within(jcal_pairing_t *self)
{
    jcal_pairing_stretch_t *const stretch = &self->stretch;
    self->first = (uint16_t)(self->first % JCAL_PAIRING_WAITING);
    self->count = (self->count <= JCAL_PAIRING_WAITING) ? self->count : 0u;
    self->ahead &= 1u;
    stretch->sensor &= 1u;
    if ((stretch->end - stretch->next) > STRETCH_MOST) {
        stretch->next = stretch->end;
    }
}

/// The rest of the stretch goes into the ring; what is too old for it is lost.
static void let_wait(jcal_pairing_t *self)
{
    jcal_pairing_stretch_t *const stretch = &self->stretch;
    self->ahead = stretch->sensor;
    for (; stretch->next < stretch->end; ++stretch->next) {
        if (self->count == JCAL_PAIRING_WAITING) {
            drop_oldest(self);
            self->lost[self->ahead] += 1u;
        }
        const size_t at = ((size_t)self->first + self->count) % JCAL_PAIRING_WAITING;
        self->waiting[at] = next_of(self);
        self->numbers[at] = (uint32_t)stretch->next;
        self->count = (uint16_t)(self->count + 1u);
    }
}

/// The next common time at which both are known. False if there is none.
static bool next_pair(jcal_pairing_t *self, jcal_pair_t *pair)
{
    jcal_pairing_stretch_t *const stretch = &self->stretch;
    while ((self->count > 0u) &&
           (stretch->next < stretch->end)) { /* each time one that waits goes, or the stretch does */
        const int32_t behind = (int32_t)(self->numbers[self->first] - (uint32_t)stretch->next);
        const uint32_t rest = (uint32_t)(stretch->end - stretch->next);
        if (behind < 0) {
            drop_oldest(self);
            self->lost[self->ahead] += 1u;
        } else if ((uint32_t)behind >= rest) {
            self->lost[stretch->sensor] += rest;
            stretch->next = stretch->end;
        } else {
            self->lost[stretch->sensor] += (uint32_t)behind;
            stretch->next += (uint32_t)behind;
            const jcal_imu_t own = next_of(self);
            const jcal_imu_t other = self->waiting[self->first];
            pair->t_us = stretch->next * self->period_us;
            pair->imu1 = (stretch->sensor == 0u) ? own : other;
            pair->imu2 = (stretch->sensor == 0u) ? other : own;
            drop_oldest(self);
            stretch->next += 1u;
            self->past = stretch->next;
            return true;
        }
    }
    if (self->count == 0u) {
        let_wait(self);
    }
    return false;
}

/// What was not pulled is lost.
static void finish(jcal_pairing_t *self)
{
    jcal_pair_t pair;
    while (next_pair(self, &pair)) { /* each takes one that waits */
        self->lost[0] += 1u;
        self->lost[1] += 1u;
    }
}

/// Nothing waits any more.
static void empty(jcal_pairing_t *self)
{
    self->lost[self->ahead] += self->count;
    self->count = 0u;
    self->stretch.next = self->stretch.end;
}

/// The sensor's next stretch begins here.
static void begin_at(const jcal_pairing_t *self, jcal_pairing_sensor_t *sensor, uint64_t t_us)
{
    sensor->next = (t_us / self->period_us) + 1u;
    sensor->t_us = t_us;
    sensor->has_last = true;
}

/// A stretch up to t_us, not longer than gap_s: at most 25 common times.
static void stretch_to(jcal_pairing_t *self, unsigned index, uint64_t t_us)
{
    jcal_pairing_sensor_t *const sensor = &self->sensor[index];
    jcal_pairing_stretch_t *const stretch = &self->stretch;
    stretch->sensor = (uint8_t)index;
    stretch->from_us = sensor->t_us;
    stretch->before = sensor->imu;
    stretch->length_us = (float)(uint32_t)(t_us - sensor->t_us);
    stretch->next = sensor->next;
    /* A difference: the last common time before time ends may have none after it. */
    const uint64_t since_us = t_us - stretch->from_us;
    for (unsigned n = 0u; (n < STRETCH_MOST) && ((t_us - (sensor->next * self->period_us)) < since_us); ++n) {
        ++sensor->next;
    }
    stretch->end = sensor->next;
    sensor->t_us = t_us;
    if (stretch->next < self->begin) {
        stretch->next = (self->begin < stretch->end) ? self->begin : stretch->end;
    }
}

/// True if the stretch from the sensor's last reading to t_us may be filled.
static bool goes_on(const jcal_pairing_t *self, const jcal_pairing_sensor_t *sensor, uint64_t t_us)
{
    const uint64_t since_us = t_us - sensor->t_us;
    return sensor->has_last && (t_us > sensor->t_us) && (since_us <= UINT32_MAX) &&
           (((float)(uint32_t)since_us * MICROSECONDS) <= self->cfg.gap_s);
}

jcal_status_t jcal_pairing_push(jcal_pairing_t *self, unsigned which, const jcal_reading_t *reading)
{
    if ((self == NULL) || (reading == NULL) || (which < 1u) || (which > 2u) || (self->period_us == 0u)) {
        return JCAL_ERR_ARG;
    }
    stay_within(self);
    finish(self);
    const unsigned index = which - 1u;
    jcal_pairing_sensor_t *const sensor = &self->sensor[index];
    const int64_t off_us = (index == 1u) ? self->shift_us : 0;
    const bool before_time = (off_us > 0) && (reading->t_us < (uint64_t)off_us);
    if (before_time || !jcal_sensor_may_take(&reading->imu)) {
        self->rejected += 1u;
        return JCAL_REJECTED;
    }
    const bool goes_back = sensor->clock.has_last && (reading->t_us < sensor->clock.last_us);
    float dt_s;
    if (jcal_clock_check(&sensor->clock, self->cfg.gap_s, reading->t_us, &dt_s) == JCAL_REJECT_TIME_ORDER) {
        self->rejected += 1u;
        return JCAL_REJECTED;
    }
    const uint64_t t_us = reading->t_us - (uint64_t)off_us;
    if (goes_back) {
        empty(self); /* the clock began anew, or time ended */
        self->past = 0u;
        self->begin = 0u;
    }
    const bool has_stretch = goes_on(self, sensor, t_us);
    if (has_stretch) {
        stretch_to(self, index, t_us);
    } else {
        begin_at(self, sensor, t_us);
    }
    sensor->imu = reading->imu;
    if (has_stretch && ((self->count == 0u) || (self->ahead == index))) {
        let_wait(self);
    }
    return JCAL_OK;
}

jcal_status_t jcal_pairing_pull(jcal_pairing_t *self, jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL) || (self->period_us == 0u)) {
        return JCAL_ERR_ARG;
    }
    stay_within(self);
    if (!next_pair(self, pair)) {
        return JCAL_IDLE;
    }
    self->pairs += 1u;
    return JCAL_OK;
}

jcal_status_t jcal_pairing_shift(jcal_pairing_t *self, float lag_s)
{
    if ((self == NULL) || (self->period_us == 0u) || !((lag_s >= -1.0f) && (lag_s <= 1.0f))) {
        return JCAL_ERR_ARG;
    }
    const float rounding = (lag_s < 0.0f) ? -0.5f : 0.5f;
    const int64_t shift_us = self->shift_us + (int64_t)((lag_s / MICROSECONDS) + rounding);
    const int64_t most_us = (int64_t)((JCAL_PAIRING_SHIFT_MAX_S / MICROSECONDS) + 0.5f);
    if ((shift_us > most_us) || (shift_us < -most_us)) {
        return JCAL_ERR_ARG;
    }
    empty(self);
    self->shift_us = shift_us;
    self->sensor[1].has_last = false;
    self->begin = self->past + (JCAL_PAIRING_HOLE_US / self->period_us) + 1u;
    return JCAL_OK;
}

jcal_status_t jcal_pairing_align(jcal_pairing_t *self, jcal_lag_t *lag)
{
    if ((self == NULL) || (lag == NULL) || (self->period_us == 0u)) {
        return JCAL_ERR_ARG;
    }
    const float lag_s = jcal_lag_due(lag);
    if (lag_s == 0.0f) {
        return JCAL_IDLE;
    }
    const jcal_status_t status = jcal_pairing_shift(self, lag_s);
    if (status == JCAL_OK) {
        (void)jcal_lag_take(lag);
    }
    return status;
}

jcal_status_t jcal_pairing_get(const jcal_pairing_t *self, jcal_pairing_result_t *out)
{
    if ((self == NULL) || (out == NULL) || (self->period_us == 0u)) {
        return JCAL_ERR_ARG;
    }
    const jcal_pairing_result_t result = {
        .shift_s = (float)self->shift_us * MICROSECONDS,
        .pairs = self->pairs,
        .lost1 = self->lost[0],
        .lost2 = self->lost[1],
        .rejected = self->rejected,
        .waiting = self->count,
        .ahead = self->ahead + 1u,
    };
    *out = result;
    return JCAL_OK;
}

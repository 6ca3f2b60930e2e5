/* SPDX-License-Identifier: MIT */
/// @file
/// One sensor's readings at common times. See body/line.h.
#include "body/line.h"

#include "pairing/line.h"

#define MICROSECONDS 1e-6f

/// Begins at number `from` or later: after a hole, and at a multiple of the ticks' distance.
static void begin_at(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t from)
{
    const uint32_t after_hole = (self->last == 0u) ? 0u : (self->last + pace->hole);
    const uint32_t least = (from > after_hole) ? from : after_hole;
    const uint32_t begin = ((least + pace->stride - 1u) / pace->stride) * pace->stride;
    self->begin = (begin > self->begin) ? begin : self->begin;
}

void jcal_body_line_begin(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t from)
{
    self->has = false;
    begin_at(self, pace, from);
}

bool jcal_body_line_put(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint64_t t_us, const jcal_imu_t *imu)
{
    if (self->has && (t_us <= self->after_us)) {
        return false;
    }
    const uint64_t since_us = t_us - self->after_us;
    const bool goes_on =
        self->has && (since_us <= UINT32_MAX) && (((float)(uint32_t)since_us * MICROSECONDS) <= pace->gap_s);
    if (goes_on) {
        self->before = self->after;
        self->before_us = self->after_us;
    } else {
        self->before = *imu;
        self->before_us = t_us;
        begin_at(self, pace, (uint32_t)((t_us + pace->period_us - 1u) / pace->period_us));
    }
    self->after = *imu;
    self->after_us = t_us;
    self->has = true;
    return true;
}

bool jcal_body_line_tells(const jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n)
{
    const uint64_t t_us = (uint64_t)n * pace->period_us;
    return self->has && (n >= self->begin) && (self->before_us <= t_us) && (t_us <= self->after_us);
}

jcal_imu_t jcal_body_line_read(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n)
{
    self->last = n;
    const uint64_t t_us = (uint64_t)n * pace->period_us;
    if (t_us == self->after_us) {
        return self->after; /* also where there is none before */
    }
    const float share = (float)(uint32_t)(t_us - self->before_us) / (float)(uint32_t)(self->after_us - self->before_us);
    return jcal_line_at(&self->before, &self->after, share);
}

void jcal_body_line_miss(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n)
{
    begin_at(self, pace, n + 1u);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Distances of readings. See health/pace.h.
#include "health/pace.h"

#include "math/scalar.h"

/// Readings that the mean remembers.
#define MEMORY 128.0f
/// Usual distances from which on there is a gap, once so many distances were seen.
#define GAP_TIMES 2.5f
#define READINGS_MIN 20u
/// Longest distance that counts as one, us.
#define LONGEST_US 1000000u
/// Largest number of readings that one gap lost.
#define LOST_MOST 1e6f

static void count_gap(jcal_health_pace_t *self, uint64_t dt_us)
{
    const float gap_s = (dt_us < UINT32_MAX) ? (1e-6f * (float)(uint32_t)dt_us) : 4295.0f;
    const float lost = jcal_max(jcal_min((gap_s / self->period_s) - 0.5f, LOST_MOST), 0.0f);
    self->longest_s = jcal_max(self->longest_s, gap_s);
    self->gaps = (uint16_t)(self->gaps + ((self->gaps < UINT16_MAX) ? 1u : 0u));
    if (self->lost < (UINT32_MAX / 2u)) {
        self->lost += (uint32_t)lost;
    }
}

void jcal_health_pace_add(jcal_health_pace_t *self, uint64_t dt_us)
{
    const bool is_known = self->readings >= READINGS_MIN;
    self->readings += (self->readings < UINT32_MAX) ? 1u : 0u;
    const float dt_s = (dt_us < LONGEST_US) ? (1e-6f * (float)(uint32_t)dt_us) : 1.0f;
    if (is_known && (dt_s > (GAP_TIMES * self->period_s))) {
        count_gap(self, dt_us);
        return;
    }
    const float count = jcal_min((float)self->readings, MEMORY);
    const float off_s = dt_s - self->period_s;
    self->period_s += off_s / count;
    self->spread_s2 += ((off_s * (dt_s - self->period_s)) - self->spread_s2) / count;
}

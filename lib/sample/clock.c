/* SPDX-License-Identifier: MIT */
/// @file
/// Which times are believed. See sample/clock.h.
#include "sample/clock.h"

#define MICROSECONDS 1e-6f

/// True if a time goes on from another; then `dt_s` is the distance.
static bool goes_on(uint64_t from_us, uint64_t t_us, float gap_s, float *dt_s)
{
    const uint64_t since_us = t_us - from_us;
    if ((since_us == 0u) || (since_us > UINT32_MAX)) { /* 71 min, beyond any limit; so if it went back */
        return false;
    }
    const float since_s = (float)(uint32_t)since_us * MICROSECONDS;
    if (!(since_s <= gap_s)) {
        return false;
    }
    *dt_s = since_s;
    return true;
}

static void believe(jcal_clock_t *self, uint64_t t_us)
{
    self->last_us = t_us;
    self->has_last = true;
    self->has_odd = false;
}

/// What jcal_clock_check returns and puts out.
static jcal_reject_t follow(jcal_clock_t *self, float gap_s, uint64_t t_us, float *dt_s)
{
    *dt_s = 0.0f;
    if (!self->has_last || goes_on(self->last_us, t_us, gap_s, dt_s)) {
        believe(self, t_us);
        return JCAL_REJECT_NONE;
    }
    const bool is_later = t_us > self->last_us;
    if (self->has_odd && goes_on(self->odd_us, t_us, gap_s, dt_s)) {
        self->run_us += (uint32_t)(t_us - self->odd_us); /* at most gap_s, 10 s */
        self->odd_us = t_us;
        if (is_later) {
            believe(self, t_us);
            return JCAL_REJECT_NONE;
        }
        if (self->run_us >= JCAL_CLOCK_ANEW_US) {
            believe(self, t_us);
            return JCAL_REJECT_GAP;
        }
        return JCAL_REJECT_TIME_ORDER;
    }
    self->odd_us = t_us;
    self->run_us = 0u;
    self->has_odd = true;
    return is_later ? JCAL_REJECT_GAP : JCAL_REJECT_TIME_ORDER;
}

jcal_reject_t jcal_clock_check(jcal_clock_t *self, float gap_s, uint64_t t_us, float *dt_s)
{
    const jcal_reject_t outcome = follow(self, gap_s, t_us, dt_s);
    if ((outcome == JCAL_REJECT_GAP) || (*dt_s > JCAL_CLOCK_SLOW_S)) {
        self->slow = (uint8_t)((self->slow < JCAL_CLOCK_SLOW_MOST) ? (self->slow + 1u) : JCAL_CLOCK_SLOW_MOST);
    } else if ((outcome == JCAL_REJECT_NONE) && (self->slow > 0u)) {
        self->slow = (uint8_t)(self->slow - 1u);
    } else {
        /* fast enough, or time that is not believed */
    }
    return outcome;
}

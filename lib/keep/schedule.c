/* SPDX-License-Identifier: MIT */
/// @file
/// How often flash may be written. See jointcal/keep_flash.h; what it wears: docs/METHOD_HUB.md, section 3.
#include "jointcal/keep_flash.h"

#include <stddef.h>

/// From when the first thing is worth a write until it may be: other joints join, s.
#define FIRST_S 60u
/// After the first write, s; it doubles with each write ...
#define SECOND_S 120u
/// ... up to this: 13 writes in a day of 16 hours.
#define MOST_S 7680u

void jcal_keep_schedule_init(jcal_keep_schedule_t *self)
{
    if (self != NULL) {
        *self = (jcal_keep_schedule_t){0};
    }
}

bool jcal_keep_due(jcal_keep_schedule_t *self, uint64_t t_us, bool is_worth)
{
    if ((self == NULL) || !is_worth) {
        return false;
    }
    if (!self->has_since || (t_us < self->since_us)) {
        self->since_us = t_us;
        self->wait_s = self->has_since ? self->wait_s : FIRST_S;
        self->has_since = true;
    }
    return (t_us - self->since_us) >= ((uint64_t)self->wait_s * 1000000u);
}

void jcal_keep_written(jcal_keep_schedule_t *self, uint64_t t_us)
{
    if (self == NULL) {
        return;
    }
    const uint32_t twice = (self->wait_s < SECOND_S) ? SECOND_S : (2u * self->wait_s);
    self->wait_s = (twice < MOST_S) ? twice : MOST_S;
    self->since_us = t_us;
    self->has_since = true;
}

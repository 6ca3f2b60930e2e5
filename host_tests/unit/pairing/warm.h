/* SPDX-License-Identifier: MIT */
/* Ticks of a hinge whose filters have run for long. */
#ifndef UNIT_PAIRING_WARM_H
#define UNIT_PAIRING_WARM_H

#include "unit/ball/fixture.h"

static inline jcal_tick_t warm_tick(const hinge_t *arm, double t, int sensor, uint64_t t_us)
{
    jcal_tick_t out = hinge_tick(arm, t, sensor, t_us);
    out.since_s = 1000.0f;
    return out;
}

#endif

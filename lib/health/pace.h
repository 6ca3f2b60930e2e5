/* SPDX-License-Identifier: MIT */
/// @file
/// Distances of readings: their mean, how they scatter, and what is missing. Private.
#ifndef JCAL_HEALTH_PACE_H
#define JCAL_HEALTH_PACE_H

#include "jointcal/private/health/state.h"

/// Takes in the time of a reading; dt_us is its distance from the last one. Cost: about 30 instructions.
void jcal_health_pace_add(jcal_health_pace_t *self, uint64_t dt_us);

#endif /* JCAL_HEALTH_PACE_H */

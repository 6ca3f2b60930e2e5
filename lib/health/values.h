/* SPDX-License-Identifier: MIT */
/// @file
/// Values that stay, or that come more than once. Private.
///
/// Only readings in motion count: a sensor at rest may well read the same again. A reading is one in motion if the rate is above 0.5 rad/s or the
/// specific force changed by more than 5 %.
#ifndef JCAL_HEALTH_VALUES_H
#define JCAL_HEALTH_VALUES_H

#include "jointcal/private/health/state.h"

/// Takes in a reading that came dt_us after the last one. Cost: about 100 instructions.
void jcal_health_values_add(jcal_health_values_t *self, const jcal_imu_t *imu, const jcal_health_squares_t *squares,
                            uint32_t dt_us);

/// Bits of the components that are dead.
uint8_t jcal_health_values_dead(const jcal_health_values_t *self);

/// How often a reading comes, of forces, rates or both, whatever is more: 1 if each is new; 0 if that is not known.
float jcal_health_values_times(const jcal_health_values_t *self);

#endif /* JCAL_HEALTH_VALUES_H */

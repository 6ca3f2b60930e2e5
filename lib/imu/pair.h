/* SPDX-License-Identifier: MIT */
/// @file
/// Two sensors whose readings come in pairs: the gate before both, their ticks, and how much work a reading pays for. Private.
#ifndef JCAL_IMU_PAIR_H
#define JCAL_IMU_PAIR_H

#include "jointcal/private/sensor/pair.h"
#include "jointcal/status.h"

#include <stdbool.h>

/// What became of a pair of readings.
typedef struct {
    jcal_status_t status;  ///< JCAL_OK or JCAL_REJECTED.
    bool has_ticks;        ///< Both sensors made a tick.
    unsigned slices;       ///< Slices of work that may be done now, at most 16; 0 if nothing was taken in.
} jcal_sensor_pair_step_t;

/// Prepares both. `limits` of single samples; null: the defaults. Errors: JCAL_ERR_CONFIG; self untouched.
jcal_status_t jcal_sensor_pair_init(jcal_sensor_pair_t *self, const jcal_gate_config_t *limits);

/// Takes in a pair of readings. Of a joint that does `slices_per_s` slices of work.
jcal_sensor_pair_step_t jcal_sensor_pair_push(jcal_sensor_pair_t *self, const jcal_pair_t *pair, float slices_per_s);

#endif /* JCAL_IMU_PAIR_H */

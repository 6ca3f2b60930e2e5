/* SPDX-License-Identifier: MIT */
/// @file
/// What the readings of one sensor show: range, clipping, what stands still, units. Private.
#ifndef JCAL_GATE_SENSOR_H
#define JCAL_GATE_SENSOR_H

#include "jointcal/gate.h"

/// True if no component is NaN or infinite, whatever the compiler believes of NaN.
bool jcal_gate_sensor_is_finite(const jcal_imu_t *imu);

/// The first sample, and the first one after a hole: nothing to compare with.
void jcal_gate_sensor_start(jcal_gate_sensor_t *self, const jcal_imu_t *imu);

/// The same for the first one ever, whose specific force is all that is known of gravity. Returns as jcal_gate_sensor_check.
jcal_reject_t jcal_gate_sensor_begin(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const jcal_imu_t *imu);

/// Takes in a finite reading `dt_s` after the last one.
///
/// Returns:  JCAL_REJECT_NONE, _OUT_OF_RANGE, _SATURATED, _FROZEN or _REPEATED.
jcal_reject_t jcal_gate_sensor_check(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const jcal_imu_t *imu,
                                     float dt_s);

/// Extremes fade; called about once a second.
void jcal_gate_sensor_fade(jcal_gate_sensor_t *self);

/// True if the specific force cannot hold gravity in m/s^2.
bool jcal_gate_sensor_acc_looks_wrong(const jcal_gate_sensor_t *self);

/// Follows turns of both sensors, one after the other: how gravity turns in them beside how it should by their rates. `sensor1` and
/// `sensor2` get what is found.
void jcal_gate_sensor_follow_turn(jcal_gate_turn_t *turn, jcal_gate_sensor_t *sensor1, jcal_gate_sensor_t *sensor2,
                                  const jcal_pair_t *pair, float dt_s);

/// True if gravity turns many times slower than the rates say.
bool jcal_gate_sensor_gyr_looks_wrong(const jcal_gate_sensor_t *self);

#endif /* JCAL_GATE_SENSOR_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// One sensor's work, done once however many joints read it: its orientation, the bias of its gyroscope, its low-frequency features.
///
/// How it is used:
///
///     static jcal_sensor_t thigh;
///     (void)jcal_sensor_init(&thigh);
///     if (jcal_sensor_push(&thigh, &reading) == JCAL_TICK) {      for each reading
///         const jcal_tick_t *tick = jcal_sensor_tick(&thigh);     about twenty times a second: the features, tick.h
///         ...
///     }
///     const jcal_quat_t q = jcal_sensor_orientation(&thigh);      whenever you like
///
/// The orientation has z up and a heading of its own, which drifts: there is no magnetometer. The inclination is right from the first
/// sample on if the sensor is at rest then; else it becomes so within seconds.
///
/// Readings are to be valid: checks of clipping, units and clocks are not made here. What could break the filters is rejected all the
/// same. Distances of samples may vary; one longer than 105 ms is a gap: features start anew, the low-pass of the inclination begins
/// again, heading and bias are kept, and the tick's epoch counts up. Time that goes back is a gap too.
///
/// Cost: 0.8 KiB of state; docs/measurements/budget.md has the instructions.
/// Source: orientation and bias in the manner of [VQF]; docs/METHOD_PEOPLE.md, section 1, derives both and the features.
/// Threads: all calls on one sensor belong to one task, or behind the caller's lock.
#ifndef JCAL_SENSOR_H
#define JCAL_SENSOR_H

#include "jointcal/private/sensor/stage.h"
#include "jointcal/status.h"
#include "jointcal/tick.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Largest component of a rate, rad/s, and of a specific force, m/s^2, that is taken in: beyond what any sensor for people can read.
#define JCAL_SENSOR_GYR_MAX_RAD_S 200.0f
#define JCAL_SENSOR_ACC_MAX_M_S2 4000.0f

/// Prepares a sensor; whatever `self` held before is lost. Errors: JCAL_ERR_ARG (null).
JCAL_MUST_CHECK jcal_status_t jcal_sensor_init(jcal_sensor_t *self);

/// True if a reading with these values is taken in: finite, and within the limits above. Sensors of one joint take both readings of a
/// moment or neither; otherwise their ticks are not of the same times any more.
bool jcal_sensor_may_take(const jcal_imu_t *imu);

/// Takes in one reading.
///
/// Returns:  JCAL_OK; JCAL_TICK if there are new features; JCAL_REJECTED if a component is not finite or beyond the limits above, or if
///           the time is that of the last reading; JCAL_ERR_ARG (null, or zeros that were never prepared).
/// Cost:     constant, about 800 instructions on a Cortex-M4F, 1,500 more if there is a tick.
jcal_status_t jcal_sensor_push(jcal_sensor_t *self, const jcal_reading_t *reading);

/// The last features; they change with the next call of push that returns JCAL_TICK. Null before the first tick, and after a gap until
/// there is one again.
const jcal_tick_t *jcal_sensor_tick(const jcal_sensor_t *self);

/// The orientation at the time of the last reading, sensor to earth; the identity before any.
///
/// A reading is the mean over the time before it: sensors filter, and average between the readings that they send. Features meet rates
/// and specific forces of one reading, so that this delay is nothing to them; `turn` of a tick is as old as they are. The orientation
/// here is half a sample further on. Beside optics the angle of a knee then has no lag (docs/METHOD_PEOPLE.md, section 1).
jcal_quat_t jcal_sensor_orientation(const jcal_sensor_t *self);

/// The bias of the gyroscope, rad/s; zero as long as nothing tells it.
jcal_vec3_t jcal_sensor_gyr_bias(const jcal_sensor_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_SENSOR_H */

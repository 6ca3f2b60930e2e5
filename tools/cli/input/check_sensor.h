/* SPDX-License-Identifier: MIT */
/// @file
/// What the readings of one sensor tell of their units, their frame, gravity in them, and how often they are new.
///
/// The library's health.h has rules for the same, for sensors whose units are right: these stay because they name the unit, whatever it is, and
/// which of accelerometer and gyroscope is held, and because they refuse after five seconds, before a joint can be ready.
#ifndef JCAL_CLI_INPUT_CHECK_SENSOR_H
#define JCAL_CLI_INPUT_CHECK_SENSOR_H

#include "input/check_frames.h"
#include "input/histogram.h"

#include "jointcal/types.h"

/// Start from all zero.
typedef struct {
    /* Private. */
    bool has_last;
    int64_t last_us;
    jcal_imu_t last;
    histogram_t rate; /* |w| */
    histogram_t acc;  /* |a| */

    check_frames_t frames;
    jcal_vec3_t block_turn; /* the block of a tenth of a second that is being read */
    jcal_vec3_t block_acc;
    double block_s;

    histogram_t gravity; /* |mean of a in a frame that does not turn| of windows of two seconds */
    histogram_t share;   /* the same as a share of the root mean square of a */
    double turned[4];    /* orientation since the window began */
    double sum[3];
    double sum2;
    uint32_t window_rows;
    double window_s;

    uint32_t moving;   /* rows in which the sensor turns, and those of them in which */
    uint32_t acc_held; /* ... accelerations are those of the row before, rates not */
    uint32_t gyr_held;
    uint32_t both_held;
} check_sensor_t;

/// What can be wrong.
typedef enum {
    CHECK_SENSOR_FINE,
    CHECK_SENSOR_RATE_UNIT,   ///< Rates are not in rad/s: `scale` is what gravity turns by for one of them.
    CHECK_SENSOR_FRAMES,      ///< Rates and accelerations are in different frames.
    CHECK_SENSOR_TURNS_BACK,  ///< All rates have the wrong sign, or the frame is left-handed.
    CHECK_SENSOR_RATES,       ///< Gravity does not turn as the rates say; how else is not known.
    CHECK_SENSOR_NO_GRAVITY,  ///< Gravity is missing in the accelerations.
    CHECK_SENSOR_ACC_UNIT     ///< Accelerations are not in m/s^2: `gravity` is what gravity is in them.
} check_sensor_fault_t;

typedef struct {
    check_sensor_fault_t fault;
    double scale;    ///< 0 if it is not known.
    double fit;      ///< How much of the changes of gravity the rates explain with that scale.
    double gravity;  ///< 0 if it is not known.
    bool way_known;  ///< With CHECK_SENSOR_FRAMES: one way to read the accelerations fits, and only one.
    int column[3];   ///< That way: which of their columns is x, y, z, and with which sign.
    int sign[3];
} check_sensor_verdict_t;

/// Takes in a row.
void check_sensor_push(check_sensor_t *sensor, const jcal_imu_t *imu, int64_t t_us);

/// The gravest fault, if there is one.
check_sensor_verdict_t check_sensor_verdict(const check_sensor_t *sensor);

/// How often each reading comes if fewer rows than the half have new ones, else 1: of accelerations, of rates, or of both together.
int check_sensor_acc_held(const check_sensor_t *sensor);
int check_sensor_gyr_held(const check_sensor_t *sensor);
int check_sensor_both_held(const check_sensor_t *sensor);

#endif

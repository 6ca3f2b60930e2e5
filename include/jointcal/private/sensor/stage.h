/* SPDX-License-Identifier: MIT */
/// @file
/// State of the sensor stage. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_SENSOR_STAGE_H
#define JCAL_PRIVATE_SENSOR_STAGE_H

#include "jointcal/private/sensor/attitude.h"
#include "jointcal/private/sensor/bias.h"
#include "jointcal/private/sensor/features.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Coefficients that follow the distance of samples.
typedef struct {
    uint32_t dt_us;  ///< The distance for which they hold; 0: none.
    float dt_s;
    float pole;  ///< Share of a new value in a one-pole of 5 Hz.
    float rest;  ///< The same in those by which rest is told.
} jcal_sample_rates_t;

/// Coefficients that follow the distance of ticks.
typedef struct {
    uint32_t dt_us;  ///< The distance for which they hold; 0: none.
    float dt_s;
    float high_keep;  ///< What a high-pass of 0.4 Hz keeps.
    float low_pole;   ///< Share of a new value in a one-pole of 3 Hz.
    float level[3];   ///< Low-pass of the inclination; lib/imu/lowpass.h.
} jcal_tick_rates_t;

/// One sensor. Caller-owned, plain, copyable; all members are private.
typedef struct {
    uint64_t last_us;  ///< Time of the last sample ...
    uint64_t tick_us;  ///< ... and of the last tick, or of the first sample of the epoch.
    jcal_attitude_t attitude;
    jcal_gyr_bias_t bias;
    jcal_features_t features;
    jcal_sample_rates_t sample;
    jcal_tick_rates_t tick;
    bool has_last;
    bool has_tick;  ///< There was a tick in this epoch.
} jcal_sensor_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_SENSOR_STAGE_H */

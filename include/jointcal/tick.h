/* SPDX-License-Identifier: MIT */
/// @file
/// What one sensor tells the joints that it serves, twenty times a second.
#ifndef JCAL_TICK_H
#define JCAL_TICK_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Low-frequency features of one IMU at one moment. Matrices are row-major; L is its level frame: z up, a heading of its own.
typedef struct {
    uint64_t t_us;   ///< Time of the reading that made this tick due.
    float period_s;  ///< Time since the tick before, s.
    float turn[9];   ///< R: sensor frame to L, as it is at this moment.
    float spin
        [9];  ///< Q: how fast the sensor's axes move in L, R [w]x below 5 Hz, rad/s. Columns are axes of the sensor.
    float speed[3];  ///< U: velocity in L between 0.4 and 3 Hz, m/s.
    float
        swing[9];  ///< B: Q between 0.4 and 3 Hz: B r is the part of U that a place r m from the joint owes to turning.
    jcal_vec3_t rate;    ///< Rate in sensor frame below 5 Hz, rad/s.
    float gravity_m_s2;  ///< Median magnitude of the specific force.
    uint16_t
        epoch;  ///< Counts the times that features began anew: headings and filters before and after have nothing in common.
} jcal_tick_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TICK_H */

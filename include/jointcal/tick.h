/* SPDX-License-Identifier: MIT */
/// @file
/// Low-frequency features of one sensor: what joints read of it about twenty times a second.
///
/// With R from the sensor to its earth frame, w its rate (less the bias of the gyroscope), a its specific force and g = (0, 0, 9.81):
///
///     turn      R
///     rate      Q = L3(R [w]x)                  1/s    L3: three one-poles of 5 Hz in series, every sample
///     gyr       wl = L3(w)                      rad/s
///     velocity  U = L H H u                     m/s    u: the integral of v = L3(R a - g) through a one-pole high-pass of 0.4 Hz
///     lever     B = L H H H Q                   1/s    H: one-pole high-passes of 0.4 Hz, L: a one-pole low-pass of 3 Hz, every tick
///
/// [w]x is the matrix with [w]x r = w x r. With r from a point of the segment to the sensor, in its frame, B r is the part that r has in
/// U: U - B r is the same for all sensors of one rigid body, and for both sensors of a joint with r from its centre, but for the turn
/// between their earth frames: U_1 - B_1 r_1 = Rz (U_2 - B_2 r_2). It holds from the first tick, for all filters have seen the same past.
#ifndef JCAL_TICK_H
#define JCAL_TICK_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Features at one time. Matrices row by row.
typedef struct {
    uint64_t t_us;  ///< Time of the sample at which it was made.
    uint32_t
        epoch;  ///< Counts starts, from 1: the first sample ever and each after a gap. Filters know nothing from before.
    float
        dt_s;  ///< Time since the tick before, or since the first sample of the epoch: the multiple of the samples' distance
               ///< that is nearest to 50 ms.
    float since_s;   ///< Time since the epoch began; stays at 1000. The inclination of the first seconds is worth less.
    float turn[9];   ///< R at this time, sensor to earth.
    float rate[9];   ///< Q, 1/s.
    float lever[9];  ///< B, 1/s.
    jcal_vec3_t velocity;  ///< U, m/s, in the earth frame.
    jcal_vec3_t gyr;       ///< wl, rad/s, in the sensor's frame.
    float
        acc_level_m_s2;  ///< Mean of the vertical specific force over the epoch, and then over 20 s: 9.81 whatever the motion.
} jcal_tick_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TICK_H */

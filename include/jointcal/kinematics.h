/* SPDX-License-Identifier: MIT */
/// @file
/// Layout of what turns readings into angular accelerations. Nothing here is for the user to touch but the choice of the derivative.
#ifndef JCAL_KINEMATICS_H
#define JCAL_KINEMATICS_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How angular accelerations are made from rates.
typedef enum {
    /// Five-point quotient; everything that the joint's equation compares is smoothed alike, in a frame that does not turn (default).
    JCAL_DERIVATIVE_SMOOTHED = 0,
    JCAL_DERIVATIVE_FIVE_POINT = 1,  ///< Five-point quotient, nothing smoothed.
    JCAL_DERIVATIVE_SYMMETRIC = 2    ///< Symmetric quotient: (8) of [OLS17].
} jcal_derivative_t;

/// Private: orientations of both sensors, each to its earth frame; all zero if there are none.
typedef struct {
    jcal_quat_t q1, q2;
} jcal_attitudes_t;

/// Private: mean readings over one bin of about 20 ms.
typedef struct {
    jcal_imu_t imu1, imu2;
    jcal_attitudes_t attitudes;
    uint32_t t_us;  ///< Middle of the bin, low half of the time.
} jcal_bin_t;

/// Private: one body at one time.
typedef struct {
    jcal_vec3_t a;     ///< Specific force of the sensor, m/s^2.
    jcal_vec3_t k[3];  ///< Columns of K, 1/s^2.
    float rate2;       ///< |w|^2, (rad/s)^2.
} jcal_body_t;

/// Private: both bodies at one time, each in its sensor's frame, or in its earth frame if its orientation is known.
typedef struct {
    jcal_body_t body1, body2;
    uint64_t t_us;
    float dt_s;  ///< The time it stands for.
} jcal_kinematic_t;

/// Private: bins that a derivative needs.
#define JCAL_BINS 7u

/// Private: the last bins without a hole.
typedef struct {
    jcal_bin_t ring[JCAL_BINS];
    jcal_bin_t sum;     ///< Of the bin that is being filled.
    float interval_s;   ///< Distance of the samples when the chain began.
    uint64_t last_us;   ///< Time of the last sample.
    uint64_t begin_us;  ///< Time of the first sample in the bin.
    uint8_t in_bin;     ///< Samples in it ...
    uint8_t per_bin;    ///< ... and how many it takes.
    uint8_t filled;     ///< Bins in the ring.
    uint8_t next;       ///< Where the next one goes.
} jcal_kinematics_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_KINEMATICS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// State of the estimate of a gyroscope's bias; lib/imu/bias.h has the equations.
#ifndef JCAL_PRIVATE_SENSOR_BIAS_H
#define JCAL_PRIVATE_SENSOR_BIAS_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The bias of one gyroscope.
typedef struct {
    jcal_vec3_t bias_rad_s;
    float p[6];             ///< Its covariance, (rad/s)^2: xx, xy, xz, yy, yz, zz.
    jcal_vec3_t gyr_rad_s;  ///< Low-passed readings, by which rest is told ...
    jcal_vec3_t acc_m_s2;   ///< ... and its length ...
    uint32_t rest_us;       ///< ... so far.
    float turn_mean[9];     ///< Low-passed R, row by row ...
    float turn_slope[9];    ///< ... and the second states.
    float part_mean[2];     ///< Low-passed x and y of R b ...
    float part_slope[2];    ///< ... and the second states.
} jcal_gyr_bias_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_SENSOR_BIAS_H */

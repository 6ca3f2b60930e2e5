/* SPDX-License-Identifier: MIT */
/// @file
/// State of the orientation filter; lib/imu/attitude.h has the equations.
#ifndef JCAL_PRIVATE_SENSOR_ATTITUDE_H
#define JCAL_PRIVATE_SENSOR_ATTITUDE_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The orientation and the low-passed specific force.
typedef struct {
    jcal_quat_t q_s_e;       ///< Sensor to earth.
    jcal_vec3_t gyr_rad_s;   ///< Rate of the last sample, less its bias.
    jcal_vec3_t sum_m_s;     ///< Integral of R a since the last tick.
    jcal_vec3_t mean_m_s2;   ///< Low-passed R a ...
    jcal_vec3_t slope_m_s2;  ///< ... and the second state of the low-pass.
} jcal_attitude_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_SENSOR_ATTITUDE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Rotations: from a rotation vector, and as a matrix. Private.
#ifndef JCAL_IMU_TURN_H
#define JCAL_IMU_TURN_H

#include "jointcal/quat.h"

#include <stddef.h>

/// The rotation by a rotation vector, rad, of any length up to 2 JCAL_CIS_MAX_RAD; exact but for rounding.
jcal_quat_t jcal_turn_by(jcal_vec3_t angle);

/// The matrix of a unit quaternion, row by row.
void jcal_turn_matrix(jcal_quat_t q, float r[9]);

/// R v.
static inline jcal_vec3_t jcal_turn_times(const float r[9], jcal_vec3_t v)
{
    return jcal_vec3((r[0] * v.x) + (r[1] * v.y) + (r[2] * v.z), (r[3] * v.x) + (r[4] * v.y) + (r[5] * v.z),
                     (r[6] * v.x) + (r[7] * v.y) + (r[8] * v.z));
}

/// R' v.
static inline jcal_vec3_t jcal_turn_back(const float r[9], jcal_vec3_t v)
{
    return jcal_vec3((r[0] * v.x) + (r[3] * v.y) + (r[6] * v.z), (r[1] * v.x) + (r[4] * v.y) + (r[7] * v.z),
                     (r[2] * v.x) + (r[5] * v.y) + (r[8] * v.z));
}

/// Column k of a matrix (3 x 3), row by row.
static inline jcal_vec3_t jcal_column(const float m[9], size_t k)
{
    return jcal_vec3(m[k], m[k + 3u], m[k + 6u]);
}

#endif /* JCAL_IMU_TURN_H */

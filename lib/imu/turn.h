/* SPDX-License-Identifier: MIT */
/// @file
/// Rotations: from a rotation vector, and as a matrix. Private.
#ifndef JCAL_IMU_TURN_H
#define JCAL_IMU_TURN_H

#include "jointcal/quat.h"

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

#endif /* JCAL_IMU_TURN_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Rotations. See imu/turn.h.
#include "imu/turn.h"

#include "math/angle.h"

/// Half angles whose square is below this, 0.24 rad, take the series; its first term left out is below 3e-8.
#define SERIES_RAD2 0.06f

jcal_quat_t jcal_turn_by(jcal_vec3_t angle)
{
    const jcal_vec3_t half = jcal_vec3_scale(angle, 0.5f);
    const float h2 = jcal_vec3_dot(half, half);
    float c = 1.0f - (h2 * (0.5f - (h2 * ((1.0f / 24.0f) - (h2 * (1.0f / 720.0f))))));
    float s = 1.0f - (h2 * ((1.0f / 6.0f) - (h2 * ((1.0f / 120.0f) - (h2 * (1.0f / 5040.0f))))));
    if (!(h2 < SERIES_RAD2)) {
        const float h = sqrtf(h2);
        const jcal_plane_t turn = jcal_cis(h);
        c = turn.re;
        s = turn.im / h;
    }
    return jcal_quat(c, s * half.x, s * half.y, s * half.z);
}

void jcal_turn_matrix(jcal_quat_t q, float r[9])
{
    const float x2 = q.x + q.x;
    const float y2 = q.y + q.y;
    const float z2 = q.z + q.z;
    const float xx = x2 * q.x;
    const float yy = y2 * q.y;
    const float zz = z2 * q.z;
    const float xy = x2 * q.y;
    const float xz = x2 * q.z;
    const float yz = y2 * q.z;
    const float wx = x2 * q.w;
    const float wy = y2 * q.w;
    const float wz = z2 * q.w;
    r[0] = 1.0f - (yy + zz);
    r[1] = xy - wz;
    r[2] = xz + wy;
    r[3] = xy + wz;
    r[4] = 1.0f - (xx + zz);
    r[5] = yz - wx;
    r[6] = xz - wy;
    r[7] = yz + wx;
    r[8] = 1.0f - (xx + yy);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Unit quaternions by value. The one place where the rotation convention is stated.
///
/// Order (w, x, y, z), Hamilton product. `q_a_b` rotates a vector from frame A to frame B: v_b = q_a_b v_a q_a_b*.
/// Chaining reads from right to left: q_a_c = q_b_c q_a_b.
#ifndef JCAL_QUAT_H
#define JCAL_QUAT_H

#include "jointcal/vec3.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The quaternion (w, x, y, z).
static inline jcal_quat_t jcal_quat(float w, float x, float y, float z)
{
    const jcal_quat_t q = {w, x, y, z};
    return q;
}

/// Hamilton product p q.
static inline jcal_quat_t jcal_quat_mul(jcal_quat_t p, jcal_quat_t q)
{
    return jcal_quat(p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
                     p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w);
}

/// q*: the inverse of a unit quaternion.
static inline jcal_quat_t jcal_quat_conj(jcal_quat_t q)
{
    return jcal_quat(q.w, -q.x, -q.y, -q.z);
}

/// q v q*, for a unit quaternion.
static inline jcal_vec3_t jcal_quat_rotate(jcal_quat_t q, jcal_vec3_t v)
{
    const jcal_vec3_t u = jcal_vec3(q.x, q.y, q.z);
    const jcal_vec3_t t = jcal_vec3_scale(jcal_vec3_cross(u, v), 2.0f);
    return jcal_vec3_add(jcal_vec3_add(v, jcal_vec3_scale(t, q.w)), jcal_vec3_cross(u, t));
}

/// q / |q|; a zero (or NaN) quaternion comes back as the identity.
static inline jcal_quat_t jcal_quat_normalise(jcal_quat_t q)
{
    const float norm = sqrtf(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    if (!(norm > 0.0f)) {
        return jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    }
    const float s = 1.0f / norm;
    return jcal_quat(q.w * s, q.x * s, q.y * s, q.z * s);
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_QUAT_H */

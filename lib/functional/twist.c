/* SPDX-License-Identifier: MIT */
/// @file
/// The twist of a joint about its axes. See functional/twist.h.
#include "functional/twist.h"

#include "jointcal/quat.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/sphere.h"

#include <math.h>
#include <stddef.h>

/// Tangents u = j x e and v = j x u, e the sensor's axis number `from`: they follow the axis j without a jump, as long as j is not near e.
static jcal_tangent_t zero_at(jcal_vec3_t j, uint8_t from)
{
    const jcal_vec3_t e = {(from == 0u) ? 1.0f : 0.0f, (from == 1u) ? 1.0f : 0.0f, (from == 2u) ? 1.0f : 0.0f};
    const jcal_vec3_t u = jcal_vec3_normalise(jcal_vec3_cross(j, e));
    const jcal_tangent_t out = {u, jcal_vec3_cross(j, u)};
    return out;
}

uint8_t jcal_twist_zero(jcal_vec3_t axis)
{
    const float x = fabsf(axis.x);
    const float y = fabsf(axis.y);
    const float z = fabsf(axis.z);
    return (uint8_t)((x <= y) ? ((x <= z) ? 0u : 2u) : ((y <= z) ? 1u : 2u));
}

float jcal_twist_angle(const jcal_twist_t *twist, jcal_plane_t heading, jcal_quat_t orientation1,
                       jcal_quat_t orientation2)
{
    const jcal_tangent_t t1 = zero_at(twist->axis1, twist->zero[0]);
    const jcal_tangent_t t2 = zero_at(twist->axis2, twist->zero[1]);
    /* Rows u1, v1 and columns u2, v2 of R1' Rz R2: its twist about the axes. */
    const jcal_vec3_t level[2] = {jcal_quat_rotate(orientation2, t2.u), jcal_quat_rotate(orientation2, t2.v)};
    float m[4];
    for (size_t k = 0u; k < 2u; ++k) {
        const jcal_vec3_t in_l1 = {(heading.re * level[k].x) - (heading.im * level[k].y),
                                   (heading.im * level[k].x) + (heading.re * level[k].y), level[k].z};
        const jcal_vec3_t in_1 = jcal_quat_rotate(jcal_quat_conj(orientation1), in_l1);
        m[k] = jcal_vec3_dot(t1.u, in_1);
        m[2u + k] = jcal_vec3_dot(t1.v, in_1);
    }
    return jcal_atan2(m[2] - m[1], m[0] + m[3]);
}

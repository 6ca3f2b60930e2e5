/* SPDX-License-Identifier: MIT */
/// @file
/// Rates from orientations. Private.
#ifndef JCAL_RATE_H
#define JCAL_RATE_H

#include "jointcal/quat.h"
#include "jointcal/vec3.h"
#include "math/angle.h"

/// Mean rate in the earth frame between two orientations `dt_s` apart, rad/s: (A41), (A42) of [LAI22], without the arc cosine that
/// loses small angles.
static inline jcal_vec3_t jcal_rate_between(jcal_quat_t from, jcal_quat_t to, float dt_s)
{
    const jcal_quat_t turn = jcal_quat_mul(to, jcal_quat_conj(from));
    const float sign = (turn.w < 0.0f) ? -1.0f : 1.0f;
    const jcal_vec3_t v = jcal_vec3(sign * turn.x, sign * turn.y, sign * turn.z);
    const float sine = jcal_vec3_norm(v);
    const float per_sine = (sine > 1e-4f) ? (2.0f * jcal_atan2(sine, sign * turn.w) / sine) : 2.0f;
    return jcal_vec3_scale(v, per_sine / dt_s);
}

#endif /* JCAL_RATE_H */

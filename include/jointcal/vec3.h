/* SPDX-License-Identifier: MIT */
/// @file
/// 3-vectors by value: in registers on a hard-float ABI.
#ifndef JCAL_VEC3_H
#define JCAL_VEC3_H

#include "jointcal/types.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The vector (x, y, z).
static inline jcal_vec3_t jcal_vec3(float x, float y, float z)
{
    const jcal_vec3_t v = {x, y, z};
    return v;
}

/// a + b.
static inline jcal_vec3_t jcal_vec3_add(jcal_vec3_t a, jcal_vec3_t b)
{
    return jcal_vec3(a.x + b.x, a.y + b.y, a.z + b.z);
}

/// a - b.
static inline jcal_vec3_t jcal_vec3_sub(jcal_vec3_t a, jcal_vec3_t b)
{
    return jcal_vec3(a.x - b.x, a.y - b.y, a.z - b.z);
}

/// s a.
static inline jcal_vec3_t jcal_vec3_scale(jcal_vec3_t a, float s)
{
    return jcal_vec3(a.x * s, a.y * s, a.z * s);
}

/// Scalar product a . b.
static inline float jcal_vec3_dot(jcal_vec3_t a, jcal_vec3_t b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Vector product a x b.
static inline jcal_vec3_t jcal_vec3_cross(jcal_vec3_t a, jcal_vec3_t b)
{
    return jcal_vec3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/// |a|.
static inline float jcal_vec3_norm(jcal_vec3_t a)
{
    return sqrtf(jcal_vec3_dot(a, a));
}

/// a / |a|; a zero (or NaN) vector comes back as the zero vector.
static inline jcal_vec3_t jcal_vec3_normalise(jcal_vec3_t a)
{
    const float norm = jcal_vec3_norm(a);
    return (norm > 0.0f) ? jcal_vec3_scale(a, 1.0f / norm) : jcal_vec3(0.0f, 0.0f, 0.0f);
}

/// True if no component is NaN or infinite.
static inline bool jcal_vec3_is_finite(jcal_vec3_t a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_VEC3_H */

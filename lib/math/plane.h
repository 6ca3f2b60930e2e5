/* SPDX-License-Identifier: MIT */
/// @file
/// Vectors in a plane as complex numbers: turning and comparing them without trigonometry.
#ifndef JCAL_PLANE_H
#define JCAL_PLANE_H

#include "jointcal/private/plane.h"

#include <math.h>

#ifdef __cplusplus
extern "C" {
#endif

/// a b.
static inline jcal_plane_t jcal_plane_times(jcal_plane_t a, jcal_plane_t b)
{
    const jcal_plane_t out = {(a.re * b.re) - (a.im * b.im), (a.re * b.im) + (a.im * b.re)};
    return out;
}

/// conj(a) b: what turns a into b, times |a|^2.
static inline jcal_plane_t jcal_plane_against(jcal_plane_t a, jcal_plane_t b)
{
    const jcal_plane_t out = {(a.re * b.re) + (a.im * b.im), (a.re * b.im) - (a.im * b.re)};
    return out;
}

/// a + s b.
static inline jcal_plane_t jcal_plane_add(jcal_plane_t a, float s, jcal_plane_t b)
{
    const jcal_plane_t out = {a.re + (s * b.re), a.im + (s * b.im)};
    return out;
}

/// |a|^2.
static inline float jcal_plane_norm2(jcal_plane_t a)
{
    return (a.re * a.re) + (a.im * a.im);
}

/// |a|.
static inline float jcal_plane_norm(jcal_plane_t a)
{
    return sqrtf(jcal_plane_norm2(a));
}

/// a / |a|; 1 if there is no direction.
static inline jcal_plane_t jcal_plane_direction(jcal_plane_t a)
{
    const float length = jcal_plane_norm(a);
    const jcal_plane_t out = {(length > 0.0f) ? (a.re / length) : 1.0f, (length > 0.0f) ? (a.im / length) : 0.0f};
    return out;
}

/// exp(i x), of length 1 whatever the error of the angle: that is below 5e-5 rad for |x| < 1 and 3e-3 rad for |x| < 1.57.
///
/// Method:   half-angle tangent by four terms of its series.
static inline jcal_plane_t jcal_plane_turn(float x)
{
    const float h = 0.5f * x;
    const float h2 = h * h;
    const float t = h * (1.0f + (h2 * ((1.0f / 3.0f) + (h2 * ((2.0f / 15.0f) + (h2 * (17.0f / 315.0f)))))));
    const float scale = 1.0f / (1.0f + (t * t));
    const jcal_plane_t out = {(1.0f - (t * t)) * scale, 2.0f * t * scale};
    return out;
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PLANE_H */

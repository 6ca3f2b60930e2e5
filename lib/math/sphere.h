/* SPDX-License-Identifier: MIT */
/// @file
/// The unit sphere without angles: tangent bases and steps. 2 parameters per axis, no singular place.
#ifndef JCAL_SPHERE_H
#define JCAL_SPHERE_H

#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/scalar.h"

#include <float.h>
#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Orthonormal basis T = [u v] (3 x 2) of the plane tangent to the sphere at j; (u, v, j) is right-handed.
typedef struct {
    jcal_vec3_t u;
    jcal_vec3_t v;
} jcal_tangent_t;

/// Tangent basis at a unit vector j. Orthonormal to a few FLT_EPSILON at every j, a function of j alone.
///
/// The basis jumps where j.z changes its sign, so coordinates in it are used at one j only and never kept.
/// Source:   Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017.
/// Cost:     one division, 12 multiplications.
static inline jcal_tangent_t jcal_sphere_tangent(jcal_vec3_t j)
{
    const float sign = (j.z >= 0.0f) ? 1.0f : -1.0f;
    const float a = -1.0f / (sign + j.z); /* |sign + z| >= 1: never a small divisor */
    const float b = j.x * j.y * a;
    const jcal_tangent_t t = {
        {1.0f + (sign * j.x * j.x * a), sign * b, -sign * j.x},
        {b, sign + (j.y * j.y * a), -j.y},
    };
    return t;
}

/// T d: the tangent vector with coordinates (du, dv), rad.
static inline jcal_vec3_t jcal_sphere_lift(const jcal_tangent_t *t, float du, float dv)
{
    return jcal_vec3_add(jcal_vec3_scale(t->u, du), jcal_vec3_scale(t->v, dv));
}

/// normalise(j + T d), with d = (du, dv) in rad. A step that is not finite leaves j where it is.
static inline jcal_vec3_t jcal_sphere_move(jcal_vec3_t j, const jcal_tangent_t *t, float du, float dv)
{
    const jcal_vec3_t moved = jcal_vec3_add(j, jcal_sphere_lift(t, du, dv));
    const float norm = jcal_vec3_norm(moved);
    return ((norm > 0.0f) && (norm <= FLT_MAX)) ? jcal_vec3_scale(moved, 1.0f / norm) : j;
}

/// True for what a config may hold as an axis: a vector of length 1 to within half a percent, or zero for none.
static inline bool jcal_sphere_is_axis_or_none(jcal_vec3_t v)
{
    const float square = jcal_vec3_dot(v, v);
    return (square == 0.0f) || jcal_within(square, 0.99f, 1.01f);
}

/// Angle between two directions of any non-zero length, rad, in [0, pi]; exact to 1e-6 rad near 0 and near pi too.
static inline float jcal_sphere_angle(jcal_vec3_t a, jcal_vec3_t b)
{
    return jcal_atan2(jcal_vec3_norm(jcal_vec3_cross(a, b)), jcal_vec3_dot(a, b));
}

/// Angle between the lines through two directions, rad, in [0, pi/2]: signs do not count.
static inline float jcal_sphere_line_angle(jcal_vec3_t a, jcal_vec3_t b)
{
    return jcal_atan2(jcal_vec3_norm(jcal_vec3_cross(a, b)), fabsf(jcal_vec3_dot(a, b)));
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_SPHERE_H */

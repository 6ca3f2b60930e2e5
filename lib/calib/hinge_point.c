/* SPDX-License-Identifier: MIT */
/// @file
/// Moving about in the parameter space of the hinge. See hinge_point.h.
#include "calib/hinge_point.h"

#include "math/sphere.h"

#include <math.h>

/// A carried tangent direction shorter than this is replaced; it shrinks only when the axis jumps.
#define TANGENT_MIN 0.1f

/// cos 11.5 deg: two minima closer than this are one.
#define SAME_COSINE 0.98f

void jcal_hinge_axis_set(jcal_hinge_axis_t *axis, jcal_vec3_t j)
{
    jcal_vec3_t u = jcal_hinge_across(j, axis->u);
    if (!(jcal_vec3_norm(u) > TANGENT_MIN)) {
        u = jcal_sphere_tangent(j).u;
    }
    axis->j = j;
    axis->u = jcal_vec3_normalise(u);
    axis->bias = jcal_hinge_across(j, axis->bias);
}

static void axis_move(jcal_hinge_axis_t *axis, const float d[2], const float bias_d[2], float bias_unit)
{
    const jcal_tangent_t tangent = {axis->u, jcal_hinge_v(axis)};
    const jcal_vec3_t shift = jcal_sphere_lift(&tangent, bias_unit * bias_d[0], bias_unit * bias_d[1]);
    axis->bias = jcal_vec3_add(axis->bias, shift);
    jcal_hinge_axis_set(axis, jcal_sphere_move(axis->j, &tangent, d[0], d[1]));
}

void jcal_hinge_point_move(jcal_hinge_point_t *point, const float d[8], float bias_unit)
{
    axis_move(&point->axis1, &d[0], &d[4], bias_unit);
    axis_move(&point->axis2, &d[2], &d[6], bias_unit);
}

bool jcal_hinge_same_lines(const jcal_hinge_point_t *point, jcal_vec3_t j1, jcal_vec3_t j2)
{
    return (fabsf(jcal_vec3_dot(point->axis1.j, j1)) > SAME_COSINE) &&
           (fabsf(jcal_vec3_dot(point->axis2.j, j2)) > SAME_COSINE);
}

float jcal_hinge_main_sign(jcal_vec3_t v)
{
    float main = v.x;
    main = (fabsf(v.y) > fabsf(main)) ? v.y : main;
    main = (fabsf(v.z) > fabsf(main)) ? v.z : main;
    return (main < 0.0f) ? -1.0f : 1.0f;
}

bool jcal_hinge_obeys(const jcal_hinge_point_t *point, jcal_sign_hint_t hint)
{
    const bool same = jcal_hinge_main_sign(point->axis1.j) == jcal_hinge_main_sign(point->axis2.j);
    return !((hint == JCAL_SIGN_SAME) && !same) && !((hint == JCAL_SIGN_OPPOSITE) && same);
}

void jcal_hinge_obey(jcal_hinge_point_t *point, jcal_sign_hint_t hint)
{
    if (!jcal_hinge_obeys(point, hint)) {
        jcal_hinge_axis_set(&point->axis2, jcal_vec3_scale(point->axis2.j, -1.0f));
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Moving about in the parameter space of the hinge. See hinge/point.h.
#include "hinge/point.h"

#include "joint/sign.h"
#include "math/scalar.h"
#include "math/sphere.h"

#include <math.h>

/// A carried tangent direction shorter than this is replaced; it shrinks only when the axis jumps.
#define TANGENT_MIN 0.1f

/// cos 11.5 deg: two minima closer than this are one.
#define SAME_COSINE 0.98f
/// One, in a note: a unit vector's component, which rounding may have made a little longer than one, fits in 16 bits.
#define NOTE_ONE 32760.0f

void jcal_hinge_axis_set(jcal_hinge_axis_t *axis, jcal_vec3_t j)
{
    jcal_vec3_t u = jcal_vec3_sub(axis->u, jcal_vec3_scale(j, jcal_vec3_dot(j, axis->u)));
    if (!(jcal_vec3_norm(u) > TANGENT_MIN)) {
        u = jcal_sphere_tangent(j).u;
    }
    axis->j = j;
    axis->u = jcal_vec3_normalise(u);
}

void jcal_hinge_point_set(jcal_hinge_point_t *point, jcal_vec3_t j1, jcal_vec3_t j2)
{
    jcal_hinge_axis_set(&point->axis1, j1);
    jcal_hinge_axis_set(&point->axis2, j2);
}

static int16_t note_component(float c)
{
    const float within = jcal_max(jcal_min(c, 1.0f), -1.0f);
    return (int16_t)((NOTE_ONE * within) + ((within < 0.0f) ? -0.5f : 0.5f));
}

jcal_hinge_note_t jcal_hinge_note(jcal_vec3_t j)
{
    const jcal_hinge_note_t note = {{note_component(j.x), note_component(j.y), note_component(j.z)}};
    return note;
}

jcal_vec3_t jcal_hinge_noted(jcal_hinge_note_t note)
{
    return jcal_vec3_normalise(jcal_vec3((float)note.c[0], (float)note.c[1], (float)note.c[2]));
}

void jcal_hinge_point_note(const jcal_hinge_point_t *point, jcal_hinge_note_t out[2])
{
    out[0] = jcal_hinge_note(point->axis1.j);
    out[1] = jcal_hinge_note(point->axis2.j);
}

void jcal_hinge_point_recall(jcal_hinge_point_t *point, const jcal_hinge_note_t notes[2])
{
    jcal_hinge_point_set(point, jcal_hinge_noted(notes[0]), jcal_hinge_noted(notes[1]));
}

static void axis_move(jcal_hinge_axis_t *axis, float du, float dv)
{
    const jcal_tangent_t tangent = {axis->u, jcal_hinge_v(axis)};
    jcal_hinge_axis_set(axis, jcal_sphere_move(axis->j, &tangent, du, dv));
}

void jcal_hinge_point_move(jcal_hinge_point_t *point, const float d[4])
{
    axis_move(&point->axis1, d[0], d[1]);
    axis_move(&point->axis2, d[2], d[3]);
}

static bool same_line(jcal_vec3_t a, jcal_vec3_t b)
{
    return fabsf(jcal_vec3_dot(a, b)) > SAME_COSINE;
}

bool jcal_hinge_same_lines(const jcal_hinge_point_t *a, const jcal_hinge_point_t *b)
{
    return same_line(a->axis1.j, b->axis1.j) && same_line(a->axis2.j, b->axis2.j);
}

bool jcal_hinge_same_pairing(const jcal_hinge_point_t *a, const jcal_hinge_point_t *b)
{
    return (jcal_vec3_dot(a->axis1.j, b->axis1.j) * jcal_vec3_dot(a->axis2.j, b->axis2.j)) > 0.0f;
}

bool jcal_hinge_obeys(const jcal_hinge_point_t *point, jcal_sign_hint_t hint, const int8_t kept[2])
{
    return jcal_sign_obeys(hint, point->axis1.j, point->axis2.j, kept);
}

void jcal_hinge_obey(jcal_hinge_point_t *point, jcal_sign_hint_t hint, const int8_t kept[2])
{
    if (!jcal_hinge_obeys(point, hint, kept)) {
        jcal_hinge_axis_set(&point->axis2, jcal_vec3_scale(point->axis2.j, -1.0f));
    }
}

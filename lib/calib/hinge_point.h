/* SPDX-License-Identifier: MIT */
/// @file
/// Moving about in the parameter space of the hinge. Private.
///
/// Each axis carries its own tangent direction u along (v = j x u), so that sums in tangent coordinates keep their
/// meaning while the axis moves a little.
#ifndef JCAL_HINGE_POINT_H
#define JCAL_HINGE_POINT_H

#include "jointcal/hinge.h"
#include "jointcal/vec3.h"

/// The part of v across the unit vector j.
static inline jcal_vec3_t jcal_hinge_across(jcal_vec3_t j, jcal_vec3_t v)
{
    return jcal_vec3_sub(v, jcal_vec3_scale(j, jcal_vec3_dot(j, v)));
}

/// Second tangent direction.
static inline jcal_vec3_t jcal_hinge_v(const jcal_hinge_axis_t *axis)
{
    return jcal_vec3_cross(axis->j, axis->u);
}

/// Puts an axis to the unit vector j; u and the bias are carried along across it.
void jcal_hinge_axis_set(jcal_hinge_axis_t *axis, jcal_vec3_t j);

/// Moves both axes and both biases by d (8), in the order and the units of hinge_model.h.
void jcal_hinge_point_move(jcal_hinge_point_t *point, const float d[8], float bias_unit);

/// True if a and b mean the same axes, whatever their pairing: both lines closer than about 11 deg.
bool jcal_hinge_same_lines(const jcal_hinge_point_t *point, jcal_vec3_t j1, jcal_vec3_t j2);

/// True if the sign pairing is the one that the user's hint names, or if there is no hint.
bool jcal_hinge_obeys(const jcal_hinge_point_t *point, jcal_sign_hint_t hint);

/// Turns axis 2 round if the user's hint says so.
void jcal_hinge_obey(jcal_hinge_point_t *point, jcal_sign_hint_t hint);

/// +1 or -1: sign of the component of largest magnitude.
float jcal_hinge_main_sign(jcal_vec3_t v);

#endif /* JCAL_HINGE_POINT_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Moving about in the parameter space of the hinge. Private.
///
/// Each axis carries its own tangent direction u along (v = j x u), so that sums in tangent coordinates keep their
/// meaning while the axis moves a little.
#ifndef JCAL_HINGE_POINT_H
#define JCAL_HINGE_POINT_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/point.h"
#include "jointcal/vec3.h"

/// Second tangent direction.
static inline jcal_vec3_t jcal_hinge_v(const jcal_hinge_axis_t *axis)
{
    return jcal_vec3_cross(axis->j, axis->u);
}

/// Puts an axis to the unit vector j; u is carried along.
void jcal_hinge_axis_set(jcal_hinge_axis_t *axis, jcal_vec3_t j);

/// Puts both axes.
void jcal_hinge_point_set(jcal_hinge_point_t *point, jcal_vec3_t j1, jcal_vec3_t j2);

/// Moves both axes by d: along u1, v1, u2, v2, rad.
void jcal_hinge_point_move(jcal_hinge_point_t *point, const float d[4]);

/// Keeps a unit vector in mind; rounding turns it by 0.002 deg at most.
jcal_hinge_note_t jcal_hinge_note(jcal_vec3_t j);

/// The unit vector that was kept.
jcal_vec3_t jcal_hinge_noted(jcal_hinge_note_t note);

/// The same of both axes of a point.
void jcal_hinge_point_note(const jcal_hinge_point_t *point, jcal_hinge_note_t out[2]);
void jcal_hinge_point_recall(jcal_hinge_point_t *point, const jcal_hinge_note_t notes[2]);

/// True if a and b mean the same axes, whatever their pairing: both lines closer than about 11 deg.
bool jcal_hinge_same_lines(const jcal_hinge_point_t *a, const jcal_hinge_point_t *b);

/// True if a and b have the same sign pairing; both signs turned together mean the same joint.
bool jcal_hinge_same_pairing(const jcal_hinge_point_t *a, const jcal_hinge_point_t *b);

/// True if the sign pairing is the one that the user's hint names, or if there is no hint. `kept`: the component of either axis whose
/// sign counts, lib/joint/sign.h; zeros: the largest ones.
bool jcal_hinge_obeys(const jcal_hinge_point_t *point, jcal_sign_hint_t hint, const int8_t kept[2]);

/// Turns axis 2 round if the user's hint says so.
void jcal_hinge_obey(jcal_hinge_point_t *point, jcal_sign_hint_t hint, const int8_t kept[2]);

#endif /* JCAL_HINGE_POINT_H */

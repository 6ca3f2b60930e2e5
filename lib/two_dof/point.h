/* SPDX-License-Identifier: MIT */
/// @file
/// Points of the parameter space of a 2-DoF joint: j1, j2 and the heading offset. Private.
#ifndef JCAL_TWO_DOF_POINT_H
#define JCAL_TWO_DOF_POINT_H

#include "jointcal/private/two_dof/point.h"
#include "math/plane.h"
#include "math/sphere.h"

#define JCAL_TWO_DOF_UNKNOWNS 5u

/// Moves j1 by d[0..1] and j2 by d[2..3] on their tangent planes, and the heading offset by d[4], all rad.
static inline void jcal_two_dof_point_move(jcal_two_dof_point_t *point, const float *d)
{
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    point->j1 = jcal_sphere_move(point->j1, &t1, d[0], d[1]);
    point->j2 = jcal_sphere_move(point->j2, &t2, d[2], d[3]);
    point->heading = jcal_plane_direction(jcal_plane_times(point->heading, jcal_plane_turn(d[4])));
}

#endif /* JCAL_TWO_DOF_POINT_H */

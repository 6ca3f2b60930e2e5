/* SPDX-License-Identifier: MIT */
/// @file
/// Where the search for the axes of a 2-DoF joint starts, and when two minima are one. Private.
#ifndef JCAL_TWO_DOF_STARTS_H
#define JCAL_TWO_DOF_STARTS_H

#include "jointcal/quat.h"
#include "two_dof/point.h"

#include <math.h>

/// Lines that starts are made of: the axes of the sensor frame and the diagonals of its cube, each for either sensor.
#define JCAL_TWO_DOF_LINES 7u
#define JCAL_TWO_DOF_STARTS (JCAL_TWO_DOF_LINES * JCAL_TWO_DOF_LINES)
/// Order of the starts: neighbours in time differ in both lines. No common factor with their number.
#define JCAL_TWO_DOF_START_STRIDE 17u
/// Headings that a start chooses from.
#define JCAL_TWO_DOF_HEADINGS 8u

/// Minima closer than this are one, cos 5 deg; a probe that has come as close as this to the estimate has joined it, cos 2 deg.
#define JCAL_TWO_DOF_SAME_COSINE 0.9962f
#define JCAL_TWO_DOF_JOINED_COSINE 0.9994f

static inline jcal_vec3_t jcal_two_dof_line(unsigned which)
{
    const float s = 0.57735027f;
    switch (which) {
    case 0u:
        return jcal_vec3(1.0f, 0.0f, 0.0f);
    case 1u:
        return jcal_vec3(0.0f, 1.0f, 0.0f);
    case 2u:
        return jcal_vec3(0.0f, 0.0f, 1.0f);
    case 3u:
        return jcal_vec3(s, s, s);
    case 4u:
        return jcal_vec3(-s, s, s);
    case 5u:
        return jcal_vec3(s, -s, s);
    default:
        return jcal_vec3(s, s, -s);
    }
}

/// Axes of a start, in [0, JCAL_TWO_DOF_STARTS); its heading is still to be chosen.
static inline jcal_two_dof_point_t jcal_two_dof_start(unsigned which)
{
    const jcal_two_dof_point_t point = {
        jcal_two_dof_line(which / JCAL_TWO_DOF_LINES), jcal_two_dof_line(which % JCAL_TWO_DOF_LINES), {1.0f, 0.0f}};
    return point;
}

static inline uint8_t jcal_two_dof_start_after(unsigned which)
{
    return (uint8_t)((which + JCAL_TWO_DOF_START_STRIDE) % JCAL_TWO_DOF_STARTS);
}

/// Headings a start chooses from (JCAL_TWO_DOF_HEADINGS), evenly around the circle.
static inline const jcal_plane_t *jcal_two_dof_start_headings(void)
{
    static const jcal_plane_t turns[JCAL_TWO_DOF_HEADINGS] = {
        {1.0f, 0.0f},  {0.70710678f, 0.70710678f},   {0.0f, 1.0f},  {-0.70710678f, 0.70710678f},
        {-1.0f, 0.0f}, {-0.70710678f, -0.70710678f}, {0.0f, -1.0f}, {0.70710678f, -0.70710678f}};
    return turns;
}

/// Index of the least of costs (JCAL_TWO_DOF_HEADINGS).
static inline unsigned jcal_two_dof_least(const float *costs)
{
    unsigned least = 0u;
    for (unsigned i = 1u; i < JCAL_TWO_DOF_HEADINGS; ++i) {
        least = (costs[i] < costs[least]) ? i : least;
    }
    return least;
}

/// Rz v, the turn about z given as exp(i delta).
static inline jcal_vec3_t jcal_two_dof_about_z(jcal_vec3_t v, jcal_plane_t turn)
{
    return jcal_vec3((turn.re * v.x) - (turn.im * v.y), (turn.im * v.x) + (turn.re * v.y), v.z);
}

/// The point with the order of its axes exchanged, as the segments stand at q1, q2: j1' = R1' D R2 j2, j2' = R2' D' R1 j1.
///
/// While one angle of the joint rests the other axis might as well be fixed to the other segment: the same motion, explained the
/// other way round. Starts all over the sphere find that minimum late.
static inline jcal_two_dof_point_t jcal_two_dof_exchanged(const jcal_two_dof_point_t *from, jcal_quat_t q1,
                                                          jcal_quat_t q2)
{
    const jcal_vec3_t in1 = jcal_quat_rotate(q1, from->j1);
    const jcal_vec3_t in2 = jcal_quat_rotate(q2, from->j2);
    const jcal_plane_t back = {from->heading.re, -from->heading.im};
    const jcal_two_dof_point_t point = {
        jcal_quat_rotate(jcal_quat_conj(q1), jcal_two_dof_about_z(in2, from->heading)),
        jcal_quat_rotate(jcal_quat_conj(q2), jcal_two_dof_about_z(in1, back)),
        from->heading,
    };
    return point;
}

/// True if both axes, as lines, and the headings are closer than the angle with this cosine.
static inline bool jcal_two_dof_is_near(const jcal_two_dof_point_t *a, const jcal_two_dof_point_t *b, float cosine)
{
    const float heading = (a->heading.re * b->heading.re) + (a->heading.im * b->heading.im);
    return (fabsf(jcal_vec3_dot(a->j1, b->j1)) > cosine) && (fabsf(jcal_vec3_dot(a->j2, b->j2)) > cosine) &&
           (heading > cosine);
}

/// The line of `axis` in the sense of `like`.
static inline jcal_vec3_t jcal_two_dof_in_sense_of(jcal_vec3_t axis, jcal_vec3_t like)
{
    return (jcal_vec3_dot(axis, like) < 0.0f) ? jcal_vec3_scale(axis, -1.0f) : axis;
}

#endif /* JCAL_TWO_DOF_STARTS_H */

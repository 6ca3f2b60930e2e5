/* SPDX-License-Identifier: MIT */
/// @file
/// Synthetic poses of a joint whose angles are known, in double precision: two segments, sensors at any orientation on them, and earth
/// frames of their own. Nothing here shares a formula with the library.
#ifndef JCAL_TEST_JOINT_POSE_H
#define JCAL_TEST_JOINT_POSE_H

#include "jointcal/orientation.h"

#include <math.h>

#define POSE_PI 3.14159265358979323846

typedef struct {
    double w, x, y, z;
} pose_quat_t;

/// What stays: how the sensors sit, and the angle between the axes.
typedef struct {
    pose_quat_t q_b1_s1, q_b2_s2;
    double carrying;
    bool hinge;  ///< z of B2 instead of its y is the axis of segment 2.
} pose_joint_t;

/// What moves, rad.
typedef struct {
    double flexion, pronation, heading;
    pose_quat_t q_b1_e1;
} pose_t;

static inline pose_quat_t pose_mul(pose_quat_t p, pose_quat_t q)
{
    const pose_quat_t out = {
        p.w * q.w - p.x * q.x - p.y * q.y - p.z * q.z, p.w * q.x + p.x * q.w + p.y * q.z - p.z * q.y,
        p.w * q.y - p.x * q.z + p.y * q.w + p.z * q.x, p.w * q.z + p.x * q.y - p.y * q.x + p.z * q.w};
    return out;
}

static inline pose_quat_t pose_conj(pose_quat_t q)
{
    const pose_quat_t out = {q.w, -q.x, -q.y, -q.z};
    return out;
}

/// Rotation by `angle` about the direction (x, y, z) of any length.
static inline pose_quat_t pose_turn(double angle, double x, double y, double z)
{
    const double s = sin(0.5 * angle) / sqrt(x * x + y * y + z * z);
    const pose_quat_t out = {cos(0.5 * angle), s * x, s * y, s * z};
    return out;
}

/// The k-th of a series of orientations that comes everywhere near any.
static inline pose_quat_t pose_any(int k)
{
    const double a = 2.399963 * k;
    return pose_mul(pose_turn(1.3 * k, 0.0, 0.0, 1.0), pose_turn(0.9 * k + 0.4, cos(a), sin(a), 0.3));
}

/// B2 to B1: turned by flexion about z, then about the new x by the carrying angle, then about the new y by pronation; a hinge
/// by flexion alone.
static inline pose_quat_t pose_joint(const pose_joint_t *joint, const pose_t *pose)
{
    const pose_quat_t flexed =
        pose_mul(pose_turn(pose->flexion, 0.0, 0.0, 1.0), pose_turn(joint->carrying, 1.0, 0.0, 0.0));
    return joint->hinge ? pose_turn(pose->flexion, 0.0, 0.0, 1.0)
                        : pose_mul(flexed, pose_turn(pose->pronation, 0.0, 1.0, 0.0));
}

static inline jcal_quat_t pose_single(pose_quat_t q)
{
    const jcal_quat_t out = {(float)q.w, (float)q.x, (float)q.y, (float)q.z};
    return out;
}

/// What the two sensors' filters would say.
static inline jcal_orientation_pair_t pose_sensors(const pose_joint_t *joint, const pose_t *pose, uint64_t t_us)
{
    const pose_quat_t q_b2_e1 = pose_mul(pose->q_b1_e1, pose_joint(joint, pose));
    const pose_quat_t q_b2_e2 = pose_mul(pose_turn(-pose->heading, 0.0, 0.0, 1.0), q_b2_e1);
    const jcal_orientation_pair_t out = {t_us, pose_single(pose_mul(pose->q_b1_e1, pose_conj(joint->q_b1_s1))),
                                         pose_single(pose_mul(q_b2_e2, pose_conj(joint->q_b2_s2)))};
    return out;
}

/// An axis of a segment as seen from its sensor; `axis` counts x, y, z from 0.
static inline jcal_vec3_t pose_axis(pose_quat_t q_b_s, int axis)
{
    const pose_quat_t v = {0.0, (axis == 0) ? 1.0 : 0.0, (axis == 1) ? 1.0 : 0.0, (axis == 2) ? 1.0 : 0.0};
    const pose_quat_t out = pose_mul(pose_mul(q_b_s, v), pose_conj(q_b_s));
    return (jcal_vec3_t){(float)out.x, (float)out.y, (float)out.z};
}

/// Axes 1 and 2 in their sensor frames.
static inline jcal_vec3_t pose_axis1(const pose_joint_t *joint)
{
    return pose_axis(joint->q_b1_s1, 2);
}

static inline jcal_vec3_t pose_axis2(const pose_joint_t *joint)
{
    return pose_axis(joint->q_b2_s2, joint->hinge ? 2 : 1);
}

/// How far two angles are apart on the circle, rad.
static inline double pose_apart(double a, double b)
{
    return fabs(remainder(a - b, 2.0 * POSE_PI));
}

#endif /* JCAL_TEST_JOINT_POSE_H */

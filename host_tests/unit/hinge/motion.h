/* SPDX-License-Identifier: MIT */
/// @file
/// Made-up hinge motion for tests: exact constraints, given mounting, a little noise. In double precision. And what the
/// tests of both engines say of a result.
#ifndef HINGE_MOTION_H
#define HINGE_MOTION_H

#include "jointcal/hinge.h"
#include "jointcal/quat.h"
#include "math/angle.h"
#include "math/sphere.h"
#include "unity.h"

#include <math.h>

/* Exact constraints with noise of 0.01 rad/s and 0.05 m/s^2 over 20 s, or in 200 selected rows: a few tenths of a degree. */
static const float AXIS_TOL_RAD = 0.5f * JCAL_RAD_PER_DEG;

/// What a motion is made of.
typedef struct {
    jcal_quat_t q_s1_a;  ///< Mounting: sensor 1 to segment frame A, whose z axis is the joint axis.
    jcal_quat_t q_s2_b;  ///< Sensor 2 to segment frame B.
    double rate_hz;
    double speed;        ///< 1 is lively, 0 is at rest.
    double joint_speed;  ///< The same for the joint; 0 is a stiff joint.
    double gyr_noise_rad_s;
    double gyr_noise2_rad_s;  ///< That of sensor 2; 0: the same.
    double acc_noise_m_s2;
    uint32_t seed;
} motion_t;

static inline double motion_noise(uint32_t *state)
{
    uint32_t sum = 0; /* whole, as processors without double precision spend most of a test here otherwise */
    for (int k = 0; k < 6; ++k) {
        *state = (*state * 1664525u) + 1013904223u;
        sum += *state >> 8;
    }
    return (((double)sum / 16777216.0) - 3.0) * 1.41421356; /* six uniform numbers: standard deviation 1 */
}

static inline jcal_vec3_t motion_noise3(double size, uint32_t *state)
{
    const float x = (float)(size * motion_noise(state));
    const float y = (float)(size * motion_noise(state));
    const float z = (float)(size * motion_noise(state));
    return jcal_vec3(x, y, z);
}

static inline jcal_vec3_t motion_sensor(jcal_quat_t q_sensor_segment, const double v[3], double noise, uint32_t *state)
{
    const jcal_vec3_t clean =
        jcal_quat_rotate(jcal_quat_conj(q_sensor_segment), jcal_vec3((float)v[0], (float)v[1], (float)v[2]));
    return jcal_vec3_add(clean, motion_noise3(noise, state));
}

/// Sample k; both axes are (0, 0, 1) in the segment frames.
static inline jcal_pair_t motion_sample(const motion_t *m, uint32_t k)
{
    uint32_t state = (m->seed * 2654435761u) ^ ((k + 1u) * 2246822519u);
    const double t = (double)k / m->rate_hz;
    /* Lively and calm stretches of 4 s. */
    const double lively = (sin(0.8 * t) > 0.0) ? 1.0 : 0.25;
    const double s = m->speed * lively;
    const double angle = m->joint_speed * (0.9 * sin(2.1 * t) + 0.5 * sin(0.7 * t));
    const double joint_rate = m->joint_speed * ((0.9 * 2.1 * cos(2.1 * t)) + (0.5 * 0.7 * cos(0.7 * t)));
    const double wa[3] = {s * 1.7 * sin(1.3 * t), s * 1.2 * cos(1.9 * t), s * 2.0 * sin(0.9 * t + 1.0)};
    const double tilt = m->speed * 1.1 * sin(0.31 * t);
    const double turn = m->speed * 0.45 * t;
    const double fa[3] = {9.81 * cos(tilt) * cos(turn), 9.81 * cos(tilt) * sin(turn), (9.81 * sin(tilt)) + 1.5};
    const double c = cos(angle);
    const double n = sin(angle);
    const double wb[3] = {(c * wa[0]) + (n * wa[1]), (c * wa[1]) - (n * wa[0]), wa[2] + joint_rate};
    const double fb[3] = {(c * fa[0]) + (n * fa[1]), (c * fa[1]) - (n * fa[0]), fa[2]};
    jcal_pair_t pair;
    pair.t_us = (uint64_t)(t * 1e6 + 0.5) + 1000000u;
    pair.imu1.gyr_rad_s = motion_sensor(m->q_s1_a, wa, m->gyr_noise_rad_s, &state);
    pair.imu2.gyr_rad_s =
        motion_sensor(m->q_s2_b, wb, (m->gyr_noise2_rad_s > 0.0) ? m->gyr_noise2_rad_s : m->gyr_noise_rad_s, &state);
    pair.imu1.acc_m_s2 = motion_sensor(m->q_s1_a, fa, m->acc_noise_m_s2, &state);
    pair.imu2.acc_m_s2 = motion_sensor(m->q_s2_b, fb, m->acc_noise_m_s2, &state);
    return pair;
}

/// Lively motion with some mounting; `mounting` picks one.
static inline motion_t motion_lively(uint32_t mounting)
{
    uint32_t state = mounting + 1u;
    motion_t m = {.rate_hz = 50.0, .speed = 1.0, .joint_speed = 1.0, .gyr_noise_rad_s = 0.01, .acc_noise_m_s2 = 0.05};
    jcal_quat_t *const q[2] = {&m.q_s1_a, &m.q_s2_b};
    for (int i = 0; i < 2; ++i) {
        const float w = (float)motion_noise(&state);
        const float x = (float)motion_noise(&state);
        const float y = (float)motion_noise(&state);
        const float z = (float)motion_noise(&state);
        *q[i] = jcal_quat_normalise(jcal_quat(w, x, y, z));
    }
    m.seed = mounting;
    return m;
}

/// True axis in sensor frame 1 (sensor = 0) or 2 (sensor = 1).
static inline jcal_vec3_t motion_axis(const motion_t *m, int sensor)
{
    return jcal_quat_rotate(jcal_quat_conj((sensor == 0) ? m->q_s1_a : m->q_s2_b), jcal_vec3(0.0f, 0.0f, 1.0f));
}

/// Mounting near the identity: both axes near (0, 0, 1), or, for the opposite pairing, sensor 2 turned about x by half
/// a turn and axis 2 near (0, 0, -1).
static inline motion_t motion_paired(bool same)
{
    motion_t motion = motion_lively(4);
    motion.q_s1_a = jcal_quat_normalise(jcal_quat(1.0f, 0.1f, 0.0f, 0.0f));
    motion.q_s2_b = same ? motion.q_s1_a : jcal_quat_normalise(jcal_quat(0.1f, 1.0f, 0.0f, 0.0f));
    return motion;
}

/* Both axes up to their common sign: the right pairing is part of it. */
static inline void assert_axes(const jcal_hinge_result_t *result, const motion_t *motion)
{
    const jcal_vec3_t truth1 = motion_axis(motion, 0);
    const jcal_vec3_t truth2 = motion_axis(motion, 1);
    const float sign = (jcal_vec3_dot(result->axis1, truth1) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE(result->has_axes);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(result->axis1, sign), truth1) < AXIS_TOL_RAD);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(result->axis2, sign), truth2) < AXIS_TOL_RAD);
}

/* Unit axes, of which the first is shown with its largest component positive. */
static inline void assert_normal_form(const jcal_hinge_result_t *r)
{
    const float low = fminf(r->axis1.x, fminf(r->axis1.y, r->axis1.z));
    const float high = fmaxf(r->axis1.x, fmaxf(r->axis1.y, r->axis1.z));
    TEST_ASSERT_TRUE(high >= -low);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(r->axis1));
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(r->axis2));
}

#endif /* HINGE_MOTION_H */

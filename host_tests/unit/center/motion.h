/* SPDX-License-Identifier: MIT */
/// @file
/// Simulated sensors on both sides of a joint centre, in double precision: rates and specific forces are differences of orientations
/// and positions, so that nothing here shares a formula with the library.
#ifndef JCAL_TEST_CENTER_MOTION_H
#define JCAL_TEST_CENTER_MOTION_H

#include "jointcal/types.h"
#include "unit/angles/pose.h"

#include <math.h>
#include <stdint.h>

#define CENTER_GRAVITY 9.81
#define CENTER_STEP_S 1e-4

/// Which of the joint's three turns move.
enum { CENTER_STIFF = 0, CENTER_HINGE = 1, CENTER_TWO_AXES = 2, CENTER_BALL = 3 };

typedef struct {
    double r1[3], r2[3];        ///< Joint to sensor, sensor frames, m.
    double base, joint;         ///< Amplitudes, rad: of the first segment, of the joint.
    double carried;             ///< Of the joint centre's way, m.
    double bias1[3], bias2[3];  ///< Of the accelerometers, m/s^2.
    double noise;               ///< Of the accelerometers, m/s^2; of the gyroscopes a tenth of it in rad/s.
    double rate_hz;
    int dof;
    int seed;
} center_motion_t;

static inline double center_wave(int which, double t_s, double hz, int seed)
{
    const double a = 1.9 * seed + 2.7 * which;
    return 0.6 * sin(2.0 * POSE_PI * hz * (0.8 + 0.3 * sin(a)) * t_s + 3.0 * a) +
           0.4 * sin(2.0 * POSE_PI * hz * (1.6 + 0.3 * cos(2.0 * a)) * t_s + 5.0 * a);
}

/// Sensor 1 or 2 to earth.
static inline pose_quat_t center_orientation(const center_motion_t *m, int sensor, double t_s)
{
    const double b = m->base;
    pose_quat_t q = pose_turn(b * center_wave(1, t_s, 0.5, m->seed), 0.0, 0.0, 1.0);
    q = pose_mul(q, pose_turn(b * center_wave(2, t_s, 0.6, m->seed), 1.0, 0.0, 0.0));
    q = pose_mul(q, pose_turn(b * center_wave(3, t_s, 0.55, m->seed), 0.0, 1.0, 0.0));
    if (sensor == 2) {
        const double j = m->joint;
        q = pose_mul(q, pose_turn((m->dof >= 1) ? (j * center_wave(4, t_s, 0.7, m->seed)) : 0.3, 0.0, 0.0, 1.0));
        q = pose_mul(q, pose_turn((m->dof >= 2) ? (j * center_wave(5, t_s, 0.8, m->seed)) : 0.2, 0.0, 1.0, 0.0));
        q = pose_mul(q, pose_turn((m->dof >= 3) ? (j * center_wave(6, t_s, 0.75, m->seed)) : 0.1, 1.0, 0.0, 0.0));
    }
    return pose_mul(q, pose_any(7 * m->seed + sensor)); /* as it is mounted */
}

static inline void center_turn(pose_quat_t q, const double *v, double *out)
{
    const pose_quat_t p = {0.0, v[0], v[1], v[2]};
    const pose_quat_t r = pose_mul(pose_mul(q, p), pose_conj(q));
    out[0] = r.x;
    out[1] = r.y;
    out[2] = r.z;
}

static inline void center_position(const center_motion_t *m, int sensor, double t_s, double *out)
{
    center_turn(center_orientation(m, sensor, t_s), (sensor == 1) ? m->r1 : m->r2, out);
    for (int i = 0; i < 3; ++i) {
        out[i] += m->carried * center_wave(7 + i, t_s, 0.5, m->seed);
    }
}

/// Noise of unit variance, nearly Gaussian: the same for the same arguments.
static inline double center_noise(uint32_t k, uint32_t channel)
{
    double sum = 0.0;
    uint32_t x = (k * 2654435761u) ^ (channel * 40503u + 12345u);
    for (int i = 0; i < 12; ++i) {
        x ^= x << 13;
        x ^= x >> 17;
        x ^= x << 5;
        sum += (double)x / 4294967296.0;
    }
    return sum - 6.0;
}

static inline jcal_imu_t center_imu(const center_motion_t *m, int sensor, uint32_t k)
{
    const double t_s = (double)k / m->rate_hz;
    const double h = CENTER_STEP_S;
    const pose_quat_t q = center_orientation(m, sensor, t_s);
    const pose_quat_t turn =
        pose_mul(pose_conj(center_orientation(m, sensor, t_s - h)), center_orientation(m, sensor, t_s + h));
    const double to_rate = ((turn.w < 0.0) ? -1.0 : 1.0) / h; /* 2 (x, y, z) / (2 h) */
    double before[3];
    double at[3];
    double after[3];
    center_position(m, sensor, t_s - h, before);
    center_position(m, sensor, t_s, at);
    center_position(m, sensor, t_s + h, after);
    double force[3];
    for (int i = 0; i < 3; ++i) {
        force[i] = (before[i] - 2.0 * at[i] + after[i]) / (h * h) + ((i == 2) ? CENTER_GRAVITY : 0.0);
    }
    double felt[3];
    center_turn(pose_conj(q), force, felt);
    const double *const bias = (sensor == 1) ? m->bias1 : m->bias2;
    const double rates[3] = {turn.x * to_rate, turn.y * to_rate, turn.z * to_rate};
    float out[6];
    for (int i = 0; i < 3; ++i) {
        const uint32_t channel = (uint32_t)(6 * sensor + i);
        out[i] = (float)(rates[i] + 0.1 * m->noise * center_noise(k, channel));
        out[3 + i] = (float)(felt[i] + bias[i] + m->noise * center_noise(k, channel + 3u));
    }
    const jcal_imu_t imu = {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
    return imu;
}

static inline jcal_pair_t center_sample(const center_motion_t *m, uint32_t k)
{
    const jcal_pair_t pair = {UINT64_C(3000000) + (uint64_t)((double)k * 1e6 / m->rate_hz + 0.5), center_imu(m, 1, k),
                              center_imu(m, 2, k)};
    return pair;
}

/// A ball joint in lively motion: tells everything within seconds.
static inline center_motion_t center_lively(int seed)
{
    const center_motion_t m = {
        .r1 = {-0.12, 0.02 * (seed % 3), 0.05},
        .r2 = {0.03, 0.16, -0.02 * (seed % 4)},
        .base = 0.7,
        .joint = 0.8,
        .carried = 0.03,
        .noise = 0.02,
        .rate_hz = 50.0,
        .dof = CENTER_BALL,
        .seed = seed,
    };
    return m;
}

static inline double center_error(jcal_vec3_t r, const double *truth)
{
    const double x = (double)r.x - truth[0];
    const double y = (double)r.y - truth[1];
    const double z = (double)r.z - truth[2];
    return sqrt(x * x + y * y + z * z);
}

/* The orientations of a sample; those of sensor 2 from an earth frame with another heading. */
static inline jcal_attitudes_t center_attitudes(const center_motion_t *m, uint32_t k, double heading)
{
    const double t_s = (double)k / m->rate_hz;
    const pose_quat_t other = pose_mul(pose_turn(-heading, 0.0, 0.0, 1.0), center_orientation(m, 2, t_s));
    const jcal_attitudes_t out = {pose_single(center_orientation(m, 1, t_s)), pose_single(other)};
    return out;
}

#endif /* JCAL_TEST_CENTER_MOTION_H */

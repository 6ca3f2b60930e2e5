/* SPDX-License-Identifier: MIT */
/// @file
/// Simulated sensors on pelvis, thigh and shank, in double precision, by differences of poses as in center/motion.h.
#ifndef JCAL_TEST_CHAIN_MOTION_H
#define JCAL_TEST_CHAIN_MOTION_H

#include "jointcal/chain.h"
#include "unit/center/motion.h"

typedef struct {
    center_motion_t hip;        ///< Pelvis and thigh: r1, r2, motion, noise, biases of both.
    double knee_to_shank[3];    ///< Sensor frame 3, m.
    double thigh[3];            ///< From hip to knee in the thigh's sensor frame, m.
    double bias3[3];            ///< m/s^2
    bool is_hinge;              ///< The knee turns about one axis only.
    double heading2, heading3;  ///< Of the earth frames that orientations 2 and 3 refer to.
} chain_motion_t;

static inline pose_quat_t chain_orientation(const chain_motion_t *m, int sensor, double t_s)
{
    if (sensor < 3) {
        return center_orientation(&m->hip, sensor, t_s);
    }
    const int seed = m->hip.seed;
    pose_quat_t q = pose_mul(center_orientation(&m->hip, 2, t_s), pose_conj(pose_any(7 * seed + 2)));
    q = pose_mul(q, pose_turn(1.1 * center_wave(10, t_s, 0.8, seed), 0.0, 0.0, 1.0));
    if (!m->is_hinge) {
        q = pose_mul(q, pose_turn(0.8 * center_wave(11, t_s, 0.7, seed), 0.0, 1.0, 0.0));
        q = pose_mul(q, pose_turn(0.8 * center_wave(12, t_s, 0.75, seed), 1.0, 0.0, 0.0));
    }
    return pose_mul(q, pose_any(7 * seed + 3));
}

static inline void chain_position(const chain_motion_t *m, int sensor, double t_s, double *out)
{
    center_position(&m->hip, (sensor < 3) ? sensor : 2, t_s, out);
    if (sensor < 3) {
        return;
    }
    double part[3];
    double from_sensor[3]; /* of the thigh, to the knee */
    for (int i = 0; i < 3; ++i) {
        from_sensor[i] = m->thigh[i] - m->hip.r2[i];
    }
    center_turn(center_orientation(&m->hip, 2, t_s), from_sensor, part);
    for (int i = 0; i < 3; ++i) {
        out[i] += part[i];
    }
    center_turn(chain_orientation(m, 3, t_s), m->knee_to_shank, part);
    for (int i = 0; i < 3; ++i) {
        out[i] += part[i];
    }
}

static inline jcal_imu_t chain_shank(const chain_motion_t *m, uint32_t k)
{
    const double t_s = (double)k / m->hip.rate_hz;
    const double h = CENTER_STEP_S;
    const pose_quat_t turn = pose_mul(pose_conj(chain_orientation(m, 3, t_s - h)), chain_orientation(m, 3, t_s + h));
    const double to_rate = ((turn.w < 0.0) ? -1.0 : 1.0) / h;
    const double rates[3] = {turn.x * to_rate, turn.y * to_rate, turn.z * to_rate};
    double before[3];
    double at[3];
    double after[3];
    double force[3];
    double felt[3];
    chain_position(m, 3, t_s - h, before);
    chain_position(m, 3, t_s, at);
    chain_position(m, 3, t_s + h, after);
    for (int i = 0; i < 3; ++i) {
        force[i] = (before[i] - 2.0 * at[i] + after[i]) / (h * h) + ((i == 2) ? CENTER_GRAVITY : 0.0);
    }
    center_turn(pose_conj(chain_orientation(m, 3, t_s)), force, felt);
    float out[6];
    for (int i = 0; i < 3; ++i) {
        const uint32_t channel = (uint32_t)(18 + i);
        out[i] = (float)(rates[i] + 0.1 * m->hip.noise * center_noise(k, channel));
        out[3 + i] = (float)(felt[i] + m->bias3[i] + m->hip.noise * center_noise(k, channel + 3u));
    }
    const jcal_imu_t imu = {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
    return imu;
}

static inline jcal_triple_t chain_sample(const chain_motion_t *m, uint32_t k)
{
    const jcal_pair_t pair = center_sample(&m->hip, k);
    const jcal_triple_t triple = {pair.t_us, pair.imu1, pair.imu2, chain_shank(m, k)};
    return triple;
}

static inline jcal_triple_attitudes_t chain_attitudes(const chain_motion_t *m, uint32_t k)
{
    const double t_s = (double)k / m->hip.rate_hz;
    const jcal_triple_attitudes_t out = {
        pose_single(chain_orientation(m, 1, t_s)),
        pose_single(pose_mul(pose_turn(-m->heading2, 0.0, 0.0, 1.0), chain_orientation(m, 2, t_s))),
        pose_single(pose_mul(pose_turn(-m->heading3, 0.0, 0.0, 1.0), chain_orientation(m, 3, t_s)))};
    return out;
}

/// Truth of one of the four vectors.
static inline void chain_truth(const chain_motion_t *m, jcal_chain_place_t place, double *r)
{
    for (int i = 0; i < 3; ++i) {
        r[i] = (place == JCAL_CHAIN_HIP_TO_PELVIS)   ? m->hip.r1[i]
               : (place == JCAL_CHAIN_HIP_TO_THIGH)  ? m->hip.r2[i]
               : (place == JCAL_CHAIN_KNEE_TO_THIGH) ? (m->hip.r2[i] - m->thigh[i])
                                                     : m->knee_to_shank[i];
    }
}

/// Lively motion of all joints.
static inline chain_motion_t chain_lively(int seed)
{
    chain_motion_t m = {
        .hip = center_lively(seed),
        .knee_to_shank = {0.04, -0.15, 0.03},
        .thigh = {0.05, 0.4, -0.06},
        .heading2 = 0.4,
        .heading3 = -1.1,
    };
    m.hip.r2[1] = 0.2;
    return m;
}

#endif /* JCAL_TEST_CHAIN_MOTION_H */

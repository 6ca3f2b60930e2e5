/* SPDX-License-Identifier: MIT */
/// @file
/// Three exact sensors on pelvis, thigh and shank that stand still for a second and then move, in double precision: poses of
/// chain/motion.h at a time that gathers pace smoothly, and differences of them.
#ifndef JCAL_TEST_LEG_MOTION_H
#define JCAL_TEST_LEG_MOTION_H

#include "unit/chain/motion.h"

#define LEG_REST_S 1.0

/// Time that the motion has got to.
static inline double leg_phase(double t_s)
{
    const double since = t_s - LEG_REST_S;
    return (since <= 0.0) ? 0.0 : ((since < 1.0) ? since * since * since * (1.0 - 0.5 * since) : since - 0.5);
}

static inline pose_quat_t leg_orientation(const chain_motion_t *m, int sensor, double t_s)
{
    return chain_orientation(m, sensor, leg_phase(t_s));
}

static inline jcal_imu_t leg_imu(const chain_motion_t *m, int sensor, uint32_t k)
{
    const double t_s = (double)k / m->hip.rate_hz;
    const double h = CENTER_STEP_S;
    const pose_quat_t turn =
        pose_mul(pose_conj(leg_orientation(m, sensor, t_s - h)), leg_orientation(m, sensor, t_s + h));
    const double to_rate = ((turn.w < 0.0) ? -1.0 : 1.0) / h; /* 2 (x, y, z) / (2 h) */
    const double rates[3] = {turn.x * to_rate, turn.y * to_rate, turn.z * to_rate};
    double before[3];
    double at[3];
    double after[3];
    double force[3];
    double felt[3];
    chain_position(m, sensor, leg_phase(t_s - h), before);
    chain_position(m, sensor, leg_phase(t_s), at);
    chain_position(m, sensor, leg_phase(t_s + h), after);
    for (int i = 0; i < 3; ++i) {
        force[i] = (before[i] - 2.0 * at[i] + after[i]) / (h * h) + ((i == 2) ? CENTER_GRAVITY : 0.0);
    }
    center_turn(pose_conj(leg_orientation(m, sensor, t_s)), force, felt);
    float out[6];
    for (int i = 0; i < 3; ++i) {
        const uint32_t channel = (uint32_t)(6 * sensor + i);
        out[i] = (float)(rates[i] + 0.1 * m->hip.noise * center_noise(k, channel));
        out[3 + i] = (float)(felt[i] + m->hip.noise * center_noise(k, channel + 3u));
    }
    const jcal_imu_t imu = {{out[0], out[1], out[2]}, {out[3], out[4], out[5]}};
    return imu;
}

static inline jcal_triple_t leg_sample(const chain_motion_t *m, uint32_t k)
{
    const jcal_triple_t triple = {UINT64_C(5000000) + (uint64_t)((double)k * 1e6 / m->hip.rate_hz + 0.5),
                                  leg_imu(m, 1, k), leg_imu(m, 2, k), leg_imu(m, 3, k)};
    return triple;
}

/// Lively motion of all joints, with a pelvis that is carried about as in walking.
static inline chain_motion_t leg_lively(int seed)
{
    chain_motion_t m = chain_lively(seed);
    m.hip.carried = 0.1;
    return m;
}

#endif /* JCAL_TEST_LEG_MOTION_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A simulated joint with two axes in motion, as orientations of both sensors: exact but for what the skin does.
#ifndef JCAL_TEST_TWO_DOF_MOTION_H
#define JCAL_TEST_TWO_DOF_MOTION_H

#include "jointcal/orientation.h"
#include "unit/angles/pose.h"

#define RATE_HZ 100
#define STEP_US 10000u

/* A joint in motion. Amplitudes, rad: of the joint's angles, of the first segment, of the skin under both sensors. */
typedef struct {
    pose_joint_t joint;
    double heading;
    double flexion, pronation, swing, skin;
    double speed;  ///< 1: waves of up to 1.1 Hz.
    int seed;
} sim_t;

/* A smooth number within about [-1, 1], another one for each `which`. */
static inline double wave(const sim_t *sim, int which, double t_s, double hz)
{
    const double a = 1.7 * sim->seed + 2.3 * which;
    return 0.6 * sin(2.0 * POSE_PI * hz * (0.8 + 0.3 * sin(a)) * t_s + 3.0 * a) +
           0.4 * sin(2.0 * POSE_PI * hz * (1.5 + 0.3 * cos(2.0 * a)) * t_s + 5.0 * a);
}

static inline pose_quat_t wobble(const sim_t *sim, int which, double t_s)
{
    const pose_quat_t x = pose_turn(sim->skin * wave(sim, which, t_s, 0.8), 1.0, 0.0, 0.0);
    const pose_quat_t y = pose_turn(sim->skin * wave(sim, which + 1, t_s, 0.7), 0.0, 1.0, 0.0);
    const pose_quat_t z = pose_turn(sim->skin * wave(sim, which + 2, t_s, 0.9), 0.0, 0.0, 1.0);
    return pose_mul(x, pose_mul(y, z));
}

static inline jcal_orientation_pair_t sample_of(const sim_t *sim, uint32_t k)
{
    const double t_s = sim->speed * (double)k / RATE_HZ;
    pose_joint_t joint = sim->joint;
    joint.q_b1_s1 = pose_mul(wobble(sim, 10, t_s), joint.q_b1_s1);
    joint.q_b2_s2 = pose_mul(wobble(sim, 20, t_s), joint.q_b2_s2);
    pose_t pose = {1.0, -0.4, sim->heading, {1.0, 0.0, 0.0, 0.0}};
    pose.flexion += sim->flexion * wave(sim, 1, t_s, 0.6);
    pose.pronation += sim->pronation * wave(sim, 2, t_s, 0.5);
    const pose_quat_t tilted = pose_mul(pose_turn(sim->swing * wave(sim, 3, t_s, 0.4), 1.0, 0.0, 0.0),
                                        pose_turn(sim->swing * wave(sim, 4, t_s, 0.3), 0.0, 1.0, 0.0));
    pose.q_b1_e1 = pose_mul(pose_turn(sim->swing * wave(sim, 5, t_s, 0.35), 0.0, 0.0, 1.0), tilted);
    return pose_sensors(&joint, &pose, UINT64_C(5000000) + (uint64_t)k * STEP_US);
}

static inline sim_t lively(int seed)
{
    const sim_t sim = {
        .joint = {pose_any(3 * seed + 1), pose_any(5 * seed + 2), 0.15, false},
        .heading = 0.7 * seed - 1.2,
        .flexion = 0.7,
        .pronation = 0.9,
        .swing = 0.7,
        .skin = 0.0,
        .speed = 1.0,
        .seed = seed,
    };
    return sim;
}

/* Both axes lie half-way between x and y of their sensors, one of them negative: which component is the largest is a matter of
 * noise. */
static inline sim_t tied(int seed)
{
    sim_t sim = lively(seed);
    sim.joint.q_b1_s1 = pose_turn(0.5 * POSE_PI, 1.0, 1.0, 0.0);  /* z to (1, -1, 0) */
    sim.joint.q_b2_s2 = pose_turn(0.25 * POSE_PI, 0.0, 0.0, 1.0); /* y to (-1, 1, 0) */
    sim.skin = 0.006;
    return sim;
}

#endif /* JCAL_TEST_TWO_DOF_MOTION_H */

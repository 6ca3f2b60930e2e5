/* SPDX-License-Identifier: MIT */
/// @file
/// A ball joint that is fed with the ticks of a made-up one. Tests of ball/.
#ifndef JCAL_TEST_BALL_FIXTURE_H
#define JCAL_TEST_BALL_FIXTURE_H

#include "jointcal/ball.h"
#include "jointcal/quat.h"
#include "jointcal/vec3.h"
#include "unit/functional/motion.h"

#include <unity.h>

#define TICK_US 50000u

/// A run: the joint, what moves, and the number of the next tick.
typedef struct {
    jcal_ball_t joint;
    hinge_t arm;
    uint64_t begin_us;
    uint32_t next;
    uint32_t epoch;
    uint32_t slices;  ///< That were done.
    bool exchanged;   ///< Sensors 1 and 2 change places.
    bool mirrored;    ///< Everything is seen in a mirror, left for right.
} run_t;

/// It moves about three axes.
static inline hinge_t arm_usual(void)
{
    hinge_t h = hinge_usual();
    h.twist = 1.0;
    h.side = 1.0;
    return h;
}

/// A number in [-1, 1] that is another one for each n.
static inline double any(int n)
{
    uint32_t x = 2654435761u * ((uint32_t)n + 12345u);
    x ^= x >> 15;
    x *= 2246822519u;
    x ^= x >> 13;
    return (double)(x >> 8) / 8388607.5 - 1.0;
}

/// Arms that differ in everything: mounts, levers, heading, pace, how much the segments turn and the centre moves.
static inline hinge_t some_arm(int number)
{
    hinge_t h = arm_usual();
    const int n = 16 * number;
    const double turn1[3] = {2.0 * any(n), 2.0 * any(n + 1), 2.0 * any(n + 2)};
    const double turn2[3] = {2.0 * any(n + 3), 2.0 * any(n + 4), 2.0 * any(n + 5)};
    mat_turn(turn1, h.mount1);
    mat_turn(turn2, h.mount2);
    for (int i = 0; i < 3; ++i) {
        h.r1[i] = 0.2 * any(n + 6 + i);
        h.r2[i] = 0.2 * any(n + 9 + i);
    }
    h.heading = 3.0 * any(n + 12);
    h.pace = pow(2.0, any(n + 13));
    h.turn = pow(2.0, any(n + 14));
    h.lift = pow(2.0, any(n + 15));
    return h;
}

static inline void run_begin(run_t *run, const hinge_t *arm, const jcal_ball_config_t *config)
{
    const jcal_ball_config_t usual = jcal_ball_config_default();
    memset(run, 0, sizeof *run);
    run->arm = *arm;
    run->epoch = 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_init(&run->joint, (config != NULL) ? config : &usual));
}

static inline double run_time(const run_t *run)
{
    return (double)run->next * 0.05;
}

/// y becomes -y in earth and sensor frames; rates are no arrows and turn the other way.
static inline void tick_mirror(jcal_tick_t *tick)
{
    for (int i = 0; i < 9; ++i) {
        if (i % 2 == 1) { /* in the row or in the column of y, not in both */
            tick->turn[i] = -tick->turn[i];
            tick->lever[i] = -tick->lever[i];
            tick->rate[i] = -tick->rate[i];
        }
    }
    tick->velocity.y = -tick->velocity.y;
    tick->gyr.x = -tick->gyr.x;
    tick->gyr.z = -tick->gyr.z;
}

static inline void run_make(const run_t *run, jcal_tick_t *tick1, jcal_tick_t *tick2)
{
    const uint64_t t_us = run->begin_us + (uint64_t)run->next * TICK_US;
    *tick1 = hinge_tick(&run->arm, run_time(run), run->exchanged ? 2 : 1, t_us);
    *tick2 = hinge_tick(&run->arm, run_time(run), run->exchanged ? 1 : 2, t_us);
    tick1->epoch = run->epoch;
    tick2->epoch = run->epoch;
    if (run->mirrored) {
        tick_mirror(tick1);
        tick_mirror(tick2);
    }
}

static inline void run_work(run_t *run)
{
    for (int k = 0; (k < 40) && (jcal_ball_step(&run->joint) == JCAL_OK); ++k) {
        ++run->slices;
    }
}

/// One tick and the work that is due.
static inline void run_tick(run_t *run)
{
    jcal_tick_t tick1;
    jcal_tick_t tick2;
    run_make(run, &tick1, &tick2);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_add(&run->joint, &tick1, &tick2));
    run_work(run);
    ++run->next;
}

static inline void run_for(run_t *run, double seconds)
{
    for (int k = 0; k < (int)(seconds * 20.0 + 0.5); ++k) {
        run_tick(run);
    }
}

static inline jcal_ball_result_t run_result(const run_t *run)
{
    jcal_ball_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_get(&run->joint, &out));
    return out;
}

/// Seconds until the status is `wanted`; fails after `most_s`.
static inline double run_until(run_t *run, jcal_calibration_t wanted, double most_s)
{
    const double begin = run_time(run);
    while (run_result(run).head.status != wanted) {
        TEST_ASSERT_TRUE_MESSAGE(run_time(run) - begin < most_s, "the status did not come");
        run_tick(run);
    }
    return run_time(run) - begin;
}

/// How far the heading is from the true one of the last tick, rad.
static inline double run_heading_error(const run_t *run)
{
    const double truth = run->arm.heading + run->arm.drift_rad_s * (run_time(run) - 0.05);
    return fabs(remainder((double)run_result(run).heading.heading_rad - truth, 2.0 * MOTION_PI));
}

/// How far a lever is from the true one, m.
static inline double run_lever_error(const run_t *run, int which)
{
    const jcal_ball_result_t result = run_result(run);
    const jcal_vec3_t found = (which == 1) ? result.joint_to_sensor1_m : result.joint_to_sensor2_m;
    const jcal_vec3_t truth = to_vec3((which == 1) ? run->arm.r1 : run->arm.r2);
    return (double)jcal_vec3_norm(jcal_vec3_sub(found, truth));
}

#endif /* JCAL_TEST_BALL_FIXTURE_H */

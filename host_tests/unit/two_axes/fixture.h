/* SPDX-License-Identifier: MIT */
/// @file
/// A made-up elbow: the axis of bending is y of the upper arm, that of turning x of the forearm, whose line it is. Tests of two_axes/.
#ifndef JCAL_TEST_TWO_AXES_FIXTURE_H
#define JCAL_TEST_TWO_AXES_FIXTURE_H

#include "jointcal/two_axes.h"
#include "math/sphere.h"
#include "unit/functional/motion.h"

#include <unity.h>

#define TICK_US 50000u

/// What the elbow does.
typedef enum { BEND, TURN, BOTH } elbow_motion_t;

/// A run: the joint, what moves, and the number of the next tick.
typedef struct {
    jcal_two_axes_t joint;
    hinge_t elbow;
    uint64_t begin_us;
    uint32_t next;
    uint32_t epoch;
} run_t;

/// Sensors anywhere on the segments, a centimetre or two beside their lines.
static inline hinge_t elbow_usual(void)
{
    hinge_t h = hinge_usual();
    const double along1[3] = {-0.20, 0.02, 0.03};
    const double along2[3] = {0.22, -0.02, 0.01};
    double back[9];
    mat_transpose(h.mount1, back);
    mat_times(back, along1, h.r1);
    mat_transpose(h.mount2, back);
    mat_times(back, along2, h.r2);
    return h;
}

/// From now on it bends only, at any angle of the forearm; turns only, bent by 80 deg; or both.
static inline void elbow_do(hinge_t *elbow, elbow_motion_t motion)
{
    elbow->bent = (motion == TURN) ? 1.4 : 0.9;
    elbow->swing = (motion == TURN) ? 0.0 : 1.0;
    elbow->twist = (motion == BEND) ? 0.0 : 1.5;
}

static inline void run_begin(run_t *run, const hinge_t *elbow, const jcal_two_axes_config_t *config)
{
    const jcal_two_axes_config_t usual = jcal_two_axes_config_default();
    memset(run, 0, sizeof *run);
    run->elbow = *elbow;
    run->epoch = 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_init(&run->joint, (config != NULL) ? config : &usual));
}

static inline double run_time(const run_t *run)
{
    return (double)run->next * 0.05;
}

static inline void run_make(const run_t *run, jcal_tick_t *tick1, jcal_tick_t *tick2)
{
    const uint64_t t_us = run->begin_us + (uint64_t)run->next * TICK_US;
    *tick1 = hinge_tick(&run->elbow, run_time(run), 1, t_us);
    *tick2 = hinge_tick(&run->elbow, run_time(run), 2, t_us);
    tick1->epoch = run->epoch;
    tick2->epoch = run->epoch;
}

static inline void run_work(run_t *run)
{
    for (int k = 0; (k < 40) && (jcal_two_axes_step(&run->joint) == JCAL_OK); ++k) {
    }
}

/// One tick and the work that is due.
static inline void run_tick(run_t *run)
{
    jcal_tick_t tick1;
    jcal_tick_t tick2;
    run_make(run, &tick1, &tick2);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_add(&run->joint, &tick1, &tick2));
    run_work(run);
    ++run->next;
}

static inline void run_for(run_t *run, elbow_motion_t motion, double seconds)
{
    elbow_do(&run->elbow, motion);
    for (int k = 0; k < (int)(seconds * 20.0 + 0.5); ++k) {
        run_tick(run);
    }
}

static inline jcal_two_axes_result_t run_result(const run_t *run)
{
    jcal_two_axes_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_axes_get(&run->joint, &out));
    return out;
}

/// The true axis of bending in sensor frame 1, of turning in sensor frame 2, whatever the sign.
static inline jcal_vec3_t elbow_axis(const hinge_t *elbow, int which)
{
    const double y[3] = {0.0, 1.0, 0.0};
    const double x[3] = {1.0, 0.0, 0.0};
    double back[9];
    double out[3];
    mat_transpose((which == 1) ? elbow->mount1 : elbow->mount2, back);
    mat_times(back, (which == 1) ? y : x, out);
    return to_vec3(out);
}

/// Angle between the lines of two unit vectors, rad.
static inline double line_angle(jcal_vec3_t a, jcal_vec3_t b)
{
    const jcal_vec3_t toward = (jcal_vec3_dot(a, b) < 0.0f) ? jcal_vec3_scale(a, -1.0f) : a;
    return (double)jcal_sphere_angle(toward, b);
}

#endif /* JCAL_TEST_TWO_AXES_FIXTURE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A functional joint that is fed with the ticks of a made-up hinge. Tests of functional/.
#ifndef JCAL_TEST_FUNCTIONAL_FIXTURE_H
#define JCAL_TEST_FUNCTIONAL_FIXTURE_H

#include "joint/sign.h"
#include "jointcal/functional.h"
#include "math/scalar.h"
#include "math/sphere.h"
#include "unit/functional/motion.h"

#include <unity.h>

#define TICK_US 50000u

/// A run: the joint, what moves, and the number of the next tick.
typedef struct {
    jcal_functional_t joint;
    hinge_t hinge;
    uint64_t begin_us;
    uint32_t next;
    uint32_t epoch;
    bool exchanged;  ///< Sensors 1 and 2 change places.
} run_t;

static inline void run_begin(run_t *run, const hinge_t *hinge, const jcal_functional_config_t *config)
{
    const jcal_functional_config_t usual = jcal_functional_config_default();
    memset(run, 0, sizeof *run);
    run->hinge = *hinge;
    run->epoch = 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_init(&run->joint, (config != NULL) ? config : &usual));
}

static inline double run_time(const run_t *run)
{
    return (double)run->next * 0.05;
}

static inline void run_make(const run_t *run, jcal_tick_t *tick1, jcal_tick_t *tick2)
{
    const uint64_t t_us = run->begin_us + (uint64_t)run->next * TICK_US;
    *tick1 = hinge_tick(&run->hinge, run_time(run), run->exchanged ? 2 : 1, t_us);
    *tick2 = hinge_tick(&run->hinge, run_time(run), run->exchanged ? 1 : 2, t_us);
    tick1->epoch = run->epoch;
    tick2->epoch = run->epoch;
}

static inline void run_work(run_t *run)
{
    for (int k = 0; (k < 40) && (jcal_functional_step(&run->joint) == JCAL_OK); ++k) {
    }
}

/// One tick and the work that is due.
static inline void run_tick(run_t *run)
{
    jcal_tick_t tick1;
    jcal_tick_t tick2;
    run_make(run, &tick1, &tick2);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_add(&run->joint, &tick1, &tick2));
    run_work(run);
    ++run->next;
}

static inline void run_for(run_t *run, double seconds)
{
    for (int k = 0; k < (int)(seconds * 20.0 + 0.5); ++k) {
        run_tick(run);
    }
}

static inline jcal_functional_result_t run_result(const run_t *run)
{
    jcal_functional_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_get(&run->joint, &out));
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

/// Error of both axes, deg, the larger one, with one sign for both.
static inline double axes_error_deg(const run_t *run)
{
    const jcal_functional_result_t result = run_result(run);
    const jcal_vec3_t true1 = hinge_axis(&run->hinge, run->exchanged ? 2 : 1, run_time(run));
    const jcal_vec3_t true2 = hinge_axis(&run->hinge, run->exchanged ? 1 : 2, run_time(run));
    const float sign = (jcal_vec3_dot(result.axis1, true1) < 0.0f) ? -1.0f : 1.0f;
    const double first = (double)jcal_sphere_angle(jcal_vec3_scale(result.axis1, sign), true1);
    const double second = (double)jcal_sphere_angle(jcal_vec3_scale(result.axis2, sign), true2);
    return fmax(first, second) / HINGE_DEG;
}

/// The joint's angle at the last tick.
static inline double run_flexion(const run_t *run)
{
    const double t = run_time(run) - 0.05;
    const jcal_quat_t q1 = hinge_quat(&run->hinge, t, run->exchanged ? 2 : 1);
    const jcal_quat_t q2 = hinge_quat(&run->hinge, t, run->exchanged ? 1 : 2);
    return (double)jcal_functional_flexion(&run->joint, q1, q2);
}

#endif /* JCAL_TEST_FUNCTIONAL_FIXTURE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of a functional joint that takes over a calibration that is known, and of one that sleeps.
#include "unit/functional/fixture.h"

static run_t run;
static hinge_t hinge;

void setUp(void)
{
    hinge = hinge_usual();
    run_begin(&run, &hinge, NULL);
}

void tearDown(void)
{
}

/* The true axes and levers of the hinge, with bounds of 2 deg and residuals that are usual. */
static jcal_functional_known_t known_of(void)
{
    static run_t first;
    run_begin(&first, &hinge, NULL);
    (void)run_until(&first, JCAL_READY, 60.0);
    const jcal_functional_result_t result = run_result(&first);
    jcal_functional_known_t known = {result.axis1,
                                     result.axis2,
                                     result.joint_to_sensor1_m,
                                     result.joint_to_sensor2_m,
                                     (float)(2.0 * HINGE_DEG),
                                     (float)(2.5 * HINGE_DEG),
                                     (float)(1.0 * HINGE_DEG),
                                     {0.0f, 0.0f, 0.0f}};
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_usual(&first.joint, known.usual));
    return known;
}

static void what_is_adopted_is_ready_with_the_bounds_that_it_has(void)
{
    const jcal_functional_known_t known = known_of();
    run_for(&run, 2.0);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_adopt(&run.joint, &known));
    jcal_functional_result_t result = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result.head.status);
    TEST_ASSERT_TRUE(result.for_axes && result.for_flexion && result.has_axes);
    TEST_ASSERT_EQUAL_FLOAT(known.uncertainty1_rad, result.uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(known.uncertainty2_rad, result.uncertainty2_rad);
    TEST_ASSERT_EQUAL_FLOAT(known.flexion_uncertainty_rad, result.flexion_uncertainty_rad);
    TEST_ASSERT_FALSE(result.heading.known);
    TEST_ASSERT_TRUE(jcal_functional_sleeps(&run.joint));
    run_for(&run, 1.0);
    const double off = run_flexion(&run) - hinge_angle(&hinge, run_time(&run) - 0.05);
    for (int k = 0; k < 300; ++k) { /* the heading is followed: the angle is that of the joint */
        run_tick(&run);
        const double now = run_flexion(&run) - hinge_angle(&hinge, run_time(&run) - 0.05);
        TEST_ASSERT_DOUBLE_WITHIN(2.5 * HINGE_DEG, 0.0, remainder(now - off, 2.0 * MOTION_PI));
    }
    result = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result.head.status);
    TEST_ASSERT_EQUAL_MEMORY(&known.axis1, &result.axis1, sizeof known.axis1); /* nothing is learnt */
    TEST_ASSERT_EQUAL_FLOAT(known.uncertainty1_rad, result.uncertainty1_rad);
}

static void bounds_that_are_too_wide_are_refused_and_change_nothing(void)
{
    jcal_functional_known_t known = known_of();
    run_for(&run, 3.0);
    static jcal_functional_t before;
    before = run.joint;
    known.uncertainty1_rad = (float)(13.0 * HINGE_DEG); /* beyond 10 deg, and 1.2 times that */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_adopt(&run.joint, &known));
    known.uncertainty1_rad = (float)(8.0 * HINGE_DEG);
    known.flexion_uncertainty_rad = (float)(4.0 * HINGE_DEG); /* beyond 3 deg, and 1.2 times that */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_adopt(&run.joint, &known));
    known.usual[1] = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_adopt(&run.joint, &known));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_adopt(NULL, &known));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_functional_adopt(&run.joint, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &run.joint, sizeof before);
    known = known_of();
    known.uncertainty2_rad = (float)(8.0 * HINGE_DEG); /* good for angles alone */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_adopt(&run.joint, &known));
    TEST_ASSERT_FALSE(run_result(&run).for_axes);
    TEST_ASSERT_TRUE(run_result(&run).for_flexion);
}

static void a_slip_of_what_was_adopted_is_noticed(void)
{
    const jcal_functional_known_t known = known_of();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_adopt(&run.joint, &known));
    run_for(&run, 10.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    run.exchanged = true;
    (void)run_until(&run, JCAL_MOVED, 3.0);
    TEST_ASSERT_FALSE(run_result(&run).has_axes);
    TEST_ASSERT_FALSE(jcal_functional_sleeps(&run.joint));
    TEST_ASSERT_FALSE(run.joint.adopted);
}

static void only_what_is_ready_sleeps_and_it_goes_on_when_woken(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_functional_sleep(&run.joint, true));
    TEST_ASSERT_FALSE(jcal_functional_sleeps(&run.joint));
    (void)run_until(&run, JCAL_READY, 60.0);
    run_for(&run, 5.0);
    const jcal_functional_result_t before = run_result(&run);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_sleep(&run.joint, true));
    run_for(&run, 20.0);
    const jcal_functional_result_t asleep = run_result(&run);
    TEST_ASSERT_TRUE(jcal_functional_sleeps(&run.joint));
    TEST_ASSERT_EQUAL_INT(JCAL_READY, asleep.head.status);
    TEST_ASSERT_EQUAL_MEMORY(&before.axis1, &asleep.axis1, sizeof before.axis1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_sleep(&run.joint, false));
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status); /* what it found itself it has still */
    run_for(&run, 20.0);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, run_result(&run).head.status);
    TEST_ASSERT_TRUE(axes_error_deg(&run) < 1.0);
}

static void what_was_adopted_is_forgotten_when_it_is_woken(void)
{
    const jcal_functional_known_t known = known_of();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_adopt(&run.joint, &known));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_sleep(&run.joint, false));
    TEST_ASSERT_FALSE(run_result(&run).has_axes);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, run_result(&run).head.status);
    TEST_ASSERT_TRUE(run_until(&run, JCAL_READY, 60.0) > 1.0);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_is_adopted_is_ready_with_the_bounds_that_it_has);
    RUN_TEST(bounds_that_are_too_wide_are_refused_and_change_nothing);
    RUN_TEST(a_slip_of_what_was_adopted_is_noticed);
    RUN_TEST(only_what_is_ready_sleeps_and_it_goes_on_when_woken);
    RUN_TEST(what_was_adopted_is_forgotten_when_it_is_woken);
    return UNITY_END();
}

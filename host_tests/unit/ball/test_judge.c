/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of ball/judge.h: each thing that keeps an estimate from being ready, by itself, on either side of its limit.
#include "ball/judge.h"

#include "joint/hysteresis.h"
#include "jointcal/ball.h"
#include "jointcal/head.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static jcal_ball_t good; /* ready after three judgements, and far from every limit */

void setUp(void)
{
    const jcal_ball_config_t config = jcal_ball_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_init(&good, &config));
    good.has_estimate = true;
    good.ticks.gravity_off = 0.0f;
    good.sums.motion_s = 8.0f;
    good.sums.energy1 = 4.0f;
    good.sums.energy2 = 4.0f;
    good.sums.along[0] = 1.0f; /* half of both is along one rotation: 6 of 8 are left, over 4 */
    good.point.lack = 0.0f;
    good.point.speed2 = 0.2f;
    good.point.r1.x = 0.2f;
    good.verdict.heading_rad = 0.05f;
    good.verdict.bound1_m = 0.02f;
    good.verdict.bound2_m = 0.02f;
}

void tearDown(void)
{
}

static void judge(jcal_ball_t *joint)
{
    for (int k = 0; k < 3; ++k) {
        jcal_ball_judge(joint);
    }
}

/* What three judgements say of it. */
static jcal_reason_t judged(const jcal_ball_t *joint)
{
    jcal_ball_t copy = *joint;
    judge(&copy);
    const bool ready = copy.verdict.status == (uint8_t)JCAL_READY;
    TEST_ASSERT_EQUAL_INT(ready, copy.verdict.reason == (uint8_t)JCAL_REASON_NONE);
    TEST_ASSERT_EQUAL_INT(ready, copy.verdict.hint == (uint8_t)JCAL_HINT_NONE);
    TEST_ASSERT_EQUAL_INT(ready, copy.verdict.weak == (uint8_t)JCAL_WEAK_NONE);
    return (jcal_reason_t)copy.verdict.reason;
}

/* `value` at `inside` is ready, at `outside` for this reason not; where it was ready before, a value a little beyond is still. */
static void expect_limit(float *value, float inside, float outside, jcal_reason_t reason)
{
    *value = inside;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    *value = outside;
    TEST_ASSERT_EQUAL_INT(reason, judged(&good));
    good.verdict.status = (uint8_t)JCAL_READY;
    good.verdict.agreed = 3u;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    setUp();
}

static void each_limit_alone(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    expect_limit(&good.ticks.gravity_off, 0.59f, 0.61f, JCAL_REASON_GRAVITY_OFF);
    expect_limit(&good.sums.motion_s, 3.01f, 2.99f, JCAL_REASON_NO_MOTION);
    /* 5 % of 0.2 and noise of 0.0002 (m/s)^2 may be left, over 8 s */
    expect_limit(&good.point.lack, 8.0f * 0.01019f, 8.0f * 0.01021f, JCAL_REASON_NOT_ONE_JOINT);
    good.sums.energy2 = 1.0f; /* (4 + 1 - 2 x) / 1 is left */
    expect_limit(&good.sums.along[0], 2.464f, 2.466f, JCAL_REASON_NO_BEND);
    expect_limit(&good.verdict.heading_rad, 14.99f / 57.29578f, 15.01f / 57.29578f, JCAL_REASON_UNCERTAIN);
    good.cfg.max_heading_rad = 0.1f;
    expect_limit(&good.verdict.heading_rad, 0.099f, 0.101f, JCAL_REASON_UNCERTAIN);
}

/* What speaks first is told. */
static void the_first_reason_is_told(void)
{
    good.verdict.heading_rad = 1.0f;
    good.sums.along[0] = 4.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_BEND, judged(&good));
    good.point.lack = 8.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, judged(&good));
    good.sums.motion_s = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, judged(&good));
    good.ticks.gravity_off = 1.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_GRAVITY_OFF, judged(&good));
}

/* Numbers that are none are no joint. */
static void what_is_not_a_number_is_no_joint(void)
{
    good.point.lack = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, judged(&good));
    setUp();
    good.verdict.heading_rad = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, judged(&good));
}

static jcal_hint_t hint(const jcal_ball_t *joint)
{
    jcal_ball_t copy = *joint;
    judge(&copy);
    return (jcal_hint_t)copy.verdict.hint;
}

static void hints(void)
{
    good.verdict.heading_rad = 0.5f;
    good.point.speed2 = 0.031f;
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MORE_DIRECTIONS, hint(&good));
    good.point.speed2 = 0.029f;
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_FASTER, hint(&good));
    good.sums.along[0] = 4.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, hint(&good));
    good.point.lack = 8.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, hint(&good));
    good.sums.motion_s = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, hint(&good));
    good.ticks.gravity_off = 1.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, hint(&good));
}

static jcal_ball_result_t told(const jcal_ball_t *joint)
{
    jcal_ball_t copy = *joint;
    judge(&copy);
    jcal_ball_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_ball_get(&copy, &out));
    return out;
}

/* Of little motion less may be left: what no joint has in common may look small for a moment. */
static void little_motion_must_leave_less(void)
{
    good.sums.motion_s = 4.0f;
    good.point.lack = 4.0f * (0.5f * 0.05f * good.point.speed2 * 1.01f + 2e-4f);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, judged(&good));
    good.point.lack = 4.0f * (0.5f * 0.05f * good.point.speed2 * 0.99f + 2e-4f);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
    good.sums.motion_s = 80.0f;
    good.point.lack = 80.0f * (0.05f * good.point.speed2 * 1.01f + 2e-4f);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, judged(&good));
}

/* What was no joint is none until there is motion enough to say otherwise. */
static void what_was_refused_stays_so_without_motion(void)
{
    good.sums.motion_s = 2.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, judged(&good));
    good.refused = true;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NOT_ONE_JOINT, judged(&good));
    good.sums.motion_s = 20.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, judged(&good));
}

/* Each centre has a limit of its own, and none keeps the joint from being ready. */
static void centres_are_known_each_by_itself(void)
{
    good.verdict.bound1_m = 0.059f;
    good.verdict.bound2_m = 0.061f;
    jcal_ball_result_t r = told(&good);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_TRUE(r.for_center1);
    TEST_ASSERT_FALSE(r.for_center2);
    TEST_ASSERT_EQUAL_FLOAT(0.059f, r.uncertainty1_m);
    TEST_ASSERT_EQUAL_FLOAT(0.061f, r.uncertainty2_m);
    good.verdict.bound1_m = 0.061f;
    good.verdict.bound2_m = 0.059f;
    r = told(&good);
    TEST_ASSERT_FALSE(r.for_center1);
    TEST_ASSERT_TRUE(r.for_center2);
}

/* What breathes is still known, each centre by itself. */
static void centres_breathe(void)
{
    good.verdict.status = (uint8_t)JCAL_READY;
    good.verdict.agreed = 3u;
    good.verdict.for_center1 = true;
    good.verdict.for_center2 = false;
    good.verdict.bound1_m = 0.06f * JCAL_HYSTERESIS * 0.99f;
    good.verdict.bound2_m = 0.061f;
    TEST_ASSERT_TRUE(told(&good).for_center1);
    TEST_ASSERT_FALSE(told(&good).for_center2);
    good.verdict.bound1_m = 0.06f * JCAL_HYSTERESIS * 1.01f;
    TEST_ASSERT_FALSE(told(&good).for_center1);
    good.verdict.for_center2 = true;
    good.verdict.bound2_m = 0.06f * JCAL_HYSTERESIS * 0.99f;
    TEST_ASSERT_TRUE(told(&good).for_center2);
    good.verdict.bound2_m = 0.06f * JCAL_HYSTERESIS * 1.01f;
    TEST_ASSERT_FALSE(told(&good).for_center2);
    good.verdict.bound1_m = 0.02f;
    good.verdict.heading_rad = 0.5f; /* without a heading there is no joint that centres are of */
    const jcal_ball_result_t r = told(&good);
    TEST_ASSERT_FALSE(r.for_center1 || r.for_center2);
}

/* What is no joint has no bounds. */
static void no_bound_without_a_joint(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.05f, told(&good).uncertainty_heading_rad);
    good.verdict.heading_rad = 0.5f;
    TEST_ASSERT_EQUAL_FLOAT(0.5f, told(&good).uncertainty_heading_rad); /* not ready, but one joint */
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.2f, told(&good).joint_to_sensor1_m.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, sqrtf(0.1f), told(&good).speed_m_s);
    good.point.lack = 8.0f;
    const jcal_ball_result_t r = told(&good);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty_heading_rad);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty1_m);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, r.uncertainty2_m);
    setUp();
    good.has_estimate = false;
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, told(&good).uncertainty1_m);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, told(&good).joint_to_sensor1_m.x);
}

static void progress_is_how_far_each_bound_has_come(void)
{
    good.verdict.heading_rad = 30.0f / 57.29578f;
    good.verdict.bound1_m = 0.12f;
    good.verdict.bound2_m = 0.03f;
    const jcal_ball_result_t r = told(&good);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.5f, r.progress_heading);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.5f, r.progress_center1);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 1.0f, r.progress_center2);
}

static void three_judgements_must_agree(void)
{
    for (int k = 0; k < 3; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, good.verdict.status);
        TEST_ASSERT_FALSE(jcal_ball_is_joint(&good));
        jcal_ball_judge(&good);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, good.verdict.status);
    TEST_ASSERT_TRUE(jcal_ball_is_joint(&good));
    good.verdict.heading_rad = 0.5f; /* it is still one joint */
    jcal_ball_judge(&good);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, good.verdict.status);
    TEST_ASSERT_TRUE(jcal_ball_is_joint(&good));
    good.verdict.heading_rad = 0.05f;
    jcal_ball_judge(&good);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, good.verdict.status);
    good.point.lack = 8.0f;
    jcal_ball_judge(&good);
    TEST_ASSERT_FALSE(jcal_ball_is_joint(&good));
    good.point.lack = 0.0f;
    jcal_ball_judge(&good);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, good.verdict.status);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(each_limit_alone);
    RUN_TEST(the_first_reason_is_told);
    RUN_TEST(what_is_not_a_number_is_no_joint);
    RUN_TEST(hints);
    RUN_TEST(little_motion_must_leave_less);
    RUN_TEST(what_was_refused_stays_so_without_motion);
    RUN_TEST(centres_are_known_each_by_itself);
    RUN_TEST(centres_breathe);
    RUN_TEST(no_bound_without_a_joint);
    RUN_TEST(progress_is_how_far_each_bound_has_come);
    RUN_TEST(three_judgements_must_agree);
    return UNITY_END();
}

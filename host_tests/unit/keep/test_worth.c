/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/keep.h: what results become records, and which are worth a write.
#include "unit/keep/fixture.h"

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_hinge_auto_result_t ready_hinge(void)
{
    const jcal_kept_t kept = hinge_of(2u);
    jcal_hinge_auto_result_t result;
    memset(&result, 0, sizeof result);
    result.hinge.head.status = JCAL_READY;
    result.model = JCAL_MODEL_FUNCTIONAL;
    result.hinge.axis1 = kept.axis1;
    result.hinge.axis2 = kept.axis2;
    result.hinge.uncertainty1_rad = kept.bound1_rad;
    result.hinge.uncertainty2_rad = kept.bound2_rad;
    result.flexion_uncertainty_rad = kept.flexion_bound_rad;
    result.has_levers = true;
    result.joint_to_sensor1_m = kept.lever1_m;
    result.joint_to_sensor2_m = kept.lever2_m;
    return result;
}

static void a_hinge_becomes_a_record(void)
{
    jcal_hinge_auto_result_t result = ready_hinge();
    jcal_kept_t expected = hinge_of(2u);
    jcal_kept_t kept = expected;
    memset(&kept.axis1, 0, sizeof kept.axis1);
    kept.bound1_rad = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_from_hinge(&result, &kept));
    expected.bound_lever1_m = JCAL_BOUND_UNKNOWN_M;
    expected.bound_lever2_m = JCAL_BOUND_UNKNOWN_M;
    assert_kept(&expected, &kept);
    result.model = JCAL_MODEL_RIGID;
    result.has_levers = false;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_from_hinge(&result, &kept));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_HEADING_BY_AXES, kept.heading);
    TEST_ASSERT_FALSE(kept.has_levers);
    uint8_t bytes[JCAL_KEPT_BYTES];
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(&kept, bytes));
    const jcal_kept_t before = kept;
    result.hinge.head.status = JCAL_MOVED;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_from_hinge(&result, &kept));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_from_hinge(NULL, &kept));
    result.hinge.head.status = JCAL_READY;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_from_hinge(&result, NULL));
    assert_kept(&before, &kept);
}

static jcal_ball_result_t ready_ball(void)
{
    const jcal_kept_t kept = hinge_of(1u);
    jcal_ball_result_t result;
    memset(&result, 0, sizeof result);
    result.head.status = JCAL_READY;
    result.joint_to_sensor1_m = kept.lever1_m;
    result.joint_to_sensor2_m = kept.lever2_m;
    result.uncertainty1_m = kept.bound_lever1_m;
    result.uncertainty2_m = kept.bound_lever2_m;
    return result;
}

static void a_ball_and_two_axes_become_records(void)
{
    jcal_ball_result_t ball = ready_ball();
    jcal_kept_t expected = ball_of(1u);
    expected.model = JCAL_MODEL_FUNCTIONAL;
    jcal_kept_t kept = hinge_of(1u);
    kept.sequence = expected.sequence;
    kept.serial1 = expected.serial1;
    kept.serial2 = expected.serial2;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_from_ball(&ball, &expected.frames, &kept));
    assert_kept(&expected, &kept);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_from_ball(&ball, NULL, &kept));
    TEST_ASSERT_FALSE(kept.has_zero);

    jcal_two_axes_result_t two;
    memset(&two, 0, sizeof two);
    two.ball = ball;
    expected = hinge_of(1u);
    two.axis1 = expected.axis1;
    two.axis2 = expected.axis2;
    two.uncertainty1_rad = expected.bound1_rad;
    two.uncertainty2_rad = expected.bound2_rad;
    kept = hinge_of(1u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_from_two_axes(&two, &kept));
    expected.kind = JCAL_KEPT_TWO_AXES;
    expected.flexion_bound_rad = 0.0f;
    assert_kept(&expected, &kept);

    ball.head.status = JCAL_COLLECTING;
    two.ball = ball;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_from_ball(&ball, NULL, &kept));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_kept_from_two_axes(&two, &kept));
    assert_kept(&expected, &kept);
}

static void nothing_new_is_worth_nothing(void)
{
    const jcal_kept_t kept[] = {hinge_of(0u), ball_of(0u)};
    for (unsigned i = 0u; i < 2u; ++i) {
        jcal_kept_t now = kept[i];
        TEST_ASSERT_FALSE(jcal_kept_worth(&kept[i], &now));
        now.sequence += 5u;
        now.bound_lever1_m *= 0.6f;
        now.has_zero = false;
        TEST_ASSERT_FALSE(jcal_kept_worth(&kept[i], &now));
        now.has_levers = false;
        TEST_ASSERT_FALSE(jcal_kept_worth(&kept[i], &now));
        TEST_ASSERT_TRUE(jcal_kept_worth(NULL, &now));
        TEST_ASSERT_FALSE(jcal_kept_worth(&kept[i], NULL));
        now.has_levers = true;
        now.has_zero = true;
        TEST_ASSERT_FALSE(jcal_kept_worth(&now, &kept[i]));
        now = kept[i];
        now.bound1_rad = 0.0f;
        now.bound_lever1_m = 0.0f;
        const jcal_kept_t exact = now;
        TEST_ASSERT_FALSE(jcal_kept_worth(&exact, &now));
    }
}

static void other_joints_and_sensors_are_worth_a_write(void)
{
    const jcal_kept_t kept = hinge_of(0u);
    jcal_kept_t now = kept;
    now.joint = 1u;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.kind = JCAL_KEPT_TWO_AXES;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.model = JCAL_MODEL_RIGID;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.serial1 += 1u;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.serial2 += 1u;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
}

/* An axis counts beyond its kept bound, a bound at half of the kept one. */
static void axes_that_moved_and_bounds_that_halved_are_worth_a_write(void)
{
    const jcal_kept_t kept = hinge_of(0u);
    jcal_kept_t now = kept;
    now.axis1.y = 0.031f;
    now.axis2.x = 0.062f;
    now.bound1_rad = 0.016f;
    now.bound2_rad = 0.032f;
    TEST_ASSERT_FALSE(jcal_kept_worth(&kept, &now));
    now.axis1.y = 0.032f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.axis2.x = -0.063f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.bound1_rad = 0.0156f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.bound2_rad = 0.0312f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.axis1 = (jcal_vec3_t){-0.6f, 0.0f, 0.8f}; /* the other sense: angles with the other sign */
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
}

static void levers_are_worth_a_write(void)
{
    jcal_kept_t kept = hinge_of(0u);
    jcal_kept_t now = kept;
    now.lever1_m.x += 0.49f;
    now.bound_lever1_m = 0.26f;
    now.flexion_zero_rad += 0.03f;
    now.pronation_zero_rad -= 0.03f;
    TEST_ASSERT_FALSE(jcal_kept_worth(&kept, &now));
    now.lever1_m.x += 0.02f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.bound_lever2_m = 4.9f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.bound_lever1_m = 0.24f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    kept.has_levers = false;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
}

static void zeros_are_worth_a_write(void)
{
    jcal_kept_t kept = hinge_of(0u);
    jcal_kept_t now = kept;
    now.flexion_zero_rad += 0.04f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.pronation_zero_rad -= 0.04f;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    kept.has_zero = false;
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    kept = ball_of(0u);
    now = kept;
    now.frames.q_b2_s2 = (jcal_quat_t){0.99985f, 0.01732f, 0.0f, 0.0f}; /* 1.98 deg */
    TEST_ASSERT_FALSE(jcal_kept_worth(&kept, &now));
    now.frames.q_b2_s2 = (jcal_quat_t){-0.99980f, 0.0f, 0.02f, 0.0f}; /* 2.3 deg */
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
    now = kept;
    now.frames.q_b1_s1 = (jcal_quat_t){0.5f, 0.5f, 0.5f, 0.5f};
    TEST_ASSERT_TRUE(jcal_kept_worth(&kept, &now));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_hinge_becomes_a_record);
    RUN_TEST(a_ball_and_two_axes_become_records);
    RUN_TEST(nothing_new_is_worth_nothing);
    RUN_TEST(other_joints_and_sensors_are_worth_a_write);
    RUN_TEST(axes_that_moved_and_bounds_that_halved_are_worth_a_write);
    RUN_TEST(levers_are_worth_a_write);
    RUN_TEST(zeros_are_worth_a_write);
    return UNITY_END();
}

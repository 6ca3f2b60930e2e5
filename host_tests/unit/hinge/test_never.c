/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge.h: data that determine nothing never lead to `ready`, and the reason is told.
#include "unit/hinge/fixture.h"

#define GRAVITY_M_S2 9.81f
#define DEG_PER_RAD 57.2957795f

/* On an emulated target every kind of bad data, too, but with fewer mountings. */
#if defined(JCAL_TEST_SHORT)
enum { MOUNTINGS = 2 };
#else
enum { MOUNTINGS = 8 };
#endif

/* Changes a pair of a good motion into what the broken setup would send. */
typedef jcal_pair_t (*change_t)(const motion_t *motion, uint32_t k);

/* Runs the changed motion with every mounting; `ready` must never be seen. Returns the last reason. */
static jcal_reason_t never_ready(motion_t motion, change_t change)
{
    jcal_hinge_result_t r = {0};
    for (uint32_t mounting = 0; mounting < MOUNTINGS; ++mounting) {
        const motion_t like = motion_lively(mounting);
        motion.q_s1_a = like.q_s1_a;
        motion.q_s2_b = like.q_s2_b;
        motion.seed = mounting;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
        for (uint32_t k = 0; k < 2u * RUN; ++k) {
            const jcal_pair_t pair = (change == NULL) ? motion_sample(&motion, k) : change(&motion, k);
            TEST_ASSERT_TRUE(jcal_hinge_update(&engine, &pair) >= JCAL_OK);
            r = result_of(&engine);
            assert_sane(&r);
            TEST_ASSERT_NOT_EQUAL(JCAL_READY, r.head.status);
        }
    }
    return r.head.reason;
}

static void a_stiff_joint_is_never_ready(void)
{
    motion_t motion = motion_lively(0);
    motion.joint_speed = 0.0;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, never_ready(motion, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, result_of(&engine).head.hint);
}

static void both_segments_at_rest_are_never_ready(void)
{
    motion_t motion = motion_lively(0);
    motion.speed = 0.0;
    motion.joint_speed = 0.0;
    const jcal_reason_t reason = never_ready(motion, NULL);
    TEST_ASSERT_TRUE((reason == JCAL_REASON_NO_MOTION) || (reason == JCAL_REASON_NO_DATA));
}

static jcal_pair_t as_it_is(const motion_t *motion, uint32_t k)
{
    return motion_sample(motion, k);
}

static jcal_pair_t exchanged(const motion_t *motion, uint32_t k)
{
    const jcal_pair_t pair = motion_sample(motion, k);
    const jcal_pair_t out = {pair.t_us, pair.imu2, pair.imu1};
    return out;
}

/* One segment rests, the other turns about the joint: its axis shows, that of the resting one does not. */
static void assert_open_axis(change_t change, jcal_weak_t weak, jcal_hint_t hint)
{
    motion_t motion = motion_lively(0);
    motion.speed = 0.0;
    (void)never_ready(motion, change);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
    uint32_t uncertain = 0;
    for (uint32_t k = 0; k < 2u * RUN; ++k) {
        const jcal_pair_t pair = change(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        const jcal_hinge_result_t r = result_of(&engine);
        if (r.head.reason == JCAL_REASON_UNCERTAIN) {
            const float open = (weak == JCAL_WEAK_AXIS1) ? r.uncertainty1_rad : r.uncertainty2_rad;
            const float known = (weak == JCAL_WEAK_AXIS1) ? r.uncertainty2_rad : r.uncertainty1_rad;
            TEST_ASSERT_TRUE(open >= known);
            if (open > known) {
                TEST_ASSERT_EQUAL_INT(weak, r.head.weak);
                TEST_ASSERT_EQUAL_INT(hint, r.head.hint);
                uncertain += (known < 5.0f * JCAL_RAD_PER_DEG) ? 1u : 0u; /* planar motion: wide, but a bound */
            }
        }
    }
    TEST_ASSERT_TRUE(uncertain > RUN / 4); /* the open axis wanders, and now and then all sums begin anew with it */
}

static void one_segment_at_rest_leaves_its_axis_open(void)
{
    assert_open_axis(as_it_is, JCAL_WEAK_AXIS1, JCAL_HINT_MOVE_SEGMENT1);
}

static void the_other_segment_at_rest_leaves_the_other_axis_open(void)
{
    assert_open_axis(exchanged, JCAL_WEAK_AXIS2, JCAL_HINT_MOVE_SEGMENT2);
}

static jcal_pair_t zeros(const motion_t *motion, uint32_t k)
{
    const jcal_pair_t zero = {.t_us = motion_sample(motion, k).t_us};
    return zero;
}

static void zeros_are_never_ready(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_ACC, never_ready(motion_lively(0), zeros));
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, result_of(&engine).head.hint);
}

static jcal_pair_t frozen(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    pair.imu2 = motion_sample(motion, 0).imu2;
    return pair;
}

static void a_frozen_sensor_is_never_ready(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, never_ready(motion_lively(0), frozen));
    TEST_ASSERT_TRUE(result_of(&engine).head.rejected_by[JCAL_REJECT_FROZEN] > RUN);
}

static jcal_pair_t white_noise(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    uint32_t state = (k * 747796405u) + (motion->seed * 77u) + 1u;
    jcal_vec3_t *const vectors[4] = {&pair.imu1.gyr_rad_s, &pair.imu2.gyr_rad_s, &pair.imu1.acc_m_s2,
                                     &pair.imu2.acc_m_s2};
    for (int i = 0; i < 4; ++i) {
        *vectors[i] = motion_noise3((i < 2) ? 2.0 : 10.0, &state);
    }
    return pair;
}

static void white_noise_is_never_ready(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, never_ready(motion_lively(0), white_noise));
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, result_of(&engine).head.hint);
}

static jcal_pair_t degrees(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    pair.imu1.gyr_rad_s = jcal_vec3_scale(pair.imu1.gyr_rad_s, DEG_PER_RAD);
    pair.imu2.gyr_rad_s = jcal_vec3_scale(pair.imu2.gyr_rad_s, DEG_PER_RAD);
    return pair;
}

static void rates_in_degrees_are_never_ready_and_named(void)
{
    motion_t motion = motion_lively(0);
    motion.speed = 0.25; /* slow enough that 36 is hardly ever reached: the size of the rates alone does not show it */
    motion.joint_speed = 0.2;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, never_ready(motion, degrees));
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, result_of(&engine).head.hint);
}

static jcal_pair_t in_g(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    pair.imu1.acc_m_s2 = jcal_vec3_scale(pair.imu1.acc_m_s2, 1.0f / GRAVITY_M_S2);
    pair.imu2.acc_m_s2 = jcal_vec3_scale(pair.imu2.acc_m_s2, 1.0f / GRAVITY_M_S2);
    return pair;
}

static void specific_forces_in_g_are_never_ready_and_named(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_ACC, never_ready(motion_lively(0), in_g));
}

/* Sensor 2 is a copy of sensor 1, turned, with noise of its own. */
static jcal_pair_t turned_copy(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    uint32_t state = (k * 2891336453u) + motion->seed;
    const jcal_vec3_t gyr = motion_noise3(0.01, &state);
    const jcal_vec3_t acc = motion_noise3(0.01, &state);
    pair.imu2.gyr_rad_s = jcal_vec3_add(jcal_quat_rotate(motion->q_s2_b, pair.imu1.gyr_rad_s), gyr);
    pair.imu2.acc_m_s2 = jcal_vec3_add(jcal_quat_rotate(motion->q_s2_b, pair.imu1.acc_m_s2), acc);
    return pair;
}

static void a_turned_copy_of_the_same_sensor_is_never_ready(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_MOTION, never_ready(motion_lively(0), turned_copy));
}

/* Sensor 1 of one motion with sensor 2 of another. */
static jcal_pair_t strangers(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    pair.imu2 = motion_sample(motion, k + 7000u).imu2;
    return pair;
}

static void sensors_of_different_recordings_are_never_ready(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, never_ready(motion_lively(0), strangers));
}

static float clamp(float x, float limit)
{
    return fminf(fmaxf(x, -limit), limit);
}

static jcal_pair_t clipped(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    jcal_vec3_t *const rates[2] = {&pair.imu1.gyr_rad_s, &pair.imu2.gyr_rad_s};
    for (int i = 0; i < 2; ++i) {
        rates[i]->x = clamp(rates[i]->x, 0.8f);
        rates[i]->y = clamp(rates[i]->y, 0.8f);
        rates[i]->z = clamp(rates[i]->z, 0.8f);
    }
    return pair;
}

static void rates_clipped_at_a_quarter_of_the_range_are_never_ready(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, never_ready(motion_lively(0), clipped));
    TEST_ASSERT_TRUE(result_of(&engine).head.rejected_by[JCAL_REJECT_SATURATED] > 50u);
}

/* After ready, the given samples instead of good ones. */
static void assert_leaves_ready(change_t change, uint32_t within, jcal_reason_t reason)
{
    const motion_t motion = motion_lively(3);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    for (uint32_t k = RUN; k < RUN + within; ++k) {
        const jcal_pair_t pair = change(&motion, k);
        TEST_ASSERT_TRUE(jcal_hinge_update(&engine, &pair) >= JCAL_OK);
    }
    const jcal_hinge_result_t r = result_of(&engine);
    assert_sane(&r);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(reason, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
    /* It comes back with the sensor: what was learnt is still there. */
    run(&engine, &motion, RUN + within, RUN + within + 1u);
    for (uint32_t k = RUN + within + 1u; k < (2u * RUN) + within; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_TRUE(jcal_hinge_update(&engine, &pair) >= JCAL_OK);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

static void a_sensor_that_freezes_after_ready_leaves_ready_within_two_seconds(void)
{
    assert_leaves_ready(frozen, 100, JCAL_REASON_BAD_SAMPLES);
}

static jcal_pair_t failed_acc(const motion_t *motion, uint32_t k)
{
    jcal_pair_t pair = motion_sample(motion, k);
    pair.imu1.acc_m_s2 = jcal_vec3(0.0f, 0.0f, 0.0f);
    return pair;
}

static void a_sensor_that_loses_its_accelerometer_leaves_ready(void)
{
    const motion_t motion = motion_lively(3);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    for (uint32_t k = RUN; k < RUN + 100u; ++k) {
        const jcal_pair_t pair = failed_acc(&motion, k);
        TEST_ASSERT_TRUE(jcal_hinge_update(&engine, &pair) >= JCAL_OK);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_ACC, result_of(&engine).head.reason);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_stiff_joint_is_never_ready);
    RUN_TEST(both_segments_at_rest_are_never_ready);
    RUN_TEST(one_segment_at_rest_leaves_its_axis_open);
    RUN_TEST(the_other_segment_at_rest_leaves_the_other_axis_open);
    RUN_TEST(zeros_are_never_ready);
    RUN_TEST(a_frozen_sensor_is_never_ready);
    RUN_TEST(white_noise_is_never_ready);
    RUN_TEST(rates_in_degrees_are_never_ready_and_named);
    RUN_TEST(specific_forces_in_g_are_never_ready_and_named);
    RUN_TEST(a_turned_copy_of_the_same_sensor_is_never_ready);
    RUN_TEST(sensors_of_different_recordings_are_never_ready);
    RUN_TEST(rates_clipped_at_a_quarter_of_the_range_are_never_ready);
    RUN_TEST(a_sensor_that_freezes_after_ready_leaves_ready_within_two_seconds);
    RUN_TEST(a_sensor_that_loses_its_accelerometer_leaves_ready);
    return UNITY_END();
}

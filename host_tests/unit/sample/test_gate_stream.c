/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/gate.h: what the stream as a whole shows.
#include "unit/sample/gate_fixture.h"

#define GRAVITY_M_S2 9.81f
#define STEP_S 0.02f

/* Number of samples like `bad` after which the gate complains, or 0 within 1000. */
static uint32_t complains_after(jcal_pair_t (*bad)(void), jcal_reason_t reason)
{
    for (uint32_t k = 1; k <= 1000; ++k) {
        const jcal_pair_t pair = bad();
        (void)check(&pair);
        const jcal_reason_t complaint = jcal_gate_complaint(&gate);
        if (complaint != JCAL_REASON_NONE) {
            TEST_ASSERT_EQUAL_INT(reason, complaint);
            return k;
        }
    }
    return 0;
}

static jcal_pair_t beyond_range(void)
{
    jcal_pair_t pair = good();
    /* Along the specific force, so that turning gravity is not what it is blamed for. */
    pair.imu2.gyr_rad_s = jcal_vec3_scale(pair.imu2.acc_m_s2, 4.0f);
    return pair;
}

static void a_fifth_of_bad_samples_in_two_seconds_is_too_much(void)
{
    accept(200);
    /* 1 - exp(-t / 2 s) > 0.2 from t = 0.446 s on: 22.3 samples. */
    TEST_ASSERT_UINT32_WITHIN(1, 23, complains_after(beyond_range, JCAL_REASON_BAD_SAMPLES));
    /* And it is forgiven: the share falls below 0.2 within a few samples. */
    accept(10);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate));
}

static jcal_pair_t not_a_number(void)
{
    jcal_pair_t pair = good();
    pair.imu1.acc_m_s2.x = NAN;
    return pair;
}

static jcal_pair_t standing_clock(void)
{
    jcal_pair_t pair = good();
    pair.t_us = 1u;
    return pair;
}

static void samples_without_a_believable_time_count_by_their_number(void)
{
    jcal_pair_t (*const bad[2])(void) = {not_a_number, standing_clock};
    for (int i = 0; i < 2; ++i) {
        setUp();
        accept(200);
        /* A fiftieth each: 1 - 0.98^n > 0.2 from n = 11.05 on. */
        TEST_ASSERT_EQUAL_UINT32(12, complains_after(bad[i], JCAL_REASON_BAD_SAMPLES));
    }
}

static jcal_pair_t at_the_stop(void)
{
    jcal_pair_t pair = good();
    pair.imu1.gyr_rad_s.z = -30.0f;
    return pair;
}

static void a_hundredth_of_saturated_samples_in_ten_seconds_is_too_much(void)
{
    accept(600);
    /* The first one is only a peak; 1 - exp(-t / 10 s) > 0.01 from t = 0.1005 s on: 5.03 more. */
    TEST_ASSERT_UINT32_WITHIN(1, 7, complains_after(at_the_stop, JCAL_REASON_BAD_SAMPLES));
}

static jcal_pair_t without_gravity(void)
{
    jcal_pair_t pair = good();
    pair.imu2.acc_m_s2 = jcal_vec3_scale(pair.imu2.acc_m_s2, 0.001f);
    return pair;
}

static jcal_pair_t too_heavy(void)
{
    jcal_pair_t pair = good();
    pair.imu1.acc_m_s2 = jcal_vec3_scale(pair.imu1.acc_m_s2, 100.0f / 9.75f);
    return pair;
}

static void specific_forces_that_cannot_be_gravity_are_wrong_units(void)
{
    accept(300);
    /* |(1, 1, 9.6)| = 9.70: exp(-t / 1 s) < 4 / 9.70 from t = 0.886 s on. */
    TEST_ASSERT_UINT32_WITHIN(2, 45, complains_after(without_gravity, JCAL_REASON_WRONG_UNITS_ACC));
    setUp();
    accept(300);
    /* 9.70 + (99.5 - 9.70)(1 - exp(-t / 1 s)) > 40 from t = 0.411 s on. */
    TEST_ASSERT_UINT32_WITHIN(2, 21, complains_after(too_heavy, JCAL_REASON_WRONG_UNITS_ACC));
}

static void the_first_sample_in_g_is_recognised(void)
{
    jcal_pair_t pair = good();
    pair.imu1.acc_m_s2 = jcal_vec3(0.0f, 0.6f, 0.8f);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&pair));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_ACC, jcal_gate_complaint(&gate));
}

/* A sensor that turns about x with `rate`, whose gyroscope says `scale` times that; gravity lies across x or along it. */
static jcal_reason_t turn_with(float rate, float scale, bool across)
{
    setUp();
    for (uint32_t k = 0; k < 1000; ++k) {
        jcal_pair_t pair = good();
        const float angle = rate * STEP_S * (float)k;
        const float jitter = 0.001f * (float)(k % 3u);
        pair.imu2.gyr_rad_s = jcal_vec3((scale * rate) + jitter, 0.0f, 0.0f);
        pair.imu2.acc_m_s2 = across ? jcal_vec3(0.0f, GRAVITY_M_S2 * sinf(angle), GRAVITY_M_S2 * cosf(angle))
                                    : jcal_vec3(GRAVITY_M_S2 - jitter, 0.0f, 0.0f);
        (void)check(&pair);
    }
    return jcal_gate_complaint(&gate);
}

static void rates_that_turn_gravity_less_than_they_should_are_wrong_units(void)
{
    /* The limit is a fiftieth of the energy: the rate 7.07 times too large. Eight turns of 24 deg take 0.24 s at 14 rad/s, and those of
       the other sensor, at rest, 1 s each. */
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, turn_with(2.0f, 1.0f, true));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, turn_with(2.0f, 6.0f, true));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, turn_with(2.0f, 8.0f, true));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, turn_with(0.4f, 57.3f, true));
}

static void slow_rates_in_degrees_are_noticed_too(void)
{
    /* 0.02 rad/s in deg/s are 1.15 "rad/s": a turn of 24 deg takes 0.36 s, and gravity turns by 0.4 deg in it. */
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, turn_with(0.1f, 57.3f, true));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, turn_with(0.02f, 57.3f, true));
    /* And while nothing turns it is not forgotten. */
    for (uint32_t k = 0; k < 500u; ++k) {
        const jcal_pair_t pair = good();
        (void)check(&pair);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, jcal_gate_complaint(&gate));
}

static void a_turn_about_the_vertical_proves_nothing(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, turn_with(2.0f, 10.0f, false));
}

static void a_missing_accelerometer_goes_before_wrong_rates(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_GYR, turn_with(0.4f, 57.3f, true));
    gate.sensor1.gravity_m_s2 = 1.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_WRONG_UNITS_ACC, jcal_gate_complaint(&gate));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_fifth_of_bad_samples_in_two_seconds_is_too_much);
    RUN_TEST(samples_without_a_believable_time_count_by_their_number);
    RUN_TEST(a_hundredth_of_saturated_samples_in_ten_seconds_is_too_much);
    RUN_TEST(specific_forces_that_cannot_be_gravity_are_wrong_units);
    RUN_TEST(the_first_sample_in_g_is_recognised);
    RUN_TEST(rates_that_turn_gravity_less_than_they_should_are_wrong_units);
    RUN_TEST(slow_rates_in_degrees_are_noticed_too);
    RUN_TEST(a_turn_about_the_vertical_proves_nothing);
    RUN_TEST(a_missing_accelerometer_goes_before_wrong_rates);
    return UNITY_END();
}

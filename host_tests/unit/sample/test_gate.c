/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/gate.h: every cause, its limits, which cause goes first.
#include "unit/sample/gate_fixture.h"

static void good_samples_are_accepted_and_counted(void)
{
    accept(200);
    TEST_ASSERT_EQUAL_UINT32(200, gate.samples);
    for (int c = 0; c < JCAL_REJECT_COUNT; ++c) {
        TEST_ASSERT_EQUAL_UINT32(0, gate.rejected_by[c]);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate));
}

static void an_empty_gate_complains_of_nothing(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate));
}

static void a_value_that_is_not_finite_is_rejected_before_all_else_and_leaves_no_trace(void)
{
    accept(5);
    const jcal_gate_t before = gate;
    for (int field = 0; field < 12; ++field) {
        jcal_pair_t pair = good();
        pair.t_us = 1u; /* time would be wrong too */
        *component(&pair, field) = ((field % 2) == 0) ? NAN : -INFINITY;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NOT_FINITE, check(&pair));
    }
    TEST_ASSERT_EQUAL_UINT32(12, gate.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_MEMORY(&before.sensor1, &gate.sensor1, sizeof gate.sensor1);
    TEST_ASSERT_EQUAL_MEMORY(&before.sensor2, &gate.sensor2, sizeof gate.sensor2);
    TEST_ASSERT_TRUE(before.clock.last_us == gate.clock.last_us);
}

static void readings_beyond_the_limits_are_out_of_range_and_those_at_them_are_not(void)
{
    for (int field = 0; field < 12; ++field) {
        const float limit = is_rate(field) ? config.gyr_max_rad_s : 60.0f;
        config.acc_max_m_s2 = 60.0f; /* so near that the mean stays believable for one sample */
        for (int sign = -1; sign <= 1; sign += 2) {
            jcal_gate_init(&gate);
            accept(50);
            jcal_pair_t pair = good();
            *component(&pair, field) = (float)sign * limit;
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
            pair = good();
            *component(&pair, field) = (float)sign * nextafterf(limit, INFINITY);
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&pair));
        }
    }
}

static void the_first_sample_is_checked_for_range_too(void)
{
    for (int field = 0; field < 12; ++field) {
        jcal_gate_init(&gate);
        jcal_pair_t pair = good();
        *component(&pair, field) = is_rate(field) ? 40.0f : 400.0f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&pair));
    }
    config.acc_max_m_s2 = 20.0f; /* below what gravity may seem to be at first */
    jcal_gate_init(&gate);
    jcal_pair_t pair = good();
    pair.imu2.acc_m_s2 = jcal_vec3(0.0f, -25.0f, 0.0f);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&pair));
}

/* The sensor turns: its largest rate is above what noise at rest can be. */
static void turn(jcal_pair_t *pair, float rate)
{
    pair->imu1.gyr_rad_s.z += rate;
    pair->imu2.gyr_rad_s.z += rate;
}

static void a_component_that_stands_at_its_extreme_while_the_sensor_turns_is_saturated(void)
{
    for (int field = 0; field < 12; ++field) {
        for (int sign = -1; sign <= 1; sign += 2) {
            jcal_gate_init(&gate);
            accept(20);
            const float peak = (float)sign * (is_rate(field) ? 4.0f : 30.0f);
            for (uint32_t k = 0; k < 3; ++k) {
                jcal_pair_t pair = good();
                turn(&pair, 0.3f);
                *component(&pair, field) = peak;
                TEST_ASSERT_EQUAL_INT((k == 0u) ? JCAL_REJECT_NONE : JCAL_REJECT_SATURATED, check(&pair));
            }
            accept(5);
        }
    }
}

static void a_glitch_does_not_hide_what_is_clipped_later(void)
{
    for (int field = 0; field < 12; ++field) {
        for (int samples = 1; samples <= 4; ++samples) { /* one is no range; more fade within two minutes */
            jcal_gate_init(&gate);
            accept(20);
            const float rail = is_rate(field) ? 4.0f : 30.0f;
            for (int k = 0; k < samples; ++k) {
                jcal_pair_t pair = good();
                *component(&pair, field) = (5.0f + (0.1f * (float)k)) * rail;
                turn(&pair, 0.3f);
                (void)check(&pair);
            }
            for (int k = 0; k < ((samples == 1) ? 10 : 6000); ++k) {
                const jcal_pair_t pair = good();
                (void)check(&pair);
            }
            jcal_reject_t cause = JCAL_REJECT_NONE;
            for (int k = 0; k < 3; ++k) {
                jcal_pair_t pair = good();
                turn(&pair, 0.3f);
                *component(&pair, field) = rail;
                cause = check(&pair);
            }
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_SATURATED, cause);
        }
    }
}

static void an_accelerometer_that_is_read_at_a_lower_rate_is_not_clipped(void)
{
    for (uint32_t times = 2; times <= 8; times *= 2u) {
        jcal_gate_init(&gate);
        jcal_imu_t held[2] = {{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}};
        for (uint32_t k = 0; k < 800u; ++k) {
            jcal_pair_t pair = good();
            const float t = STEP_US * 1e-6f * (float)k;
            const float tilt = 0.8f * sinf(2.0f * t);
            pair.imu1.gyr_rad_s.x += 1.6f * cosf(2.0f * t);
            pair.imu2.gyr_rad_s.x += 1.6f * cosf(2.0f * t);
            pair.imu1.acc_m_s2 = jcal_vec3(0.01f * pair.imu1.acc_m_s2.x, 20.0f * sinf(tilt), 20.0f * cosf(tilt));
            pair.imu2.acc_m_s2 = pair.imu1.acc_m_s2;
            held[0] = (k % times == 0u) ? pair.imu1 : held[0];
            held[1] = (k % times == 0u) ? pair.imu2 : held[1];
            pair.imu1.acc_m_s2 = held[0].acc_m_s2;
            pair.imu2.acc_m_s2 = held[1].acc_m_s2;
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
        }
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate));
    }
}

static void null_is_rejected(void)
{
    const jcal_pair_t pair = good();
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NOT_FINITE, jcal_gate_check(NULL, &config, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NOT_FINITE, jcal_gate_check(&gate, NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NOT_FINITE, jcal_gate_check(&gate, &config, NULL));
    TEST_ASSERT_EQUAL_UINT32(0, gate.samples);
    TEST_ASSERT_EQUAL_STRING("config", jcal_gate_config_check(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(NULL));
    jcal_gate_init(NULL);
}

static void a_specific_force_that_stands_while_the_sensor_rests_is_not_clipped(void)
{
    accept(20);
    for (uint32_t k = 0; k < 5; ++k) { /* a coarse reading of gravity */
        jcal_pair_t pair = good();
        pair.imu1.acc_m_s2.z = 10.0f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
}

static void standing_below_the_extreme_or_near_zero_is_not_saturation(void)
{
    jcal_pair_t pair = good();
    pair.imu1.gyr_rad_s.x = 5.0f; /* the extreme so far */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    for (uint32_t k = 0; k < 3; ++k) {
        pair = good();
        pair.imu1.gyr_rad_s.x = 4.99f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
    for (uint32_t k = 0; k < 3; ++k) { /* a coarse sensor at rest repeats its last digit */
        pair = good();
        pair.imu2.gyr_rad_s = jcal_vec3(0.199f, 0.199f, -0.199f);
        pair.imu2.acc_m_s2.x = 1.99f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
}

static void a_whole_reading_that_repeats_is_a_lost_packet_then_frozen(void)
{
    for (int sensor = 0; sensor < 2; ++sensor) {
        jcal_gate_init(&gate);
        accept(20);
        jcal_pair_t pair = good();
        const jcal_pair_t still = pair;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
        uint32_t repeated = 0;
        for (uint32_t k = 1; k <= 30; ++k) {
            pair = good();
            *((sensor == 0) ? &pair.imu1 : &pair.imu2) = (sensor == 0) ? still.imu1 : still.imu2;
            const jcal_reject_t cause = check(&pair);
            repeated += (cause == JCAL_REJECT_REPEATED) ? 1u : 0u;
            TEST_ASSERT_EQUAL_INT((k <= repeated) ? JCAL_REJECT_REPEATED : JCAL_REJECT_FROZEN, cause);
        }
        /* 0.3 s of 0.02 s each; the last one may fall on either side by rounding. */
        TEST_ASSERT_UINT32_WITHIN(1, 15, repeated);
        accept(10);
        pair = good();
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
}

static void one_component_that_moves_is_enough_not_to_be_repeated(void)
{
    accept(20);
    jcal_pair_t pair = good();
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    for (int field = 0; field < 12; ++field) {
        jcal_pair_t next = pair;
        now_us += STEP_US;
        next.t_us = now_us;
        next.imu1.gyr_rad_s.z = 0.001f * (float)field; /* sensor 1 and 2 move in one component each */
        *component(&next, field) -= 0.003f;            /* or in two */
        *component(&next, (field + 6) % 12) -= 0.003f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&next));
        pair = next;
    }
}

static void time_that_does_not_increase_is_rejected_and_the_clock_stays(void)
{
    accept(5);
    const uint64_t last = now_us;
    jcal_pair_t pair = good();
    pair.t_us = last;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, check(&pair));
    pair.t_us = last - 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, check(&pair));
    pair.t_us = last + 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    TEST_ASSERT_EQUAL_UINT32(2, gate.rejected_by[JCAL_REJECT_TIME_ORDER]);
}

static void a_hole_in_time_costs_the_sample_after_it(void)
{
    accept(5);
    now_us += 250000u - STEP_US; /* the longest distance that is still continuous */
    accept(1);
    now_us += 250001u + 1000u - STEP_US;
    jcal_pair_t pair = good();
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_GAP, check(&pair));
    accept(5);
    TEST_ASSERT_EQUAL_UINT32(1, gate.rejected_by[JCAL_REJECT_GAP]);
}

static void the_sample_after_a_hole_is_what_the_next_one_is_compared_with(void)
{
    accept(5);
    now_us += 10000000u;
    const jcal_pair_t after = good();
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_GAP, check(&after));
    jcal_pair_t pair = good();
    pair.imu1 = after.imu1;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_REPEATED, check(&pair));
}

static void one_wild_force_costs_one_sample(void)
{
    accept(50);
    jcal_pair_t wild = good();
    wild.imu2.acc_m_s2.x = -1e6f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&wild));
    accept(50);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate));
    /* What is clipped shows at the range that the sensor has: below 100 m/s^2 of 320. */
    TEST_ASSERT_TRUE(gate.sensor2.extreme[3] < (UINT16_MAX / 3u));
}

static void out_of_range_goes_before_saturated_frozen_and_repeated(void)
{
    accept(20);
    jcal_pair_t wild = good();
    wild.imu1.gyr_rad_s.x = 50.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&wild));
    wild.t_us = good().t_us; /* stands, at its extreme, and repeats */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&wild));
}

static void of_two_sensors_the_worse_cause_counts(void)
{
    for (int sensor = 0; sensor < 2; ++sensor) {
        jcal_gate_init(&gate);
        accept(20);
        const jcal_pair_t last = good();
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&last));
        jcal_pair_t pair = good();
        *((sensor == 0) ? &pair.imu1 : &pair.imu2) = last.imu1; /* both sensors of good() read the same */
        ((sensor == 0) ? &pair.imu2 : &pair.imu1)->gyr_rad_s.x = 50.0f;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&pair));
    }
}

static void every_cause_has_its_name(void)
{
    const char *const names[] = {"not_finite", "out_of_range", "saturated", "frozen",
                                 "repeated",   "time_order",   "gap",       "accepted"};
    for (int c = 0; c <= JCAL_REJECT_NONE; ++c) {
        TEST_ASSERT_EQUAL_STRING(names[c], jcal_reject_string((jcal_reject_t)c));
    }
    TEST_ASSERT_EQUAL_STRING("unknown", jcal_reject_string((jcal_reject_t)(JCAL_REJECT_NONE + 1)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(good_samples_are_accepted_and_counted);
    RUN_TEST(an_empty_gate_complains_of_nothing);
    RUN_TEST(a_value_that_is_not_finite_is_rejected_before_all_else_and_leaves_no_trace);
    RUN_TEST(readings_beyond_the_limits_are_out_of_range_and_those_at_them_are_not);
    RUN_TEST(the_first_sample_is_checked_for_range_too);
    RUN_TEST(a_component_that_stands_at_its_extreme_while_the_sensor_turns_is_saturated);
    RUN_TEST(a_glitch_does_not_hide_what_is_clipped_later);
    RUN_TEST(an_accelerometer_that_is_read_at_a_lower_rate_is_not_clipped);
    RUN_TEST(null_is_rejected);
    RUN_TEST(a_specific_force_that_stands_while_the_sensor_rests_is_not_clipped);
    RUN_TEST(standing_below_the_extreme_or_near_zero_is_not_saturation);
    RUN_TEST(a_whole_reading_that_repeats_is_a_lost_packet_then_frozen);
    RUN_TEST(one_component_that_moves_is_enough_not_to_be_repeated);
    RUN_TEST(time_that_does_not_increase_is_rejected_and_the_clock_stays);
    RUN_TEST(a_hole_in_time_costs_the_sample_after_it);
    RUN_TEST(the_sample_after_a_hole_is_what_the_next_one_is_compared_with);
    RUN_TEST(one_wild_force_costs_one_sample);
    RUN_TEST(out_of_range_goes_before_saturated_frozen_and_repeated);
    RUN_TEST(of_two_sensors_the_worse_cause_counts);
    RUN_TEST(every_cause_has_its_name);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/stream.c: how much each sample counts, docs/METHOD.md section 2, and how much work it pays for.
#include "hinge/stream.h"
#include "hinge/weigh.h"
#include "math/sym.h"
#include "unit/hinge/motion.h"
#include "unity.h"

#include <math.h>
#include <string.h>

enum { SAMPLES = 200 };

/* An hour at 25 Hz; on an emulated target a quarter, which is longer than the ten minutes after which a rest adds nothing. */
#if defined(JCAL_TEST_SHORT)
enum { REST_SAMPLES = 22500 };
#else
enum { REST_SAMPLES = 90000 };
#endif

static const double SUM_TOL = 1e-5; /* 200 float terms of one sign */

static jcal_hinge_t engine;

void setUp(void)
{
    jcal_hinge_config_t config = jcal_hinge_config_default();
    config.lever_arm_m = 2.0f; /* beside the noise, so that both terms count */
    config.acc_noise_m_s2 = 0.7f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
}

void tearDown(void)
{
}

static double square(jcal_vec3_t a, jcal_vec3_t b)
{
    const double x = (double)a.x - (double)b.x;
    const double y = (double)a.y - (double)b.y;
    const double z = (double)a.z - (double)b.z;
    return (x * x) + (y * y) + (z * z);
}

static void the_weight_of_a_specific_force_falls_with_both_rates_and_while_a_pose_lasts(void)
{
    const motion_t motion = motion_lively(5);
    const double dt = 0.02;
    const jcal_vec3_t zero = {0.0f, 0.0f, 0.0f};
    jcal_vec3_t pose1 = zero;
    jcal_vec3_t pose2 = zero;
    double product = 0.0;
    double dwell = 0.0;
    double expected = 0.0;
    int poses = 0;
    for (uint32_t k = 0; k <= SAMPLES; ++k) {
        const jcal_pair_t p = motion_sample(&motion, k);
        jcal_hinge_consume(&engine, &p);
        if (k == 0u) {
            continue; /* stands for no time */
        }
        /* First-order low-pass of 0.2 s of |w1| |w2|, which bounds what (17) of OLS20 leaves out, per metre. */
        const double rates = sqrt(square(p.imu1.gyr_rad_s, zero) * square(p.imu2.gyr_rad_s, zero));
        product += dt / (dt + 0.2) * (rates - product);
        if (square(p.imu1.acc_m_s2, pose1) + square(p.imu2.acc_m_s2, pose2) > 1.0) {
            pose1 = p.imu1.acc_m_s2;
            pose2 = p.imu2.acc_m_s2;
            dwell = 0.0;
            ++poses;
        }
        dwell += dt;
        const double variance = (0.7 * 0.7) + (2.0 * product * 2.0 * product);
        expected += dt / 0.05 / variance / (1.0 + dwell);
    }
    const double sum = (double)engine.coarse.moments.acc[jcal_sym_at(6, 6)];
    TEST_ASSERT_TRUE(fabs(sum - expected) < SUM_TOL * expected);
    TEST_ASSERT_TRUE((poses > 5) && (poses < SAMPLES / 2)); /* both cases were met */
}

static void an_hour_of_rest_weighs_as_much_as_a_few_seconds(void)
{
    motion_t rest = motion_lively(5);
    rest.speed = 0.0;
    rest.joint_speed = 0.0;
    rest.rate_hz = 25.0;
    for (uint32_t k = 0; k <= (uint32_t)REST_SAMPLES; ++k) {
        const jcal_pair_t p = motion_sample(&rest, k);
        jcal_hinge_consume(&engine, &p);
    }
    /* Integral of 1 / (1 + t) over the first 10 s: ln 11 = 2.4 s. */
    const double seconds = (double)engine.coarse.moments.acc[jcal_sym_at(6, 6)] * 0.05 * 0.7 * 0.7;
    TEST_ASSERT_TRUE(fabs(seconds - log(11.0)) < 0.05 * log(11.0));
}

/* Seconds of full weight that the rates of the last pair have got, if all pairs had the same rates. */
static double full_seconds(const jcal_pair_t *p)
{
    const jcal_vec3_t zero = {0.0f, 0.0f, 0.0f};
    const double rates2 = square(p->imu1.gyr_rad_s, zero) + square(p->imu2.gyr_rad_s, zero);
    const double x2 = (double)p->imu1.gyr_rad_s.x * (double)p->imu1.gyr_rad_s.x;
    return (double)engine.coarse.moments.gyr[jcal_sym_at(0, 0)] / (x2 * x2) * 0.05 * 0.03 * 0.03 * (rates2 + 0.05);
}

static void a_rest_of_any_length_weighs_less_than_two_seconds_in_the_rates(void)
{
    jcal_pair_t p = {.imu1.gyr_rad_s = {0.08f, 0.0f, 0.0f},
                     .imu2.gyr_rad_s = {0.0f, -0.08f, 0.02f}}; /* 0.0132 < 0.02 */
    double expected = 0.0;
    for (uint32_t k = 0; k <= (uint32_t)REST_SAMPLES; ++k) {
        const double t = 0.04 * (double)k;
        p.t_us = (uint64_t)k * 40000u;
        jcal_hinge_consume(&engine, &p);
        expected += (k == 0u) ? 0.0 : (0.04 / (1.0 + (t * t)));
        if (k == 250u) { /* 10 s: hundreds of float terms of one sign */
            TEST_ASSERT_TRUE(fabs(full_seconds(&p) - expected) < SUM_TOL * expected);
        }
    }
    /* The integral of 1 / (1 + t^2) is pi / 2 for ever. After ten minutes one more sample is below what float resolves:
       of the true sum the last 1 / 600 s may be missing. */
    TEST_ASSERT_TRUE(fabs(full_seconds(&p) - expected) < 1.0 / 600.0);
    TEST_ASSERT_TRUE(full_seconds(&p) < 0.5 * 3.14159265);
}

static void the_rates_weigh_in_full_again_as_soon_as_a_sensor_turns(void)
{
    jcal_pair_t p = {.imu1.gyr_rad_s = {0.05f, 0.0f, 0.0f}, .imu2.gyr_rad_s = {0.0f, 0.0f, 0.05f}};
    for (uint32_t k = 0; k <= 500u; ++k) {
        p.t_us = (uint64_t)k * 20000u;
        jcal_hinge_consume(&engine, &p);
    }
    memset(&engine.coarse.moments, 0, sizeof engine.coarse.moments);
    p.imu2.gyr_rad_s.x = 0.15f; /* 0.0275 > 0.02 */
    for (uint32_t k = 501; k <= 550u; ++k) {
        p.t_us = (uint64_t)k * 20000u;
        jcal_hinge_consume(&engine, &p);
    }
    TEST_ASSERT_TRUE(fabs(full_seconds(&p) - 1.0) < SUM_TOL); /* 50 samples of 20 ms */
}

static void the_refined_axes_leave_out_what_lies_beyond_a_second_of_rest(void)
{
    const motion_t motion = motion_lively(8);
    motion_t rest = motion;
    rest.speed = 0.0;
    rest.joint_speed = 0.0;
    for (uint32_t k = 0; k < 500u; ++k) {
        const jcal_pair_t p = motion_sample(&motion, k);
        jcal_hinge_consume(&engine, &p);
    }
    const float before_s = engine.refine.time_s;
    TEST_ASSERT_TRUE(before_s > 2.0f);
    for (uint32_t k = 500; k < 2000u; ++k) {
        const jcal_pair_t p = motion_sample(&rest, k);
        jcal_hinge_consume(&engine, &p);
    }
    /* At most the block that was open, 0.6 s, and a second. */
    TEST_ASSERT_TRUE(engine.refine.time_s >= before_s);
    TEST_ASSERT_TRUE(engine.refine.time_s < before_s + 1.6f);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.refine.block.time_s);
}

static void a_sample_stands_for_the_time_since_the_last_one_up_to_a_tenth_of_a_second(void)
{
    const motion_t motion = motion_lively(6);
    const uint64_t steps_us[3] = {10000u, 100000u, 200000u};
    const double stands_for_s[3] = {0.01, 0.1, 0.105};
    for (int i = 0; i < 3; ++i) {
        setUp();
        jcal_pair_t p = motion_sample(&motion, 0);
        jcal_hinge_consume(&engine, &p);
        const uint64_t first = p.t_us;
        p = motion_sample(&motion, 7);
        p.t_us = first + steps_us[i];
        jcal_hinge_consume(&engine, &p);
        const jcal_vec3_t zero = {0.0f, 0.0f, 0.0f};
        const double rates2 = square(p.imu1.gyr_rad_s, zero) + square(p.imu2.gyr_rad_s, zero);
        const double expected = stands_for_s[i] / 0.05 / (0.03 * 0.03 * (rates2 + 0.05));
        const double x2 = (double)p.imu1.gyr_rad_s.x * (double)p.imu1.gyr_rad_s.x; /* the first feature */
        const double sum = (double)engine.coarse.moments.gyr[jcal_sym_at(0, 0)];
        TEST_ASSERT_TRUE(fabs(sum - (expected * x2 * x2)) < SUM_TOL * expected * x2 * x2);
    }
}

/* Slices that 4 s of motion are charged: four times as many once ready; 2 for a judgement, the last of 8, and 3, at most 15 ms, for a
   block that closes. At most 10 slices per sample. Every other cycle may leave the global check out, so that the count repeats
   after 16. */
static double slices_in_four_seconds(double rate_hz)
{
    motion_t motion = motion_lively(7);
    motion.rate_hz = rate_hz;
    const double close = fmin(3.0, 0.015 * (double)engine.cfg.slices_per_s);
    double paid = 0.0;
    for (uint32_t k = 0; k <= (uint32_t)(4.0 * rate_hz); ++k) {
        const uint8_t before = engine.slice;
        const uint32_t price = (engine.verdict.status == (uint8_t)JCAL_READY) ? 4u : 1u;
        const jcal_pair_t p = motion_sample(&motion, k);
        jcal_hinge_consume(&engine, &p);
        const uint32_t done = (engine.slice + 16u - before) % 16u;
        const bool closed = engine.coarse.has_point && !(engine.refine.block.time_s > 0.0f);
        TEST_ASSERT_TRUE(done <= 10u);
        const uint32_t judgements = ((before % 8u) + done) / 8u;
        paid += (double)((done * price) + judgements) + (closed ? close : 0.0);
    }
    return paid;
}

static void the_work_per_second_does_not_depend_on_the_rate(void)
{
    const double rates_hz[4] = {20.0, 25.0, 50.0, 200.0};
    for (int i = 0; i < 4; ++i) {
        setUp();
        /* What is left unpaid, and a slice paid at the old price where the calibration became ready. */
        TEST_ASSERT_TRUE(fabs(slices_in_four_seconds(rates_hz[i]) - 800.0) <= 12.0);
    }
}

static void the_config_says_how_much_work_is_done_per_second(void)
{
    const float slices_per_s[4] = {20.0f, 50.0f, 100.0f, 800.0f};
    for (int i = 0; i < 4; ++i) {
        setUp();
        engine.cfg.slices_per_s = slices_per_s[i];
        TEST_ASSERT_TRUE(fabs(slices_in_four_seconds(200.0) - (4.0 * (double)slices_per_s[i])) <= 12.0);
    }
}

static void with_few_slices_a_step_does_one_or_closes_a_block(void)
{
    const motion_t motion = motion_lively(7);
    uint32_t closed = 0;
    engine.cfg.slices_per_s = 50.0f;
    for (uint32_t k = 0; k < 1000u; ++k) { /* 50 Hz */
        const uint8_t before = engine.slice;
        const float blocks = engine.refine.blocks;
        const jcal_pair_t p = motion_sample(&motion, k);
        jcal_hinge_consume(&engine, &p);
        const uint32_t done = (engine.slice + 16u - before) % 16u;
        const bool closes = engine.refine.blocks > blocks;
        TEST_ASSERT_TRUE(done <= (closes ? 0u : 1u));
        closed += closes ? 1u : 0u;
    }
    TEST_ASSERT_TRUE(closed > 20u); /* 20 s of blocks of 0.2 to 0.6 s */
}

/* Counts 20 s in which sensor 1 turns by 1 rad/s and sensor 2 by `amplitude` more and less, `hz` times a second; returns the excitation
   that the formula gives: the square of the difference beyond 3 % and 0.02 rad/s, while its integral, fading in a second, is above 0.04. */
static double count_trembling(double amplitude, double hz, jcal_hinge_amount_t *amount)
{
    const double dt = 0.005;
    double bend = 0.0;
    double excitation = 0.0;
    *amount = (jcal_hinge_amount_t){0};
    for (int k = 0; k < 4000; ++k) {
        const float rate2 = (float)(1.0 + (amplitude * sin(2.0 * 3.14159265358979 * hz * dt * (double)k)));
        const jcal_hinge_sample_t sample = {.w1_2 = 1.0f, .w2_2 = rate2 * rate2, .dt_s = (float)dt};
        jcal_hinge_count(amount, &sample);
        const double difference = (double)rate2 - 1.0;
        const double excess = fmax(fabs(difference) - (0.03 * fmax((double)rate2, 1.0)) - 0.02, 0.0);
        bend += dt * (((difference > 0.0) ? excess : -excess) - bend);
        excitation += (fabs(bend) > 0.04) ? dt * excess * excess : 0.0;
    }
    return excitation;
}

static void a_joint_that_trembles_has_not_moved(void)
{
    jcal_hinge_amount_t amount;
    TEST_ASSERT_EQUAL_FLOAT(0.0f, (float)count_trembling(0.9, 12.0, &amount));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, amount.excitation);
    TEST_ASSERT_TRUE(amount.motion > 20.0f);
    const double hz[4] = {0.1, 0.5, 1.0, 2.0}; /* with what of it bends the joint far enough */
    for (int i = 0; i < 4; ++i) {
        const double expected = count_trembling(0.7, hz[i], &amount);
        TEST_ASSERT_TRUE(expected > 0.03);
        TEST_ASSERT_TRUE(fabs((double)amount.excitation - expected) < 1e-3 * expected);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_weight_of_a_specific_force_falls_with_both_rates_and_while_a_pose_lasts);
    RUN_TEST(an_hour_of_rest_weighs_as_much_as_a_few_seconds);
    RUN_TEST(a_rest_of_any_length_weighs_less_than_two_seconds_in_the_rates);
    RUN_TEST(the_rates_weigh_in_full_again_as_soon_as_a_sensor_turns);
    RUN_TEST(the_refined_axes_leave_out_what_lies_beyond_a_second_of_rest);
    RUN_TEST(a_sample_stands_for_the_time_since_the_last_one_up_to_a_tenth_of_a_second);
    RUN_TEST(the_work_per_second_does_not_depend_on_the_rate);
    RUN_TEST(the_config_says_how_much_work_is_done_per_second);
    RUN_TEST(with_few_slices_a_step_does_one_or_closes_a_block);
    RUN_TEST(a_joint_that_trembles_has_not_moved);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of sample/kinematics.h: K against the simulated motion, bins, chains, derivatives, smoothing.
#include "sample/kinematics.h"
#include "unit/center/motion.h"

#include <string.h>
#include <unity.h>

static const jcal_kinematics_config_t FIVE_POINT = {JCAL_DERIVATIVE_FIVE_POINT, 0.0f};
static const jcal_kinematics_config_t SYMMETRIC = {JCAL_DERIVATIVE_SYMMETRIC, 0.0f};
static const jcal_kinematics_config_t SMOOTHED = {JCAL_DERIVATIVE_FIVE_POINT, 0.4f};

static jcal_kinematics_t chain;

void setUp(void)
{
    jcal_kinematics_begin(&chain);
}

void tearDown(void)
{
}

/* Feeds samples from `from` until one comes out or `count` are in; the number fed. */
static uint32_t feed(const center_motion_t *m, uint32_t from, uint32_t count, const jcal_kinematics_config_t *cfg,
                     jcal_kinematic_t *out)
{
    for (uint32_t k = 0; k < count; ++k) {
        const jcal_pair_t pair = center_sample(m, from + k);
        if (jcal_kinematics_put(&chain, cfg, &pair, NULL, out)) {
            return k + 1u;
        }
    }
    return 0u;
}

static jcal_vec3_t single(const double *v)
{
    return jcal_vec3((float)v[0], (float)v[1], (float)v[2]);
}

/* What a body feels at the joint. */
static jcal_vec3_t at_joint(const jcal_segment_t *body, const double *r)
{
    return jcal_vec3_sub(body->a, jcal_segment_times(body, single(r)));
}

/* Largest difference of what both feel at the joint, in length, over 10 s of exact readings, every `lost`th one missing. */
static double residual(const jcal_kinematics_config_t *cfg, double rate_hz, uint32_t lost)
{
    center_motion_t m = center_lively(1);
    m.noise = 0.0;
    m.rate_hz = rate_hz;
    double worst = 0.0;
    int seen = 0;
    jcal_kinematics_begin(&chain);
    for (uint32_t k = 0; k < (uint32_t)(10.0 * rate_hz); ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        jcal_kinematic_t s;
        if ((k % lost != lost - 1u) && jcal_kinematics_put(&chain, cfg, &pair, NULL, &s)) {
            const float n1 = jcal_vec3_norm(at_joint(&s.body1, m.r1));
            const float n2 = jcal_vec3_norm(at_joint(&s.body2, m.r2));
            worst = fmax(worst, fabs((double)n1 - (double)n2));
            ++seen;
        }
    }
    TEST_ASSERT_GREATER_THAN_INT(20, seen);
    return worst;
}

#define NONE_LOST 100000u

static void the_joint_feels_the_same_from_both_sides(void)
{
    /* K r reaches 3 m/s^2 in this motion */
    TEST_ASSERT_TRUE(residual(&FIVE_POINT, 50.0, NONE_LOST) < 0.01);
    TEST_ASSERT_TRUE(residual(&SYMMETRIC, 50.0, NONE_LOST) < 0.15);
    TEST_ASSERT_TRUE(residual(&SMOOTHED, 50.0, NONE_LOST) < 0.003);
    TEST_ASSERT_TRUE(residual(&SMOOTHED, 200.0, NONE_LOST) <
                     0.03); /* K of the mean rate of a bin instead of the mean of K */
    TEST_ASSERT_TRUE(residual(&SMOOTHED, 25.0, NONE_LOST) < 0.05);
}

static void lost_samples_are_missing_on_both_sides(void)
{
    TEST_ASSERT_TRUE(residual(&SMOOTHED, 50.0, 37u) < 0.1);
}

static void the_order_of_the_derivatives_shows(void)
{
    TEST_ASSERT_TRUE(residual(&FIVE_POINT, 50.0, NONE_LOST) < 0.2 * residual(&SYMMETRIC, 50.0, NONE_LOST));
    TEST_ASSERT_TRUE(residual(&SYMMETRIC, 50.0, NONE_LOST) > 1e-3);
}

static void in_earth_frames_vectors_agree(void)
{
    for (int smooth = 0; smooth < 2; ++smooth) {
        center_motion_t m = center_lively(2);
        m.noise = 0.0;
        jcal_kinematics_begin(&chain);
        int seen = 0;
        for (uint32_t k = 0; k < 300u; ++k) {
            const jcal_pair_t pair = center_sample(&m, k);
            const double t_s = (double)k / m.rate_hz;
            jcal_attitudes_t attitudes = {pose_single(center_orientation(&m, 1, t_s)),
                                          pose_single(center_orientation(&m, 2, t_s))};
            if (k % 2u == 0u) { /* the same orientation */
                attitudes.q1 = jcal_quat(-attitudes.q1.w, -attitudes.q1.x, -attitudes.q1.y, -attitudes.q1.z);
            }
            jcal_kinematic_t s;
            if (jcal_kinematics_put(&chain, (smooth == 1) ? &SMOOTHED : &FIVE_POINT, &pair, &attitudes, &s)) {
                const jcal_vec3_t d = jcal_vec3_sub(at_joint(&s.body1, m.r1), at_joint(&s.body2, m.r2));
                TEST_ASSERT_TRUE(jcal_vec3_norm(d) < 0.02f);
                ++seen;
            }
        }
        TEST_ASSERT_GREATER_THAN_INT(20, seen);
    }
}

static void biases_turn_with_their_sensor(void)
{
    center_motion_t m = center_lively(3);
    m.noise = 0.0;
    center_motion_t biased = m;
    biased.bias1[0] = 0.3;
    biased.bias1[2] = -0.2;
    jcal_kinematics_t other;
    jcal_kinematics_begin(&other);
    int seen = 0;
    for (uint32_t k = 0; k < 300u; ++k) {
        const jcal_pair_t a = center_sample(&m, k);
        const jcal_pair_t b = center_sample(&biased, k);
        jcal_kinematic_t s;
        jcal_kinematic_t t;
        const bool has = jcal_kinematics_put(&chain, &SMOOTHED, &a, NULL, &s);
        TEST_ASSERT_EQUAL_INT(has, jcal_kinematics_put(&other, &SMOOTHED, &b, NULL, &t));
        if (has) {
            const jcal_vec3_t expected = jcal_segment_turn(&s.body1, jcal_vec3(0.3f, 0.0f, -0.2f));
            TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(jcal_vec3_sub(t.body1.a, s.body1.a), expected)) < 1e-4f);
            TEST_ASSERT_TRUE(jcal_vec3_norm(expected) < 0.3606f); /* no longer than the bias: a mean of turned ones */
            ++seen;
        }
    }
    TEST_ASSERT_GREATER_THAN_INT(20, seen);
}

/* Turning fast about one axis in gravity that does not turn: in frames that do not turn it stays where it was. */
static void frames_that_do_not_turn_stay_for_a_second_of_fast_motion(void)
{
    const double rate = 14.0, dt = 0.02;
    jcal_kinematic_t out;
    jcal_vec3_t begin = {0.0f, 0.0f, 0.0f};
    int count = 0;
    jcal_kinematics_begin(&chain);
    for (int k = 0; k < 60; ++k) {
        const double angle = rate * dt * k;
        const jcal_imu_t imu = {jcal_vec3(0.0f, 0.0f, (float)rate),
                                jcal_vec3((float)(9.81 * cos(angle)), (float)(-9.81 * sin(angle)), 0.0f)};
        const jcal_pair_t pair = {(uint64_t)(k * 20000 + 1000), imu, imu};
        if (jcal_kinematics_put(&chain, &SMOOTHED, &pair, NULL, &out)) {
            begin = (count == 0) ? out.body1.a : begin;
            TEST_ASSERT_FLOAT_WITHIN(0.01f, begin.x, out.body1.a.x); /* 1 mrad */
            TEST_ASSERT_FLOAT_WITHIN(0.01f, begin.y, out.body1.a.y);
            TEST_ASSERT_FLOAT_WITHIN(0.01f, begin.y, out.body2.a.y);
            ++count;
        }
    }
    TEST_ASSERT_TRUE(count >= 4);
}

/* q and -q are the same orientation, and filters may send either. */
static void the_sign_of_an_orientation_does_not_matter(void)
{
    const center_motion_t m = center_lively(2);
    jcal_kinematic_t with, without;
    jcal_kinematics_t other;
    jcal_kinematics_begin(&chain);
    jcal_kinematics_begin(&other);
    int count = 0;
    for (uint32_t k = 0; k < 200u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        pair.t_us = (uint64_t)k * 10000u; /* two samples a bin */
        const jcal_quat_t q = jcal_quat_normalise(jcal_quat(0.3f, 0.5f, -0.7f, 0.4f));
        const jcal_attitudes_t one = {q, q};
        const jcal_attitudes_t two = {((k % 2u) == 0u) ? q : jcal_quat(-q.w, -q.x, -q.y, -q.z), q};
        const bool made = jcal_kinematics_put(&chain, &FIVE_POINT, &pair, &one, &without);
        TEST_ASSERT_EQUAL_INT(made, jcal_kinematics_put(&other, &FIVE_POINT, &pair, &two, &with));
        if (made) {
            TEST_ASSERT_FLOAT_WITHIN(1e-4f, without.body1.a.x, with.body1.a.x);
            TEST_ASSERT_FLOAT_WITHIN(1e-4f, without.body1.a.y, with.body1.a.y);
            TEST_ASSERT_FLOAT_WITHIN(1e-4f, without.body1.a.z, with.body1.a.z);
            ++count;
        }
    }
    TEST_ASSERT_TRUE(count > 50);
}

static void k_is_what_cross_products_say(void)
{
    /* 50 Hz, rates that grow evenly: the derivative is exact, and nothing is smoothed */
    const jcal_vec3_t w = {1.0f, -2.0f, 0.5f};
    const jcal_vec3_t dw = {3.0f, 4.0f, -5.0f};
    const jcal_vec3_t r = {0.3f, 0.1f, -0.2f};
    jcal_kinematic_t s = {0};
    for (int k = -3; k <= 2; ++k) {
        jcal_pair_t pair;
        memset(&pair, 0, sizeof pair);
        pair.t_us = UINT64_C(1000000) + ((uint64_t)(k + 3) * 20000u) - 60000u;
        pair.imu2.gyr_rad_s = jcal_vec3_add(w, jcal_vec3_scale(dw, 0.02f * (float)k));
        pair.imu2.acc_m_s2 = jcal_vec3(0.0f, 0.0f, (float)k);
        TEST_ASSERT_EQUAL_INT(k == 2, jcal_kinematics_put(&chain, &FIVE_POINT, &pair, NULL, &s));
    }
    const jcal_vec3_t expected = jcal_vec3_add(jcal_vec3_cross(dw, r), jcal_vec3_cross(w, jcal_vec3_cross(w, r)));
    const jcal_vec3_t got = jcal_segment_times(&s.body2, r);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected.x, got.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected.y, got.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected.z, got.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 5.25f, s.body2.rate2);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, s.body2.a.z);
    TEST_ASSERT_TRUE(s.t_us == 1000000u);
    const jcal_vec3_t b = jcal_segment_turn(&s.body2, r);
    TEST_ASSERT_EQUAL_FLOAT(r.y, b.y);
}

static void bins_last_about_20_ms_at_any_rate(void)
{
    const struct {
        double rate_hz;
        double bin_s;
    } cases[] = {{25.0, 0.04},  {50.0, 0.02},  {60.0, 1.0 / 60.0}, {80.0, 0.025},
                 {100.0, 0.02}, {200.0, 0.02}, {400.0, 0.02}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        center_motion_t m = center_lively(2);
        m.rate_hz = cases[i].rate_hz;
        jcal_kinematic_t s;
        jcal_kinematics_begin(&chain);
        const uint32_t fed = feed(&m, 0, 200, &FIVE_POINT, &s);
        /* the first sample only sets the distance, then five bins */
        TEST_ASSERT_EQUAL_UINT32(1u + (uint32_t)lround(5.0 * cases[i].bin_s * cases[i].rate_hz), fed);
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, (float)cases[i].bin_s, s.dt_s);
    }
}

static void a_smoothed_sample_comes_once_per_block(void)
{
    const center_motion_t m = center_lively(2);
    jcal_kinematic_t s;
    /* five bins, of which the last four are one middle each, then four blocks of five bins: 0.4 s */
    TEST_ASSERT_EQUAL_UINT32(1u + 4u + 20u, feed(&m, 0, 200, &SMOOTHED, &s));
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.1f, s.dt_s);
    TEST_ASSERT_EQUAL_UINT32(5u, feed(&m, 25, 200, &SMOOTHED, &s));
    TEST_ASSERT_TRUE(s.t_us == center_sample(&m, 27).t_us);
}

static void a_result_belongs_to_the_middle_bin(void)
{
    center_motion_t m = center_lively(3);
    m.rate_hz = 100.0;
    jcal_kinematic_t s;
    const uint32_t fed = feed(&m, 0, 200, &FIVE_POINT, &s);
    TEST_ASSERT_TRUE(s.t_us == center_sample(&m, fed - 1u).t_us - 40000u); /* two bins back */
}

static void a_hole_begins_a_new_chain(void)
{
    center_motion_t m = center_lively(4);
    jcal_kinematic_t s;
    TEST_ASSERT_EQUAL_UINT32(6u, feed(&m, 0, 20, &FIVE_POINT, &s));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&m, 6, 1, &FIVE_POINT, &s));  /* sample by sample from here on */
    TEST_ASSERT_EQUAL_UINT32(6u, feed(&m, 8, 20, &FIVE_POINT, &s)); /* one was lost */
}

static void a_distance_that_is_too_short_begins_a_new_chain(void)
{
    uint64_t t_us = 0u;
    uint32_t seen = 0u;
    for (uint32_t k = 0; k < 18u;
         ++k) { /* seven samples at 50 Hz, then 100 Hz: one sets the distance, five bins of two follow */
        jcal_pair_t pair;
        jcal_kinematic_t s;
        memset(&pair, 0, sizeof pair);
        pair.t_us = t_us;
        const bool has = jcal_kinematics_put(&chain, &FIVE_POINT, &pair, NULL, &s);
        TEST_ASSERT_EQUAL_INT((k == 5u) || (k == 6u) || (k == 17u), has);
        seen += has ? 1u : 0u;
        t_us += (k < 6u) ? 20000u : 10000u;
    }
    TEST_ASSERT_EQUAL_UINT32(3u, seen);
}

static void blocks_bridge_a_short_hole_and_no_long_one(void)
{
    const center_motion_t m = center_lively(4);
    jcal_kinematic_t s;
    TEST_ASSERT_EQUAL_UINT32(25u, feed(&m, 0, 40, &SMOOTHED, &s));
    TEST_ASSERT_EQUAL_UINT32(
        5u + 5u, feed(&m, 26, 40, &SMOOTHED, &s)); /* five bins to begin with, the last one counts already */
    TEST_ASSERT_EQUAL_UINT32(25u, feed(&m, 60, 40, &SMOOTHED, &s));
}

static void a_hole_that_32_bits_do_not_see_is_a_hole(void)
{
    /* 2^32 us and one sample later the low halves of the times go on as if nothing had been. */
    const uint64_t holes[] = {1ull << 32, (1ull << 32) + 100000u, 3ull << 32, 1ull << 40};
    const center_motion_t m = center_lively(4);
    for (int i = 0; i < 4; ++i) {
        jcal_kinematic_t s;
        jcal_kinematics_begin(&chain);
        TEST_ASSERT_EQUAL_UINT32(25u, feed(&m, 0, 40, &SMOOTHED, &s));
        uint32_t fed = 0u;
        bool has = false;
        while (!has && (fed < 60u)) {
            jcal_pair_t pair = center_sample(&m, 25u + fed);
            pair.t_us += holes[i];
            has = jcal_kinematics_put(&chain, &SMOOTHED, &pair, NULL, &s);
            ++fed;
        }
        TEST_ASSERT_EQUAL_UINT32(25u, fed); /* as from the beginning */
    }
}

static void jitter_is_no_hole(void)
{
    const center_motion_t m = center_lively(5);
    uint32_t out = 0;
    for (uint32_t k = 0; k < 100u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        pair.t_us += (k % 3u) * 2000u;
        jcal_kinematic_t s;
        out += jcal_kinematics_put(&chain, &FIVE_POINT, &pair, NULL, &s) ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT32(100u - 5u, out);
}

static void frames_follow_a_fast_even_turn(void)
{
    /* 8 rad/s about z: 0.16 rad from bin to bin, four blocks of five, each the mean of its cosines and sines */
    const double weights[4] = {0.125, 0.375, 0.375, 0.125};
    double cosine = 0.0;
    double sine = 0.0;
    for (int k = 0; k < 20; ++k) {
        cosine += 0.2 * weights[k / 5] * cos(0.16 * k);
        sine += 0.2 * weights[k / 5] * sin(0.16 * k);
    }
    jcal_kinematic_t s = {0};
    bool has = false;
    for (uint32_t k = 0; (k < 40u) && !has; ++k) {
        jcal_pair_t pair;
        memset(&pair, 0, sizeof pair);
        pair.t_us = UINT64_C(20000) * (uint64_t)k;
        pair.imu1.gyr_rad_s.z = 8.0f;
        pair.imu2.gyr_rad_s.z = -4.0f;
        has = jcal_kinematics_put(&chain, &SMOOTHED, &pair, NULL, &s);
    }
    TEST_ASSERT_TRUE(has);
    TEST_ASSERT_FLOAT_WITHIN(2e-5f, (float)cosine, s.body1.turn[0].x);
    TEST_ASSERT_FLOAT_WITHIN(2e-5f, (float)sine, s.body1.turn[0].y);
    TEST_ASSERT_FLOAT_WITHIN(2e-5f, 1.0f, s.body1.turn[2].z);
    TEST_ASSERT_TRUE(s.body2.turn[0].y < -0.1f); /* the other way round */
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 64.0f, s.body1.rate2);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 16.0f, s.body2.rate2);
}

static void an_orientation_and_its_negative_in_one_bin_are_the_same(void)
{
    const jcal_quat_t q = pose_single(pose_any(3));
    const jcal_vec3_t force = {1.0f, -2.0f, 9.0f};
    const jcal_vec3_t expected = jcal_quat_rotate(q, force);
    jcal_kinematic_t s = {0};
    bool has = false;
    for (uint32_t k = 0; (k < 40u) && !has; ++k) { /* 200 Hz: four in a bin */
        const float sign = ((k % 2u) == 0u) ? 1.0f : -1.0f;
        const jcal_quat_t same = jcal_quat(sign * q.w, sign * q.x, sign * q.y, sign * q.z);
        const jcal_attitudes_t attitudes = {same, q};
        const jcal_pair_t pair = {
            UINT64_C(5000) * (uint64_t)k, {{0.0f, 0.0f, 0.0f}, force}, {{0.0f, 0.0f, 0.0f}, force}};
        has = jcal_kinematics_put(&chain, &FIVE_POINT, &pair, &attitudes, &s);
    }
    TEST_ASSERT_TRUE(has);
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(s.body1.a, expected)) < 1e-5f);
    TEST_ASSERT_TRUE(jcal_vec3_norm(jcal_vec3_sub(s.body2.a, expected)) < 1e-5f);
}

static void bins_are_as_far_apart_as_their_middles(void)
{
    /* 100 Hz, two in a bin; the last sample 4 ms late moves the middle of its bin by 2 ms, 80 ms after that of the first */
    jcal_kinematic_t s = {0};
    for (uint32_t k = 0; k < 11u; ++k) {
        jcal_pair_t pair;
        memset(&pair, 0, sizeof pair);
        pair.t_us = (UINT64_C(10000) * (uint64_t)k) + ((k == 10u) ? 4000u : 0u);
        TEST_ASSERT_EQUAL_INT(k == 10u, jcal_kinematics_put(&chain, &FIVE_POINT, &pair, NULL, &s));
    }
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 0.082f / 4.0f, s.dt_s);
}

static void smoothing_lowers_the_noise_of_the_residual(void)
{
    double power[2] = {0.0, 0.0};
    center_motion_t m = center_lively(6);
    m.noise = 0.05;
    center_motion_t quiet = m;
    quiet.noise = 0.0;
    for (int which = 0; which < 2; ++which) {
        const jcal_kinematics_config_t *const cfg = (which == 0) ? &SMOOTHED : &FIVE_POINT;
        jcal_kinematics_t noisy_chain;
        jcal_kinematics_begin(&noisy_chain);
        jcal_kinematics_begin(&chain);
        int count = 0;
        for (uint32_t k = 0; k < 1000u; ++k) {
            const jcal_pair_t noisy = center_sample(&m, k);
            const jcal_pair_t exact = center_sample(&quiet, k);
            jcal_kinematic_t a;
            jcal_kinematic_t b;
            const bool has_a = jcal_kinematics_put(&noisy_chain, cfg, &noisy, NULL, &a);
            TEST_ASSERT_EQUAL_INT(has_a, jcal_kinematics_put(&chain, cfg, &exact, NULL, &b));
            if (has_a) {
                const double e =
                    (double)jcal_vec3_norm(at_joint(&a.body1, m.r1)) - (double)jcal_vec3_norm(at_joint(&b.body1, m.r1));
                power[which] += e * e;
                ++count;
            }
        }
        power[which] /= count;
    }
    /* (1, 3, 3, 1)/8 over blocks of 5: 5/16 of a fifth of the power of white noise, and less of a derivative's */
    TEST_ASSERT_TRUE(power[0] < 0.08 * power[1]);
}

static void a_bin_takes_64_samples_at_most(void)
{
    center_motion_t m = center_lively(1);
    m.rate_hz = 8000.0; /* 160 would fit into 20 ms */
    jcal_kinematic_t out;
    TEST_ASSERT_EQUAL_UINT32(1u + 5u * 64u, feed(&m, 0u, 1000u, &FIVE_POINT, &out));
    jcal_kinematics_begin(&chain);
    m.rate_hz = 20.0; /* ... and one at least */
    TEST_ASSERT_EQUAL_UINT32(1u + 5u, feed(&m, 0u, 1000u, &FIVE_POINT, &out));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_joint_feels_the_same_from_both_sides);
    RUN_TEST(lost_samples_are_missing_on_both_sides);
    RUN_TEST(the_order_of_the_derivatives_shows);
    RUN_TEST(in_earth_frames_vectors_agree);
    RUN_TEST(biases_turn_with_their_sensor);
    RUN_TEST(frames_that_do_not_turn_stay_for_a_second_of_fast_motion);
    RUN_TEST(the_sign_of_an_orientation_does_not_matter);
    RUN_TEST(k_is_what_cross_products_say);
    RUN_TEST(bins_last_about_20_ms_at_any_rate);
    RUN_TEST(a_smoothed_sample_comes_once_per_block);
    RUN_TEST(a_result_belongs_to_the_middle_bin);
    RUN_TEST(a_hole_begins_a_new_chain);
    RUN_TEST(a_distance_that_is_too_short_begins_a_new_chain);
    RUN_TEST(blocks_bridge_a_short_hole_and_no_long_one);
    RUN_TEST(a_hole_that_32_bits_do_not_see_is_a_hole);
    RUN_TEST(jitter_is_no_hole);
    RUN_TEST(frames_follow_a_fast_even_turn);
    RUN_TEST(an_orientation_and_its_negative_in_one_bin_are_the_same);
    RUN_TEST(bins_are_as_far_apart_as_their_middles);
    RUN_TEST(smoothing_lowers_the_noise_of_the_residual);
    RUN_TEST(a_bin_takes_64_samples_at_most);
    return UNITY_END();
}

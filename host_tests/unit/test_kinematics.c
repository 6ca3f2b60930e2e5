/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of sample/kinematics.h: K against the simulated motion, bins, chains, the three derivatives.
#include "center_motion.h"
#include "sample/kinematics.h"

#include <string.h>
#include <unity.h>

static jcal_kinematics_t chain;

void setUp(void)
{
    jcal_kinematics_begin(&chain);
}

void tearDown(void)
{
}

/* Feeds samples from `from` until one comes out or `count` are in; the number fed. */
static uint32_t feed(const center_motion_t *m, uint32_t from, uint32_t count, jcal_derivative_t derivative,
                     jcal_kinematic_t *out)
{
    for (uint32_t k = 0; k < count; ++k) {
        const jcal_pair_t pair = center_sample(m, from + k);
        if (jcal_kinematics_put(&chain, derivative, &pair, NULL, out)) {
            return k + 1u;
        }
    }
    return 0u;
}

/* Largest | a1 - K1 r1 | - | a2 - K2 r2 | over 2 s of exact readings: what the derivative leaves. */
static double residual(jcal_derivative_t derivative, double rate_hz)
{
    center_motion_t m = center_lively(1);
    m.noise = 0.0;
    m.rate_hz = rate_hz;
    const jcal_vec3_t r1 = {(float)m.r1[0], (float)m.r1[1], (float)m.r1[2]};
    const jcal_vec3_t r2 = {(float)m.r2[0], (float)m.r2[1], (float)m.r2[2]};
    double worst = 0.0;
    jcal_kinematics_begin(&chain);
    for (uint32_t k = 0; k < (uint32_t)(2.0 * rate_hz); ++k) {
        const jcal_pair_t pair = center_sample(&m, k);
        jcal_kinematic_t s;
        if (jcal_kinematics_put(&chain, derivative, &pair, NULL, &s)) {
            const float n1 = jcal_vec3_norm(jcal_vec3_sub(s.body1.a, jcal_body_times(&s.body1, r1)));
            const float n2 = jcal_vec3_norm(jcal_vec3_sub(s.body2.a, jcal_body_times(&s.body2, r2)));
            worst = fmax(worst, fabs((double)n1 - (double)n2));
        }
    }
    return worst;
}

static void the_joint_feels_the_same_from_both_sides(void)
{
    /* K r reaches 3 m/s^2 in this motion */
    TEST_ASSERT_TRUE(residual(JCAL_DERIVATIVE_FIVE_POINT, 50.0) < 0.01);
    TEST_ASSERT_TRUE(residual(JCAL_DERIVATIVE_SMOOTHED, 50.0) < 0.02);
    TEST_ASSERT_TRUE(residual(JCAL_DERIVATIVE_SYMMETRIC, 50.0) < 0.1);
    TEST_ASSERT_TRUE(residual(JCAL_DERIVATIVE_SMOOTHED, 200.0) < 0.02);
}

static void the_order_of_the_derivatives_shows(void)
{
    TEST_ASSERT_TRUE(residual(JCAL_DERIVATIVE_FIVE_POINT, 50.0) < 0.2 * residual(JCAL_DERIVATIVE_SYMMETRIC, 50.0));
    TEST_ASSERT_TRUE(residual(JCAL_DERIVATIVE_SYMMETRIC, 50.0) > 1e-3);
}

static void k_is_what_cross_products_say(void)
{
    /* 50 Hz, rates that grow evenly: the derivative is exact, and nothing is smoothed */
    const jcal_vec3_t w = {1.0f, -2.0f, 0.5f};
    const jcal_vec3_t dw = {3.0f, 4.0f, -5.0f};
    const jcal_vec3_t r = {0.3f, 0.1f, -0.2f};
    jcal_kinematic_t s = {0};
    for (int k = -4; k <= 3; ++k) {
        jcal_pair_t pair;
        memset(&pair, 0, sizeof pair);
        pair.t_us = (uint64_t)(1000000 + (k * 20000));
        pair.imu2.gyr_rad_s = jcal_vec3_add(w, jcal_vec3_scale(dw, 0.02f * (float)k));
        pair.imu2.acc_m_s2 = jcal_vec3(0.0f, 0.0f, (float)k);
        TEST_ASSERT_EQUAL_INT(k == 3, jcal_kinematics_put(&chain, JCAL_DERIVATIVE_FIVE_POINT, &pair, NULL, &s));
    }
    const jcal_vec3_t expected = jcal_vec3_add(jcal_vec3_cross(dw, r), jcal_vec3_cross(w, jcal_vec3_cross(w, r)));
    const jcal_vec3_t got = jcal_body_times(&s.body2, r);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected.x, got.x);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected.y, got.y);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, expected.z, got.z);
    TEST_ASSERT_FLOAT_WITHIN(1e-6f, 5.25f, s.body2.rate2);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, s.body2.a.z);
    TEST_ASSERT_EQUAL_UINT64(1000000u, s.t_us);
}

static void bins_last_about_20_ms_at_any_rate(void)
{
    const struct {
        double rate_hz;
        double bin_s;
    } cases[] = {{25.0, 0.04}, {50.0, 0.02}, {60.0, 1.0 / 60.0}, {100.0, 0.02}, {200.0, 0.02}, {400.0, 0.02}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        center_motion_t m = center_lively(2);
        m.rate_hz = cases[i].rate_hz;
        jcal_kinematic_t s;
        jcal_kinematics_begin(&chain);
        const uint32_t fed = feed(&m, 0, 200, JCAL_DERIVATIVE_SMOOTHED, &s);
        /* the first sample only sets the distance, then seven bins */
        TEST_ASSERT_EQUAL_UINT32(1u + (uint32_t)lround(7.0 * cases[i].bin_s * cases[i].rate_hz), fed);
        TEST_ASSERT_FLOAT_WITHIN(2e-6f, (float)cases[i].bin_s, s.dt_s);
    }
}

static void a_result_belongs_to_the_middle_bin(void)
{
    center_motion_t m = center_lively(3);
    m.rate_hz = 100.0;
    jcal_kinematic_t s;
    const uint32_t fed = feed(&m, 0, 200, JCAL_DERIVATIVE_FIVE_POINT, &s);
    const uint64_t last_us = center_sample(&m, fed - 1u).t_us;
    TEST_ASSERT_EQUAL_UINT64(last_us - 5000u - 60000u + 5000u,
                             s.t_us); /* three bins back, from the end of a bin to its end */
}

static void a_hole_begins_a_new_chain(void)
{
    center_motion_t m = center_lively(4);
    jcal_kinematic_t s;
    TEST_ASSERT_EQUAL_UINT32(8u, feed(&m, 0, 20, JCAL_DERIVATIVE_SMOOTHED, &s));
    TEST_ASSERT_EQUAL_UINT32(1u, feed(&m, 8, 1, JCAL_DERIVATIVE_SMOOTHED, &s));   /* sample by sample from here on */
    TEST_ASSERT_EQUAL_UINT32(8u, feed(&m, 10, 20, JCAL_DERIVATIVE_SMOOTHED, &s)); /* one was lost */
}

static void jitter_is_no_hole(void)
{
    const center_motion_t m = center_lively(5);
    uint32_t out = 0;
    for (uint32_t k = 0; k < 100u; ++k) {
        jcal_pair_t pair = center_sample(&m, k);
        pair.t_us += (k % 3u) * 2000u;
        jcal_kinematic_t s;
        out += jcal_kinematics_put(&chain, JCAL_DERIVATIVE_SMOOTHED, &pair, NULL, &s) ? 1u : 0u;
    }
    TEST_ASSERT_EQUAL_UINT32(100u - 7u, out);
}

static void smoothing_lowers_the_noise_of_the_residual(void)
{
    center_motion_t m = center_lively(6);
    m.noise = 0.05;
    const jcal_vec3_t r1 = {(float)m.r1[0], (float)m.r1[1], (float)m.r1[2]};
    double square[2] = {0.0, 0.0};
    for (int which = 0; which < 2; ++which) {
        const jcal_derivative_t derivative = (which == 0) ? JCAL_DERIVATIVE_SMOOTHED : JCAL_DERIVATIVE_FIVE_POINT;
        center_motion_t quiet = m;
        quiet.noise = 0.0;
        jcal_kinematics_t noisy_chain;
        jcal_kinematics_begin(&noisy_chain);
        jcal_kinematics_begin(&chain);
        for (uint32_t k = 0; k < 200u; ++k) {
            const jcal_pair_t noisy = center_sample(&m, k);
            const jcal_pair_t exact = center_sample(&quiet, k);
            jcal_kinematic_t a;
            jcal_kinematic_t b;
            const bool has_a = jcal_kinematics_put(&noisy_chain, derivative, &noisy, NULL, &a);
            const bool has_b = jcal_kinematics_put(&chain, derivative, &exact, NULL, &b);
            TEST_ASSERT_EQUAL_INT(has_a, has_b);
            if (has_a) {
                const jcal_vec3_t va = jcal_vec3_sub(a.body1.a, jcal_body_times(&a.body1, r1));
                const jcal_vec3_t vb = jcal_vec3_sub(b.body1.a, jcal_body_times(&b.body1, r1));
                const double e = (double)jcal_vec3_norm(va) - (double)jcal_vec3_norm(vb);
                square[which] += e * e;
            }
        }
    }
    /* (1, 2, 1)/4 leaves 3/8 of the power of white noise; of a derivative's less */
    TEST_ASSERT_TRUE(square[0] < 0.45 * square[1]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_joint_feels_the_same_from_both_sides);
    RUN_TEST(the_order_of_the_derivatives_shows);
    RUN_TEST(k_is_what_cross_products_say);
    RUN_TEST(bins_last_about_20_ms_at_any_rate);
    RUN_TEST(a_result_belongs_to_the_middle_bin);
    RUN_TEST(a_hole_begins_a_new_chain);
    RUN_TEST(jitter_is_no_hole);
    RUN_TEST(smoothing_lowers_the_noise_of_the_residual);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// The joint centre's kinematics, residuals and window engine against the float64 numpy reference, tools/maintain/make_golden.py.
#include "center/model.h"
#include "golden/center.h"
#include "jointcal/center_window.h"
#include "sample/kinematics.h"

#include <math.h>
#include <unity.h>

/* Products of rates up to 5 rad/s over 20 ms: 25 1/s^2 and derivatives of 50 rad/s^2, a few roundings of 6e-8 each. */
static const double BODY_TOL = 1e-4;
/* Frames follow for 250 steps in float32: 250 roundings of 1e-7 rad, of forces up to 15 m/s^2. */
static const double SMOOTHED_TOL = 5e-4;
static const double ROW_TOL = 2e-3;
/* The window's sums in float32. */
static const double FIT_M = 1e-4;
static const double FIT_BIAS_M_S2 = 2e-3;

static uint64_t storage[JCAL_CENTER_WINDOW_STORAGE_BYTES(GOLDEN_SAMPLES) / sizeof(uint64_t)];

void setUp(void)
{
}

void tearDown(void)
{
}

static jcal_vec3_t vector(const float *v)
{
    return (jcal_vec3_t){v[0], v[1], v[2]};
}

static jcal_pair_t pair_at(uint32_t k)
{
    const float *const s = golden_samples[k];
    const jcal_pair_t pair = {UINT64_C(1000000) + (uint64_t)((double)k * 1e6 / GOLDEN_RATE_HZ + 0.5),
                              {vector(&s[0]), vector(&s[3])},
                              {vector(&s[6]), vector(&s[9])}};
    return pair;
}

static void assert_vector(const double *expected, jcal_vec3_t v, double tolerance)
{
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected[0], (double)v.x);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected[1], (double)v.y);
    TEST_ASSERT_DOUBLE_WITHIN(tolerance, expected[2], (double)v.z);
}

/* a and K, row by row. */
static void assert_body(const double *expected, const jcal_segment_t *body, double tolerance)
{
    assert_vector(&expected[0], body->a, tolerance);
    for (int i = 0; i < 3; ++i) {
        const double column[3] = {expected[3 + i], expected[6 + i], expected[9 + i]};
        assert_vector(column, body->k[i], 5.0 * tolerance);
    }
}

static void bodies_are_those_of_the_reference(void)
{
    static const jcal_kinematics_config_t settings[3] = {
        {JCAL_DERIVATIVE_FIVE_POINT, 0.12f}, {JCAL_DERIVATIVE_FIVE_POINT, 0.0f}, {JCAL_DERIVATIVE_SYMMETRIC, 0.0f}};
    for (int d = 0; d < 3; ++d) {
        const double(*const golden)[24] =
            (d == 0) ? golden_smoothed : ((d == 1) ? golden_five_point : golden_symmetric);
        jcal_kinematics_t chain;
        jcal_kinematics_begin(&chain);
        int n = 0;
        for (uint32_t k = 0; n < GOLDEN_SHOWN; ++k) {
            const jcal_pair_t pair = pair_at(k);
            jcal_kinematic_t sample;
            if (jcal_kinematics_put(&chain, &settings[d], &pair, NULL, &sample)) {
                assert_body(&golden[n][0], &sample.body1, (d == 0) ? SMOOTHED_TOL : BODY_TOL);
                assert_body(&golden[n][12], &sample.body2, (d == 0) ? SMOOTHED_TOL : BODY_TOL);
                ++n;
            }
        }
    }
}

static jcal_segment_t body_of(const double *g)
{
    jcal_segment_t body = {.a = {(float)g[0], (float)g[1], (float)g[2]}};
    for (int i = 0; i < 3; ++i) {
        body.k[i] = (jcal_vec3_t){(float)g[3 + i], (float)g[6 + i], (float)g[9 + i]};
    }
    body.turn[0].x = 1.0f; /* unsmoothed: in the sensor's frame */
    body.turn[1].y = 1.0f;
    body.turn[2].z = 1.0f;
    return body;
}

static void rows_are_those_of_the_reference(void)
{
    const float *const p = golden_point[0];
    const jcal_center_point_t point = {
        .place = {vector(&p[0]), vector(&p[3])}, .b1 = vector(&p[6]), .b2 = vector(&p[9])};
    for (int n = 0; n < GOLDEN_SHOWN; ++n) {
        const jcal_kinematic_t sample = {.body1 = body_of(&golden_five_point[n][0]),
                                         .body2 = body_of(&golden_five_point[n][12])};
        jcal_center_residual_t got;
        TEST_ASSERT_TRUE(jcal_center_residual(&sample, &point, &got));
        const double *const g = golden_rows[n];
        TEST_ASSERT_DOUBLE_WITHIN(1e-5, g[0], (double)got.e);
        for (int i = 0; i < 12; ++i) {
            TEST_ASSERT_DOUBLE_WITHIN(1e-5 * (1.0 + fabs(g[1 + i])), g[1 + i], (double)got.row[i]);
        }
        TEST_ASSERT_DOUBLE_WITHIN(ROW_TOL * g[13], g[13], (double)got.turn2);
    }
}

static void the_window_engine_finds_what_the_reference_finds(void)
{
    for (int method = 0; method < 2; ++method) {
        jcal_center_window_config_t config = jcal_center_window_config_default();
        config.center.method = (jcal_center_method_t)method;
        config.n_max = GOLDEN_SAMPLES;
        jcal_center_window_t window;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_init(&window, &config, storage, sizeof storage));
        for (uint32_t k = 0; k < GOLDEN_SAMPLES; ++k) {
            const jcal_pair_t pair = pair_at(k);
            (void)jcal_center_window_update(&window, &pair);
        }
        const double *const g = golden_fits[method];
        jcal_center_result_t r;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_center_window_get(&window, &r));
        assert_vector(&g[0], r.joint_to_sensor1_m, FIT_M);
        assert_vector(&g[3], r.joint_to_sensor2_m, FIT_M);
        assert_vector(&g[6], r.acc_bias1_m_s2, FIT_BIAS_M_S2);
        assert_vector(&g[9], r.acc_bias2_m_s2, FIT_BIAS_M_S2);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(bodies_are_those_of_the_reference);
    RUN_TEST(rows_are_those_of_the_reference);
    RUN_TEST(the_window_engine_finds_what_the_reference_finds);
    return UNITY_END();
}

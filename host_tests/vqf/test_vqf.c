/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jcal_vqf.h: VQF's own behaviour seen through the C functions.
#include "jcal_vqf.h"

#include "unity.h"

#include <math.h>

static const float GRAVITY = 9.81f;
static const float PERIOD_S = 0.01f;
static const float DEG = 0.01745329252f;
static jcal_vqf_t filter;

void setUp(void)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_vqf_init(&filter, PERIOD_S, PERIOD_S));
}

void tearDown(void)
{
}

/* Third row of the rotation matrix: the vertical in the sensor's frame. */
static void vertical_of(const float q[4], float up[3])
{
    up[0] = 2.0f * (q[1] * q[3] - q[0] * q[2]);
    up[1] = 2.0f * (q[2] * q[3] + q[0] * q[1]);
    up[2] = 1.0f - 2.0f * (q[1] * q[1] + q[2] * q[2]);
}

static void feed(const float gyr[3], const float acc[3], int samples, float quat[4])
{
    for (int k = 0; k < samples; k++) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_vqf_update(&filter, gyr, acc, quat));
    }
}

static void at_rest_the_vertical_becomes_that_of_the_accelerometer(void)
{
    const float still[3] = {0.0f, 0.0f, 0.0f};
    const float flat[3] = {0.0f, 0.0f, GRAVITY};
    const float tilted[3] = {0.36f * GRAVITY, -0.48f * GRAVITY, 0.8f * GRAVITY};
    float quat[4];
    float up[3];
    /* Starts level, so that the tilted measurement has something to correct. */
    feed(still, flat, 10, quat);
    vertical_of(quat, up);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 1.0f, up[2]);
    feed(still, tilted, 1, quat);
    vertical_of(quat, up);
    TEST_ASSERT_TRUE(up[2] > 0.9f); /* not followed at once */
    feed(still, tilted, 6000, quat);
    vertical_of(quat, up);
    for (int k = 0; k < 3; k++) {
        TEST_ASSERT_FLOAT_WITHIN(1e-3f, tilted[k] / GRAVITY, up[k]);
    }
}

static void a_turn_about_the_vertical_is_followed(void)
{
    const float rate = 90.0f * DEG;
    const float turn[3] = {0.0f, 0.0f, rate};
    const float flat[3] = {0.0f, 0.0f, GRAVITY};
    float quat[4];
    feed(turn, flat, 100, quat);
    /* One second at 90 deg/s; the bias estimate may take a little of it. */
    TEST_ASSERT_FLOAT_WITHIN(0.5f * DEG, 90.0f * DEG, 2.0f * atan2f(quat[3], quat[0]));
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.0f, quat[1]);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 0.0f, quat[2]);
}

static void a_tilt_about_a_horizontal_axis_is_followed(void)
{
    const float rate = 60.0f * DEG;
    const float turn[3] = {rate, 0.0f, 0.0f};
    float quat[4] = {1.0f, 0.0f, 0.0f, 0.0f};
    for (int k = 1; k <= 100; k++) {
        const float angle = rate * PERIOD_S * (float)k;
        const float acc[3] = {0.0f, GRAVITY * sinf(angle), GRAVITY * cosf(angle)};
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_vqf_update(&filter, turn, acc, quat));
    }
    TEST_ASSERT_FLOAT_WITHIN(0.5f * DEG, 60.0f * DEG, 2.0f * atan2f(quat[1], quat[0]));
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 0.0f, quat[2]);
    TEST_ASSERT_FLOAT_WITHIN(0.01f, 0.0f, quat[3]);
}

static void what_is_not_finite_is_rejected_and_leaves_no_trace(void)
{
    const float fine[3] = {0.1f, -0.2f, 9.7f};
    float quat[4];
    feed(fine, fine, 5, quat);
    const jcal_vqf_t before = filter;
    for (int k = 0; k < 6; k++) {
        float gyr[3] = {0.1f, 0.2f, 0.3f};
        float acc[3] = {0.1f, 0.2f, 9.7f};
        *((k < 3) ? &gyr[k] : &acc[k - 3]) = (k % 2 == 0) ? NAN : -INFINITY;
        float out[4] = {7.0f, 8.0f, 9.0f, 10.0f};
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_vqf_update(&filter, gyr, acc, out));
        TEST_ASSERT_EQUAL_FLOAT(7.0f, out[0]);
        TEST_ASSERT_EQUAL_FLOAT(10.0f, out[3]);
        TEST_ASSERT_EQUAL_MEMORY(&before, &filter, sizeof filter);
    }
}

static void bad_arguments_are_refused(void)
{
    const float v[3] = {0.0f, 0.0f, 1.0f};
    float quat[4];
    const float periods[] = {0.0f, -0.01f, 0.5f * JCAL_VQF_PERIOD_MIN_S, 2.0f * JCAL_VQF_PERIOD_MAX_S, NAN, INFINITY};
    const jcal_vqf_t before = filter;
    for (size_t k = 0; k < sizeof periods / sizeof periods[0]; k++) {
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_vqf_init(&filter, periods[k], PERIOD_S));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_vqf_init(&filter, PERIOD_S, periods[k]));
        TEST_ASSERT_EQUAL_MEMORY(&before, &filter, sizeof filter);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_vqf_init(NULL, PERIOD_S, PERIOD_S));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_vqf_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_vqf_update(NULL, v, v, quat));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_vqf_update(&filter, NULL, v, quat));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_vqf_update(&filter, v, NULL, quat));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_vqf_update(&filter, v, v, NULL));
}

static void after_reset_the_same_samples_give_the_same_bits(void)
{
    const float gyr[3] = {0.3f, -0.2f, 0.5f};
    const float acc[3] = {1.0f, 2.0f, 9.0f};
    float first[4];
    float again[4];
    feed(gyr, acc, 50, first);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_vqf_reset(&filter));
    feed(gyr, acc, 1, again);
    TEST_ASSERT_TRUE(first[1] != again[1]);
    feed(gyr, acc, 49, again);
    TEST_ASSERT_EQUAL_MEMORY(first, again, sizeof first);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(at_rest_the_vertical_becomes_that_of_the_accelerometer);
    RUN_TEST(a_turn_about_the_vertical_is_followed);
    RUN_TEST(a_tilt_about_a_horizontal_axis_is_followed);
    RUN_TEST(what_is_not_finite_is_rejected_and_leaves_no_trace);
    RUN_TEST(bad_arguments_are_refused);
    RUN_TEST(after_reset_the_same_samples_give_the_same_bits);
    return UNITY_END();
}

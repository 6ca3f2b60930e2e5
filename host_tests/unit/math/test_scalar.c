/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/scalar.h.
#include "math/scalar.h"

#include "unity.h"

#include <float.h>
#include <math.h>

void setUp(void)
{
}

void tearDown(void)
{
}

/* The two errors that scalar.h promises. */
static void assert_logarithm(float x)
{
    const double expected = log((double)x);
    const double error = fabs((double)jcal_ln(x) - expected);
    TEST_ASSERT_TRUE(error <= 1e-6 * fabs(expected));
    TEST_ASSERT_TRUE((fabs((double)x - 1.0) > 0.1) || (error <= 1e-7));
}

static void logarithm_is_within_its_error_over_all_normal_numbers(void)
{
    for (float x = FLT_MIN; x < 3e38f; x *= 1.00037f) {
        assert_logarithm(x);
    }
    assert_logarithm(FLT_MAX);
}

static void logarithm_is_within_its_error_on_both_sides_of_every_change_of_the_exponent(void)
{
    /* The series changes its exponent at 2^k 2/3, the number at 2^k. */
    const float corners[3] = {1.0f, 2.0f / 3.0f, 4.0f / 3.0f};
    for (int k = -125; k <= 126; ++k) {
        for (int c = 0; c < 3; ++c) {
            const float x = ldexpf(corners[c], k);
            assert_logarithm(x);
            assert_logarithm(nextafterf(x, 0.0f));
            assert_logarithm(nextafterf(x, INFINITY));
        }
    }
}

static void logarithm_near_one_follows_its_argument(void)
{
    for (int k = -2000; k <= 2000; ++k) {
        assert_logarithm(1.0f + ((float)k * FLT_EPSILON));
    }
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_ln(1.0f));
}

static void the_larger_and_the_smaller_of_two_numbers(void)
{
    TEST_ASSERT_EQUAL_FLOAT(2.0f, jcal_max(1.0f, 2.0f));
    TEST_ASSERT_EQUAL_FLOAT(2.0f, jcal_max(2.0f, 1.0f));
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, jcal_min(1.0f, -2.0f));
    TEST_ASSERT_EQUAL_FLOAT(-2.0f, jcal_min(-2.0f, 1.0f));
    TEST_ASSERT_EQUAL_FLOAT(INFINITY, jcal_max(INFINITY, 0.0f));
    TEST_ASSERT_EQUAL_FLOAT(-INFINITY, jcal_min(-INFINITY, 0.0f));
}

static void beside_nan_the_second_argument_is_returned(void)
{
    TEST_ASSERT_EQUAL_FLOAT(3.0f, jcal_max(NAN, 3.0f));
    TEST_ASSERT_EQUAL_FLOAT(3.0f, jcal_min(NAN, 3.0f));
    TEST_ASSERT_TRUE(isnan(jcal_max(3.0f, NAN)));
    TEST_ASSERT_TRUE(isnan(jcal_min(3.0f, NAN)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(logarithm_is_within_its_error_over_all_normal_numbers);
    RUN_TEST(logarithm_is_within_its_error_on_both_sides_of_every_change_of_the_exponent);
    RUN_TEST(logarithm_near_one_follows_its_argument);
    RUN_TEST(the_larger_and_the_smaller_of_two_numbers);
    RUN_TEST(beside_nan_the_second_argument_is_returned);
    return UNITY_END();
}

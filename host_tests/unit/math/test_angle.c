/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/angle.h.
#include "math/angle.h"

#include "unity.h"

#include <math.h>
#include <stdint.h>

static const double PI = 3.14159265358979323846;

/* Ramanujan's formula: 4.1e-4 of the mean at worst; mu falls as sigma rises, so the sum is worse at one end. */
static const double CLOSED_FORM_REL_TOL = 2e-3;

void setUp(void)
{
}

void tearDown(void)
{
}

static void assert_atan2(float y, float x)
{
    const double error = (double)jcal_atan2(y, x) - atan2((double)y, (double)x);
    TEST_ASSERT_TRUE(fabs(error) < (double)JCAL_ATAN2_ERROR_RAD);
}

static void atan2_keeps_its_error_bound_all_around_the_circle(void)
{
    const int steps = 400000;
    for (int k = 0; k < steps; ++k) {
        const double a = (((double)k + 0.5) / (double)steps * 2.0 * PI) - PI;
        assert_atan2((float)(3.7 * sin(a)), (float)(3.7 * cos(a)));
    }
}

static void atan2_is_exact_near_zero_in_the_relative_sense(void)
{
    for (float y = 1e-30f; y < 0.1f; y *= 1.7f) {
        const double truth = atan2((double)y, 1.0);
        TEST_ASSERT_TRUE(fabs(((double)jcal_atan2(y, 1.0f) / truth) - 1.0) < 5e-7);
    }
}

static void atan2_on_the_axes_and_diagonals_is_right(void)
{
    for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
            assert_atan2((float)i, (float)j);
            assert_atan2((float)i * 1e18f, (float)j * 1e-18f);
            assert_atan2((float)i * 1e-18f, (float)j * 1e18f);
        }
    }
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_atan2(0.0f, 0.0f));
}

static void atan2_passes_nan_on(void)
{
    TEST_ASSERT_TRUE(isnan(jcal_atan2(NAN, 1.0f)));
    TEST_ASSERT_TRUE(isnan(jcal_atan2(1.0f, NAN)));
    TEST_ASSERT_TRUE(isnan(jcal_atan2(NAN, 0.0f)));
}

static void assert_cis(float x)
{
    const jcal_plane_t got = jcal_cis(x);
    TEST_ASSERT_TRUE(fabs((double)got.re - cos((double)x)) < (double)JCAL_CIS_ERROR);
    TEST_ASSERT_TRUE(fabs((double)got.im - sin((double)x)) < (double)JCAL_CIS_ERROR);
}

static void cis_keeps_its_error_bound_over_its_whole_range(void)
{
    for (int k = -200000; k <= 200000; ++k) {
        assert_cis((float)k * 5e-3f);
        assert_cis((float)k * 1.7e-5f);
    }
    for (int k = -636; k <= 636; ++k) {
        assert_cis((float)((double)k * PI / 2.0));
        assert_cis((float)(((double)k + 0.5) * PI / 2.0));
    }
}

static void cis_is_exact_near_zero_in_the_relative_sense(void)
{
    for (float x = 1e-30f; x < 0.1f; x *= 1.7f) {
        TEST_ASSERT_TRUE(fabs(((double)jcal_cis(x).im / sin((double)x)) - 1.0) < 2e-7);
        TEST_ASSERT_EQUAL_FLOAT(-jcal_cis(x).im, jcal_cis(-x).im);
    }
}

static void cis_refuses_what_is_outside_its_range(void)
{
    const float refused[] = {NAN, INFINITY, -INFINITY, 1001.0f, -1001.0f};
    for (size_t k = 0; k < sizeof refused / sizeof refused[0]; ++k) {
        TEST_ASSERT_TRUE(isnan(jcal_cis(refused[k]).re));
        TEST_ASSERT_TRUE(isnan(jcal_cis(refused[k]).im));
    }
}

static void constants_are_the_nearest_floats(void)
{
    TEST_ASSERT_EQUAL_FLOAT((float)PI, JCAL_PI);
    TEST_ASSERT_EQUAL_FLOAT((float)(PI / 2.0), JCAL_HALF_PI);
    TEST_ASSERT_EQUAL_FLOAT((float)(PI / 180.0), JCAL_RAD_PER_DEG);
    TEST_ASSERT_EQUAL_FLOAT((float)(180.0 / PI), JCAL_DEG_PER_RAD);
}

/* E|d| for half axes 1 and b by the midpoint rule over the angle: the integrand is periodic, so it converges fast. */
static double mean_length(double b)
{
    const int steps = 20000;
    double sum = 0.0;
    for (int k = 0; k < steps; ++k) {
        const double a = ((double)k + 0.5) / (double)steps * PI / 2.0;
        sum += sqrt((cos(a) * cos(a)) + (b * b * sin(a) * sin(a)));
    }
    return sqrt(2.0 / PI) * (sum / (double)steps) * (PI / 2.0);
}

static void mean_plus_2_sigma_agrees_with_the_integral_for_every_shape_and_direction(void)
{
    for (int shape = 0; shape <= 20; ++shape) {
        const double s1 = 0.03;
        const double b = (double)shape / 20.0;
        const double mu = s1 * mean_length(b);
        const double expected = mu + (2.0 * sqrt((s1 * s1 * (1.0 + (b * b))) - (mu * mu)));
        for (int turn = 0; turn < 8; ++turn) {
            const double c = cos((double)turn * 0.7);
            const double s = sin((double)turn * 0.7);
            const double v1 = s1 * s1;
            const double v2 = v1 * b * b;
            const float got = jcal_angle_mean_plus_2_sigma(
                (float)((c * c * v1) + (s * s * v2)), (float)(c * s * (v1 - v2)), (float)((s * s * v1) + (c * c * v2)));
            TEST_ASSERT_TRUE(fabs(((double)got / expected) - 1.0) < CLOSED_FORM_REL_TOL);
        }
    }
}

static void mean_plus_2_sigma_of_nothing_is_nothing(void)
{
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_angle_mean_plus_2_sigma(0.0f, 0.0f, 0.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_angle_mean_plus_2_sigma(-1.0f, 0.0f, -1.0f));
    TEST_ASSERT_TRUE(isnan(jcal_angle_mean_plus_2_sigma(NAN, 0.0f, 1.0f)));
    TEST_ASSERT_TRUE(isnan(jcal_angle_mean_plus_2_sigma(1.0f, NAN, 1.0f)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(atan2_keeps_its_error_bound_all_around_the_circle);
    RUN_TEST(atan2_is_exact_near_zero_in_the_relative_sense);
    RUN_TEST(atan2_on_the_axes_and_diagonals_is_right);
    RUN_TEST(atan2_passes_nan_on);
    RUN_TEST(cis_keeps_its_error_bound_over_its_whole_range);
    RUN_TEST(cis_is_exact_near_zero_in_the_relative_sense);
    RUN_TEST(cis_refuses_what_is_outside_its_range);
    RUN_TEST(constants_are_the_nearest_floats);
    RUN_TEST(mean_plus_2_sigma_agrees_with_the_integral_for_every_shape_and_direction);
    RUN_TEST(mean_plus_2_sigma_of_nothing_is_nothing);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/* The line of a lag over time: what least squares with a prior of the drift give, by hand. */
#include "run/clock_line.h"

#include "unity.h"

#include <math.h>

/* As in clock_line.h: a bound is 2 ms and two deviations; 500 ppm are two deviations of the drift. */
#define FLOOR_S 0.002
#define DRIFT_SPREAD 250e-6

static clock_line_t line;

void setUp(void)
{
    line = (clock_line_t){0};
}

void tearDown(void)
{
    clock_line_free(&line);
}

/* Bound of a point whose deviation is this. */
static double bound_of(double spread_s)
{
    return FLOOR_S + 2.0 * spread_s;
}

static void add(double t_s, double lag_s, double spread_s)
{
    TEST_ASSERT_TRUE(clock_line_add(&line, (clock_point_t){t_s, lag_s, bound_of(spread_s)}));
}

static void test_nothing_is_known_without_points(void)
{
    TEST_ASSERT_EQUAL_DOUBLE(0.0, clock_line_at(&line, 5.0));
    TEST_ASSERT_TRUE(isinf(clock_line_bound(&line, 5.0)));
}

static void test_one_point_is_a_constant_whose_bound_grows(void)
{
    add(100.0, 0.12, 0.002);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.12, clock_line_at(&line, 0.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 500e-6, line.drift_bound);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bound_of(0.002), clock_line_bound(&line, 100.0));
    const double spread_s = hypot(0.002, 40.0 * DRIFT_SPREAD);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bound_of(spread_s), clock_line_bound(&line, 60.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bound_of(spread_s), clock_line_bound(&line, 140.0));
}

/* Two points 2 d apart with deviation s: their slope has the variance s^2 / (2 d^2), and the prior draws it toward 0. */
static void test_two_points_and_the_prior(void)
{
    const double d_s = 10.0;
    const double s_s = 0.001;
    const double slope = 200e-6;
    add(50.0 - d_s, 0.1 - slope * d_s, s_s);
    add(50.0 + d_s, 0.1 + slope * d_s, s_s);
    const double variance = s_s * s_s / (2.0 * d_s * d_s);
    const double prior = DRIFT_SPREAD * DRIFT_SPREAD;
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.1, clock_line_at(&line, 50.0));
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, slope * prior / (prior + variance), line.drift);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 2.0 * sqrt(prior * variance / (prior + variance)), line.drift_bound);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, bound_of(s_s / sqrt(2.0)), clock_line_bound(&line, 50.0));
}

static void test_points_count_by_their_bounds(void)
{
    add(10.0, 0.10, 0.001);
    add(10.0, 0.1025, 0.002);
    TEST_ASSERT_DOUBLE_WITHIN(1e-12, 0.10 + 0.0025 / 5.0, clock_line_at(&line, 10.0)); /* weights 4 : 1 */
}

static void test_a_long_line_finds_the_drift_and_a_wrong_point_does_not_matter(void)
{
    for (int k = 0; k < 40; k++) {
        const double t_s = 15.0 * k;
        const double noise_s = ((k % 2) == 0) ? 0.001 : -0.001;
        add(t_s, 0.1 - 400e-6 * t_s + ((k == 30) ? 0.15 : noise_s), 0.001);
    }
    TEST_ASSERT_DOUBLE_WITHIN(5e-6, -400e-6, line.drift);
    TEST_ASSERT_TRUE(line.drift_bound > fabs(line.drift + 400e-6));
    for (double t_s = 0.0; t_s <= 600.0; t_s += 50.0) {
        const double off_s = fabs(clock_line_at(&line, t_s) - (0.1 - 400e-6 * t_s));
        TEST_ASSERT_TRUE(off_s < 0.0015);
        TEST_ASSERT_TRUE(off_s < clock_line_bound(&line, t_s));
        TEST_ASSERT_TRUE(clock_line_bound(&line, t_s) < 0.004);
    }
}

/* A clock that does not go evenly: points are further off the line than their bounds say, and the line's bound knows it. */
static void test_a_clock_that_bends_has_a_larger_bound(void)
{
    for (int k = 0; k <= 20; k++) {
        const double share = 0.1 * k - 1.0;
        add(300.0 * k, 0.05 * share * share, 0.001);
    }
    TEST_ASSERT_TRUE(clock_line_bound(&line, 3000.0) > 0.004);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_nothing_is_known_without_points);
    RUN_TEST(test_one_point_is_a_constant_whose_bound_grows);
    RUN_TEST(test_two_points_and_the_prior);
    RUN_TEST(test_points_count_by_their_bounds);
    RUN_TEST(test_a_long_line_finds_the_drift_and_a_wrong_point_does_not_matter);
    RUN_TEST(test_a_clock_that_bends_has_a_larger_bound);
    return UNITY_END();
}

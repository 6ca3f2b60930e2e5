/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of hinge/slip.h against rows that are made up here.
#include "hinge/slip.h"
#include "math/sym.h"

#include <math.h>
#include <string.h>
#include <unity.h>

enum { ROWS = 120, TILTS = 4 };
#define ALLOWED_RAD 0.1f

static jcal_hinge_slip_t slip;
static uint32_t state;

void setUp(void)
{
    memset(&slip, 0, sizeof slip);
    state = 7u;
}

void tearDown(void)
{
}

/* Uniform, standard deviation 1. */
static double chance(void)
{
    state = (state * 1664525u) + 1013904223u;
    return (((double)(state >> 8) / 16777216.0) - 0.5) * sqrt(12.0);
}

/* Residuals of axes that are off by `off`, with noise; derivatives of 20 per rad. Biases and phases take no part. */
static void fill(const double off[TILTS], double noise)
{
    for (int row = 0; row < ROWS; ++row) {
        double slope[TILTS];
        double residual = noise * chance();
        for (int i = 0; i < TILTS; ++i) {
            slope[i] = 20.0 * chance();
            residual -= slope[i] * off[i];
        }
        for (unsigned i = 0; i < TILTS; ++i) {
            slip.gradient[i] += (float)(slope[i] * residual);
            for (unsigned k = 0; k <= i; ++k) {
                slip.matrix[jcal_sym_at(i, k)] += (float)(slope[i] * slope[k]);
            }
        }
        slip.cost += (float)(residual * residual);
    }
    slip.time_s = 3.0f;
}

static void an_axis_that_is_off_rings_whichever_it_is(void)
{
    for (int i = 0; i < TILTS; ++i) {
        for (int sign = -1; sign <= 1; sign += 2) {
            double off[TILTS] = {0.0, 0.0, 0.0, 0.0};
            setUp();
            off[i] = 0.13 * sign;
            fill(off, 1.0);
            TEST_ASSERT_TRUE(jcal_hinge_slip_alarm(&slip, ALLOWED_RAD));
            TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, 0.15f)); /* no more than is allowed */
        }
    }
}

static void both_tilts_of_one_axis_count_together_and_two_axes_do_not(void)
{
    const double one[TILTS] = {0.08, 0.08, 0.0, 0.0};
    fill(one, 1.0);
    TEST_ASSERT_TRUE(jcal_hinge_slip_alarm(&slip, ALLOWED_RAD)); /* 0.113 */
    setUp();
    const double two[TILTS] = {0.0, 0.08, 0.08, 0.0};
    fill(two, 1.0);
    TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, ALLOWED_RAD));
}

static void residuals_that_merely_grow_are_no_slip(void)
{
    const double none[TILTS] = {0.0, 0.0, 0.0, 0.0};
    for (double noise = 0.1; noise < 200.0; noise *= 2.0) {
        setUp();
        fill(none, noise);
        TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, 0.0f));
    }
}

static void nor_is_what_noise_hides(void)
{
    /* 120 rows of 20 per rad and 0.12 rad explain 691: as many times a variance of 1, but 11 times one of 64 */
    const double off[TILTS] = {0.12, 0.0, 0.0, 0.0};
    fill(off, 1.0);
    TEST_ASSERT_TRUE(jcal_hinge_slip_alarm(&slip, ALLOWED_RAD));
    setUp();
    fill(off, 8.0);
    TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, 0.0f));
}

static void a_moment_is_too_short(void)
{
    const double off[TILTS] = {0.0, 0.2, 0.0, 0.0};
    fill(off, 1.0);
    slip.time_s = 0.9f;
    TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, ALLOWED_RAD));
}

static void an_axis_that_nothing_tells_of_is_not_off(void)
{
    TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, 0.0f));
    slip.time_s = 3.0f;
    slip.cost = 1e4f;
    TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, 0.0f));
}

static void axes_that_go_where_they_should_end_the_alarm(void)
{
    const double off[TILTS] = {0.15, 0.0, -0.05, 0.02};
    const float d[TILTS] = {0.15f, 0.0f, -0.05f, 0.02f};
    fill(off, 0.5);
    TEST_ASSERT_TRUE(jcal_hinge_slip_alarm(&slip, ALLOWED_RAD));
    jcal_hinge_slip_move(&slip, d);
    TEST_ASSERT_FALSE(jcal_hinge_slip_alarm(&slip, 0.01f));
}

static void memory_is_three_seconds(void)
{
    for (int k = 0; k < 200; ++k) {
        jcal_hinge_slip_fade(&slip, 0.5f);
        slip.time_s += 0.5f;
        slip.cost += 2.0f;
        slip.gradient[3] += 4.0f;
        slip.matrix[5] += 6.0f;
    }
    /* x = x 3 / 3.5 + a has its fixed point at 7 a */
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 3.5f, slip.time_s);
    TEST_ASSERT_FLOAT_WITHIN(1e-3f, 14.0f, slip.cost);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 28.0f, slip.gradient[3]);
    TEST_ASSERT_FLOAT_WITHIN(1e-2f, 42.0f, slip.matrix[5]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_axis_that_is_off_rings_whichever_it_is);
    RUN_TEST(both_tilts_of_one_axis_count_together_and_two_axes_do_not);
    RUN_TEST(residuals_that_merely_grow_are_no_slip);
    RUN_TEST(nor_is_what_noise_hides);
    RUN_TEST(a_moment_is_too_short);
    RUN_TEST(an_axis_that_nothing_tells_of_is_not_off);
    RUN_TEST(axes_that_go_where_they_should_end_the_alarm);
    RUN_TEST(memory_is_three_seconds);
    return UNITY_END();
}

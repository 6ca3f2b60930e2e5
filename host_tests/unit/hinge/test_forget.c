/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/hinge/forget.h: what is given up of an axis is gone, and what the others know by themselves stays.
#include "hinge/forget.h"

#include "hinge/block.h"
#include "math/sym.h"
#include "unity.h"

#include <math.h>
#include <string.h>

enum { UNKNOWNS = JCAL_HINGE_UNKNOWNS, ROWS = 30 };

static jcal_hinge_refine_t sums;
static double rows[ROWS][UNKNOWNS];

/* A symmetric random number in [-1, 1). */
static double random_number(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((double)(*state >> 8) / 8388608.0) - 1.0;
}

/* Sums of random rows. `alike`: how far unknown 1 is from being twice unknown 0, and the last one from half of both. */
static void fill(uint32_t seed, double alike)
{
    uint32_t state = seed;
    memset(&sums, 0, sizeof sums);
    for (int r = 0; r < ROWS; ++r) {
        float row[UNKNOWNS];
        for (int i = 0; i < UNKNOWNS; ++i) {
            rows[r][i] = 100.0 * random_number(&state);
        }
        rows[r][1] = (2.0 * rows[r][0]) + (alike * rows[r][1]);
        rows[r][7] = (0.5 * (rows[r][0] + rows[r][1])) + (alike * rows[r][7]);
        for (int i = 0; i < UNKNOWNS; ++i) {
            row[i] = (float)rows[r][i];
        }
        jcal_sym_rank1(sums.matrix, UNKNOWNS, row, 1.0f);
        for (int i = 0; i < UNKNOWNS; ++i) {
            sums.gradient[i] += row[i] * (float)random_number(&state);
        }
    }
}

void setUp(void)
{
}

void tearDown(void)
{
}

static float diagonal(unsigned i)
{
    return sums.matrix[jcal_sym_at(i, i)];
}

/* Information about nothing is less than none, or more than all sums together. */
static void assert_sound(const jcal_hinge_refine_t *before)
{
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        TEST_ASSERT_TRUE(diagonal(i) >= 0.0f);
        TEST_ASSERT_TRUE(diagonal(i) <= ((1.0001f * before->matrix[jcal_sym_at(i, i)]) + 1e-44f));
        TEST_ASSERT_TRUE(isfinite(sums.gradient[i]));
    }
}

static void what_was_given_up_twice_takes_nothing_off_the_others(void)
{
    const double alikes[4] = {1.0, 1e-2, 1e-4, 0.0};
    for (uint32_t seed = 1; seed <= 200; ++seed) {
        fill(seed, alikes[seed % 4u]);
        const jcal_hinge_refine_t before = sums;
        jcal_hinge_refine_forget_axis(&sums, seed % 2u, 0.0f);
        const jcal_hinge_refine_t once = sums;
        assert_sound(&before);
        jcal_hinge_refine_forget_axis(&sums, seed % 2u, 0.0f);
        TEST_ASSERT_EQUAL_FLOAT_ARRAY(once.matrix, sums.matrix, 36);
        TEST_ASSERT_EQUAL_FLOAT_ARRAY(once.gradient, sums.gradient, UNKNOWNS);
        jcal_hinge_refine_forget_axis(&sums, 1u - (seed % 2u), 0.0f);
        jcal_hinge_refine_forget_axis(&sums, seed % 2u, 0.0f);
        assert_sound(&before);
    }
}

/* Where unknown 1 is twice unknown 0, what is left of its pivot once 0 is gone is rounding; the others owe it nothing more. Expected: the
   rows in double precision, less what unknown 0 explains of each. */
static void a_pivot_that_is_rounding_takes_nothing_off_the_others(void)
{
    for (uint32_t seed = 1; seed <= 400; ++seed) {
        fill(seed, 0.0);
        const jcal_hinge_refine_t before = sums;
        double own = 0.0;
        for (int r = 0; r < ROWS; ++r) {
            own += rows[r][0] * rows[r][0];
        }
        jcal_hinge_refine_forget_axis(&sums, 0u, 0.0f);
        for (unsigned i = 2u; i < UNKNOWNS - 1u; ++i) { /* the last one is made of 0 and 1 */
            double with = 0.0;
            double alone = 0.0;
            for (int r = 0; r < ROWS; ++r) {
                with += rows[r][0] * rows[r][i];
                alone += rows[r][i] * rows[r][i];
            }
            const double expected = alone - ((with * with) / own);
            /* Sums of 30 products, and one elimination. */
            TEST_ASSERT_TRUE(fabs((double)diagonal(i) - expected) < (1e-5 * (double)before.matrix[jcal_sym_at(i, i)]));
        }
    }
}

static void giving_up_a_part_again_and_again_stays_sound(void)
{
    for (uint32_t seed = 1; seed <= 200; ++seed) {
        fill(seed, (seed % 3u == 0u) ? 0.0 : 1e-3);
        const jcal_hinge_refine_t before = sums;
        for (unsigned k = 0u; k < 40u; ++k) {
            jcal_hinge_refine_forget_axis(&sums, k % 2u, (k % 3u == 0u) ? 0.0f : 0.5f);
            assert_sound(&before);
        }
    }
}

static void sums_too_small_for_a_reciprocal_stay_sound(void)
{
    const float scales[3] = {1e-24f, 1e-36f, 1e-42f};
    for (int s = 0; s < 3; ++s) {
        fill(11u, 1.0);
        jcal_sym_scale(sums.matrix, UNKNOWNS, scales[s]);
        const jcal_hinge_refine_t before = sums;
        jcal_hinge_refine_forget_axis(&sums, 0u, 0.5f);
        jcal_hinge_refine_forget_axis(&sums, 1u, 0.0f);
        assert_sound(&before);
    }
}

static void nothing_is_left_of_the_axis(void)
{
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        fill(7u, 1.0);
        jcal_hinge_refine_forget_axis(&sums, axis, 0.0f);
        for (unsigned p = 2u * axis; p < (2u * axis) + 2u; ++p) {
            TEST_ASSERT_EQUAL_FLOAT(0.0f, sums.gradient[p]);
            for (unsigned i = 0u; i < UNKNOWNS; ++i) {
                TEST_ASSERT_EQUAL_FLOAT(0.0f, sums.matrix[jcal_sym_at(i, p)]);
            }
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_was_given_up_twice_takes_nothing_off_the_others);
    RUN_TEST(a_pivot_that_is_rounding_takes_nothing_off_the_others);
    RUN_TEST(giving_up_a_part_again_and_again_stays_sound);
    RUN_TEST(sums_too_small_for_a_reciprocal_stay_sound);
    RUN_TEST(nothing_is_left_of_the_axis);
    return UNITY_END();
}

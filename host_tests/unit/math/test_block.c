/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/block.h: each product against plain sums in double.
#include "math/block.h"

#include "unity.h"

#include <stdint.h>

enum { N = 12 };

static float m[JCAL_SYM_SIZE(N)];
static float v[6];

/* Sums of at most 7 products of numbers below 1. */
static const float TOL = 2e-6f;

static float next_value(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((float)(*state >> 16) / 32768.0f) - 1.0f;
}

void setUp(void)
{
    uint32_t state = 5u;
    for (size_t k = 0; k < JCAL_SYM_SIZE(N); ++k) {
        m[k] = next_value(&state);
    }
    for (size_t k = 0; k < 6; ++k) {
        v[k] = next_value(&state);
    }
}

void tearDown(void)
{
}

/* Row `row` of the block that begins at column `column`, times v. */
static float row_times(size_t row, size_t column, size_t count)
{
    double sum = 0.0;
    for (size_t k = 0; k < count; ++k) {
        sum += (double)m[jcal_sym_at(row, column + k)] * (double)v[k];
    }
    return (float)sum;
}

static void diagonal_blocks_of_six(void)
{
    for (size_t first = 0; first <= 6; first += 3) {
        float out[6];
        jcal_block_diagonal6(m, first, v, out);
        for (size_t i = 0; i < 6; ++i) {
            TEST_ASSERT_FLOAT_WITHIN(TOL, row_times(first + i, first, 6), out[i]);
        }
    }
}

static void the_block_between_the_sensors_and_its_transpose(void)
{
    float below[6];
    float above[6] = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f};
    jcal_block_below6(m, v, below);
    jcal_block_add_above6(m, v, above);
    for (size_t i = 0; i < 6; ++i) {
        TEST_ASSERT_FLOAT_WITHIN(TOL, row_times(6 + i, 0, 6), below[i]);
        TEST_ASSERT_FLOAT_WITHIN(TOL, (float)(i + 1) + row_times(i, 6, 6), above[i]);
    }
}

static void assert_vec3(size_t row, size_t column, jcal_vec3_t got)
{
    TEST_ASSERT_FLOAT_WITHIN(TOL, row_times(row, column, 3), got.x);
    TEST_ASSERT_FLOAT_WITHIN(TOL, row_times(row + 1, column, 3), got.y);
    TEST_ASSERT_FLOAT_WITHIN(TOL, row_times(row + 2, column, 3), got.z);
}

static void blocks_of_three(void)
{
    const jcal_vec3_t x = {v[0], v[1], v[2]};
    assert_vec3(0, 0, jcal_block_diagonal3(m, 0, x));
    assert_vec3(3, 3, jcal_block_diagonal3(m, 3, x));
    assert_vec3(3, 0, jcal_block_below3(m, x));
    assert_vec3(0, 3, jcal_block_above3(m, x));
}

static void scalar_product_and_sum_of_six(void)
{
    const float a[6] = {1.0f, 10.0f, 100.0f, 1e3f, 1e4f, 1e5f};
    const float b[6] = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f};
    TEST_ASSERT_EQUAL_FLOAT(654321.0f, jcal_dot6(a, b));
    float y[6] = {1.0f, 1.0f, 1.0f, 1.0f, 1.0f, 1.0f};
    jcal_add6(y, 2.0f, b);
    for (size_t i = 0; i < 6; ++i) {
        TEST_ASSERT_EQUAL_FLOAT(1.0f + (2.0f * b[i]), y[i]);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(diagonal_blocks_of_six);
    RUN_TEST(the_block_between_the_sensors_and_its_transpose);
    RUN_TEST(blocks_of_three);
    RUN_TEST(scalar_product_and_sum_of_six);
    return UNITY_END();
}

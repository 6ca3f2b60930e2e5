/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/sym.h.
#include "math/sym.h"

#include "unity.h"

#include <stdint.h>

enum { N = 5 };

static float next_value(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((float)(*state >> 16) / 32768.0f) - 1.0f;
}

static void fill(float *values, size_t count, uint32_t seed)
{
    for (size_t k = 0; k < count; ++k) {
        values[k] = next_value(&seed);
    }
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void index_runs_through_the_lower_triangle_row_by_row(void)
{
    size_t expected = 0;
    for (size_t i = 0; i < 12; ++i) {
        for (size_t j = 0; j <= i; ++j) {
            TEST_ASSERT_EQUAL_size_t(expected, jcal_sym_at(i, j));
            TEST_ASSERT_EQUAL_size_t(expected, jcal_sym_at(j, i));
            ++expected;
        }
        TEST_ASSERT_EQUAL_size_t(expected, JCAL_SYM_SIZE(i + 1));
    }
}

static void rank_1_update_adds_the_outer_product(void)
{
    float m[JCAL_SYM_SIZE(N)];
    float v[N];
    fill(v, N, 1);
    jcal_sym_zero(m, N);
    jcal_sym_rank1(m, N, v, 2.5f);
    for (size_t i = 0; i < N; ++i) {
        for (size_t j = 0; j < N; ++j) {
            TEST_ASSERT_FLOAT_WITHIN(1e-6f, 2.5f * v[i] * v[j], m[jcal_sym_at(i, j)]);
        }
    }
}

static void rank_1_update_with_negative_weight_takes_a_row_out_again(void)
{
    float m[JCAL_SYM_SIZE(N)];
    float before[JCAL_SYM_SIZE(N)];
    float v[N];
    fill(m, JCAL_SYM_SIZE(N), 2);
    fill(before, JCAL_SYM_SIZE(N), 2);
    fill(v, N, 3);
    jcal_sym_rank1(m, N, v, 1.0f);
    jcal_sym_rank1(m, N, v, -1.0f);
    for (size_t k = 0; k < JCAL_SYM_SIZE(N); ++k) {
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, before[k], m[k]);
    }
}

static void scale_multiplies_every_element(void)
{
    float m[JCAL_SYM_SIZE(3)] = {1.0f, 2.0f, 3.0f, 4.0f, 5.0f, 6.0f};
    jcal_sym_scale(m, 3, -0.5f);
    for (size_t k = 0; k < JCAL_SYM_SIZE(3); ++k) {
        TEST_ASSERT_EQUAL_FLOAT(-0.5f * (float)(k + 1), m[k]);
    }
}

static void product_and_quadratic_form_agree_with_plain_sums(void)
{
    float m[JCAL_SYM_SIZE(N)];
    float v[N];
    float mv[N];
    fill(m, JCAL_SYM_SIZE(N), 4);
    fill(v, N, 6);
    jcal_sym_times(m, N, v, mv);
    double vmv = 0.0;
    for (size_t i = 0; i < N; ++i) {
        double row = 0.0;
        for (size_t j = 0; j < N; ++j) {
            row += (double)m[jcal_sym_at(i, j)] * (double)v[j];
        }
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, (float)row, mv[i]);
        vmv += (double)v[i] * row;
    }
    TEST_ASSERT_FLOAT_WITHIN(2e-6f, (float)vmv, jcal_sym_quadratic(m, N, v));
}

static void congruence_with_a_rectangular_matrix_agrees_with_plain_sums(void)
{
    enum { K = 3 };
    float m[JCAL_SYM_SIZE(N)];
    float t[N * K];
    float out[JCAL_SYM_SIZE(K)];
    fill(m, JCAL_SYM_SIZE(N), 7);
    fill(t, N * K, 8);
    jcal_sym_congruence(m, N, t, K, out);
    for (size_t a = 0; a < K; ++a) {
        for (size_t b = 0; b < K; ++b) {
            double sum = 0.0;
            for (size_t i = 0; i < N; ++i) {
                for (size_t j = 0; j < N; ++j) {
                    sum += (double)t[(i * K) + a] * (double)m[jcal_sym_at(i, j)] * (double)t[(j * K) + b];
                }
            }
            TEST_ASSERT_FLOAT_WITHIN(5e-6f, (float)sum, out[jcal_sym_at(a, b)]);
        }
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(index_runs_through_the_lower_triangle_row_by_row);
    RUN_TEST(rank_1_update_adds_the_outer_product);
    RUN_TEST(rank_1_update_with_negative_weight_takes_a_row_out_again);
    RUN_TEST(scale_multiplies_every_element);
    RUN_TEST(product_and_quadratic_form_agree_with_plain_sums);
    RUN_TEST(congruence_with_a_rectangular_matrix_agrees_with_plain_sums);
    return UNITY_END();
}

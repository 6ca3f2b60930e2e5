/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/chol.h.
#include "math/chol.h"

#include "unity.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

static float next_value(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((float)(*state >> 16) / 32768.0f) - 1.0f;
}

/* B B^T + n I / 4: positive definite, condition number below about 50. */
static void random_spd(float *m, size_t n, uint32_t seed)
{
    jcal_sym_zero(m, n);
    for (size_t r = 0; r < n; ++r) {
        float row[JCAL_CHOL_MAX];
        for (size_t k = 0; k < n; ++k) {
            row[k] = next_value(&seed);
        }
        jcal_sym_rank1(m, n, row, 1.0f);
        m[jcal_sym_at(r, r)] += 0.25f * (float)n;
    }
}

/* Largest |M x - b| in double precision. */
static double residual(const float *m, size_t n, const float *x, const float *b)
{
    double worst = 0.0;
    for (size_t i = 0; i < n; ++i) {
        double sum = -(double)b[i];
        for (size_t j = 0; j < n; ++j) {
            sum += (double)m[jcal_sym_at(i, j)] * (double)x[j];
        }
        worst = (fabs(sum) > worst) ? fabs(sum) : worst;
    }
    return worst;
}

static void assert_refused(const float *m, size_t n)
{
    float l[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
    float ratio = -7.0f;
    TEST_ASSERT_FALSE(jcal_chol_factor(m, n, l, &ratio));
    TEST_ASSERT_EQUAL_FLOAT(-7.0f, ratio);
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void every_size_is_solved_to_rounding(void)
{
    for (size_t n = 1; n <= JCAL_CHOL_MAX; ++n) {
        for (uint32_t seed = 1; seed <= 20; ++seed) {
            float m[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
            float l[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
            float b[JCAL_CHOL_MAX];
            float x[JCAL_CHOL_MAX];
            uint32_t state = seed + 99;
            random_spd(m, n, seed);
            for (size_t k = 0; k < n; ++k) {
                b[k] = next_value(&state);
            }
            TEST_ASSERT_TRUE(jcal_chol_factor(m, n, l, NULL));
            jcal_chol_solve(l, n, b, x);
            TEST_ASSERT_TRUE(residual(m, n, x, b) < 3e-6);
        }
    }
}

static void every_size_is_inverted_to_rounding(void)
{
    for (size_t n = 1; n <= JCAL_CHOL_MAX; ++n) {
        float m[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
        float l[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
        float inverse[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
        random_spd(m, n, 31u + (uint32_t)n);
        TEST_ASSERT_TRUE(jcal_chol_factor(m, n, l, NULL));
        jcal_chol_inverse(l, n, inverse);
        for (size_t j = 0; j < n; ++j) {
            float column[JCAL_CHOL_MAX];
            float unit[JCAL_CHOL_MAX];
            for (size_t i = 0; i < n; ++i) {
                column[i] = inverse[jcal_sym_at(i, j)];
                unit[i] = (i == j) ? 1.0f : 0.0f;
            }
            TEST_ASSERT_TRUE(residual(m, n, column, unit) < 5e-6);
        }
    }
}

static void factorisation_and_solution_work_in_place(void)
{
    float m[JCAL_SYM_SIZE(6)];
    float l[JCAL_SYM_SIZE(6)];
    float b[6] = {1.0f, -2.0f, 3.0f, -4.0f, 5.0f, -6.0f};
    float x[6];
    random_spd(m, 6, 5);
    TEST_ASSERT_TRUE(jcal_chol_factor(m, 6, l, NULL));
    jcal_chol_solve(l, 6, b, x);
    TEST_ASSERT_TRUE(jcal_chol_factor(m, 6, m, NULL));
    jcal_chol_solve(m, 6, b, b);
    TEST_ASSERT_EQUAL_MEMORY(l, m, sizeof l);
    TEST_ASSERT_EQUAL_MEMORY(x, b, sizeof x);
}

static void a_known_factor_is_found(void)
{
    const float m[3] = {4.0f, 2.0f, 10.0f};
    const float expected[3] = {2.0f, 1.0f, 3.0f};
    float l[3];
    float ratio = 0.0f;
    TEST_ASSERT_TRUE(jcal_chol_factor(m, 2, l, &ratio));
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(expected, l, 3);
    TEST_ASSERT_EQUAL_FLOAT(0.9f, ratio);
}

static void pivot_ratio_of_a_diagonal_matrix_is_one(void)
{
    const float m[6] = {1e-3f, 0.0f, 5.0f, 0.0f, 0.0f, 2.0f};
    float l[6];
    float ratio = 0.0f;
    TEST_ASSERT_TRUE(jcal_chol_factor(m, 3, l, &ratio));
    TEST_ASSERT_EQUAL_FLOAT(1.0f, ratio);
}

static void pivot_ratio_shrinks_as_an_unknown_follows_from_another(void)
{
    float last = 1.0f;
    for (float rho = 0.5f; rho < 0.9991f; rho += 0.4995f * 0.5f) {
        const float m[3] = {1.0f, rho, 1.0f};
        float l[3];
        float ratio = 0.0f;
        TEST_ASSERT_TRUE(jcal_chol_factor(m, 2, l, &ratio));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f - (rho * rho), ratio);
        TEST_ASSERT_TRUE(ratio < last);
        last = ratio;
    }
}

static void a_matrix_that_is_singular_to_the_last_digit_is_refused(void)
{
    const float exact[3] = {1.0f, 1.0f, 1.0f};
    const float near_singular[3] = {1.0f, 1.0f, 1.0f + 6e-8f};
    const float one_ulp[3] = {1.0f, 1.0f, 1.0f + FLT_EPSILON};
    assert_refused(exact, 2);
    assert_refused(near_singular, 2);
    assert_refused(one_ulp, 2);
}

static void the_pivot_test_is_relative_to_the_scale(void)
{
    const float scales[] = {1e-18f, 1e-6f, 1.0f, 1e6f, 1e18f};
    for (size_t k = 0; k < sizeof scales / sizeof scales[0]; ++k) {
        const float s = scales[k];
        const float good[3] = {s, 0.999f * s, s};
        const float bad[3] = {s, s, s * (1.0f + (2.0f * FLT_EPSILON))};
        float l[3];
        TEST_ASSERT_TRUE(jcal_chol_factor(good, 2, l, NULL));
        assert_refused(bad, 2);
    }
}

static void a_pivot_far_below_the_largest_diagonal_element_is_refused(void)
{
    const float tolerance = JCAL_CHOL_PIVOT_FACTOR * 2.0f * FLT_EPSILON;
    const float below[3] = {1.0f, 0.0f, tolerance};
    const float above[3] = {1.0f, 0.0f, 1.01f * tolerance};
    float l[3];
    assert_refused(below, 2);
    TEST_ASSERT_TRUE(jcal_chol_factor(above, 2, l, NULL));
}

static void a_matrix_without_rank_is_refused(void)
{
    for (size_t n = 1; n <= JCAL_CHOL_MAX; ++n) {
        float m[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
        float row[JCAL_CHOL_MAX];
        uint32_t state = 3;
        jcal_sym_zero(m, n);
        assert_refused(m, n);
        for (size_t r = 0; r + 1 < n; ++r) { /* n - 1 rows: one direction is open */
            for (size_t k = 0; k < n; ++k) {
                row[k] = next_value(&state);
            }
            jcal_sym_rank1(m, n, row, 1.0f);
        }
        assert_refused(m, n);
    }
}

static void an_indefinite_matrix_is_refused(void)
{
    const float m[3] = {1.0f, 2.0f, 1.0f};
    const float negative[1] = {-1.0f};
    assert_refused(m, 2);
    assert_refused(negative, 1);
}

static void nan_and_infinity_are_refused_wherever_they_stand(void)
{
    const float bad[] = {NAN, -NAN, INFINITY, -INFINITY};
    for (size_t n = 1; n <= JCAL_CHOL_MAX; ++n) {
        for (size_t k = 0; k < JCAL_SYM_SIZE(n); ++k) {
            for (size_t b = 0; b < 4; ++b) {
                float m[JCAL_SYM_SIZE(JCAL_CHOL_MAX)];
                random_spd(m, n, 1);
                m[k] = bad[b];
                assert_refused(m, n);
            }
        }
    }
}

static void wrong_arguments_are_named_and_change_nothing(void)
{
    const float m[1] = {1.0f};
    float l[1] = {-5.0f};
    TEST_ASSERT_FALSE(jcal_chol_factor(NULL, 1, l, NULL));
    TEST_ASSERT_FALSE(jcal_chol_factor(m, 1, NULL, NULL));
    TEST_ASSERT_FALSE(jcal_chol_factor(m, 0, l, NULL));
    TEST_ASSERT_FALSE(jcal_chol_factor(m, JCAL_CHOL_MAX + 1u, l, NULL));
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, l[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(every_size_is_solved_to_rounding);
    RUN_TEST(every_size_is_inverted_to_rounding);
    RUN_TEST(factorisation_and_solution_work_in_place);
    RUN_TEST(a_known_factor_is_found);
    RUN_TEST(pivot_ratio_of_a_diagonal_matrix_is_one);
    RUN_TEST(pivot_ratio_shrinks_as_an_unknown_follows_from_another);
    RUN_TEST(a_matrix_that_is_singular_to_the_last_digit_is_refused);
    RUN_TEST(the_pivot_test_is_relative_to_the_scale);
    RUN_TEST(a_pivot_far_below_the_largest_diagonal_element_is_refused);
    RUN_TEST(a_matrix_without_rank_is_refused);
    RUN_TEST(an_indefinite_matrix_is_refused);
    RUN_TEST(nan_and_infinity_are_refused_wherever_they_stand);
    RUN_TEST(wrong_arguments_are_named_and_change_nothing);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/math/eig.h.
#include "math/eig.h"

#include "unity.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Eigenvalue equation, orthonormality: a few FLT_EPSILON times the largest eigenvalue (up to 6 here). */
static const double EIG_TOL = 5e-6;

static float next_value(uint32_t *state)
{
    *state = (*state * 1664525u) + 1013904223u;
    return ((float)(*state >> 16) / 32768.0f) - 1.0f;
}

static void random_symmetric(float *m, size_t n, uint32_t seed)
{
    for (size_t k = 0; k < JCAL_SYM_SIZE(n); ++k) {
        m[k] = next_value(&seed);
    }
}

static double dot(const float *a, const float *b, size_t n)
{
    double sum = 0.0;
    for (size_t k = 0; k < n; ++k) {
        sum += (double)a[k] * (double)b[k];
    }
    return sum;
}

/* M v = lambda v, v orthonormal, lambda descending, all checked in double precision. */
static void assert_eigen(const float *m, size_t n, const float *values, const float *vectors)
{
    for (size_t r = 0; r < n; ++r) {
        const float *v = &vectors[r * n];
        for (size_t i = 0; i < n; ++i) {
            double mv = 0.0;
            for (size_t j = 0; j < n; ++j) {
                mv += (double)m[jcal_sym_at(i, j)] * (double)v[j];
            }
            TEST_ASSERT_TRUE(fabs(mv - ((double)values[r] * (double)v[i])) < EIG_TOL);
        }
        for (size_t s = 0; s < n; ++s) {
            TEST_ASSERT_TRUE(fabs(dot(v, &vectors[s * n], n) - ((r == s) ? 1.0 : 0.0)) < EIG_TOL);
        }
        TEST_ASSERT_TRUE((r == 0) || (values[r] <= values[r - 1]));
    }
}

void setUp(void)
{
}

void tearDown(void)
{
}

static void random_matrices_of_every_size_are_decomposed(void)
{
    for (size_t n = 1; n <= JCAL_EIG_MAX; ++n) {
        for (uint32_t seed = 1; seed <= 200; ++seed) {
            float m[JCAL_SYM_SIZE(JCAL_EIG_MAX)];
            float values[JCAL_EIG_MAX];
            float vectors[JCAL_EIG_MAX * JCAL_EIG_MAX];
            random_symmetric(m, n, seed);
            TEST_ASSERT_TRUE(jcal_eig_symmetric(m, n, values, vectors));
            assert_eigen(m, n, values, vectors);
        }
    }
}

static void a_diagonal_matrix_is_sorted(void)
{
    const float m[6] = {1.0f, 0.0f, 3.0f, 0.0f, 0.0f, 2.0f};
    const float expected_values[3] = {3.0f, 2.0f, 1.0f};
    const float expected_vectors[9] = {0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f};
    float values[3];
    float vectors[9];
    TEST_ASSERT_TRUE(jcal_eig_symmetric(m, 3, values, vectors));
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(expected_values, values, 3);
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(expected_vectors, vectors, 9);
}

static void equal_eigenvalues_still_give_an_orthonormal_basis(void)
{
    float m[JCAL_SYM_SIZE(6)];
    float values[6];
    float vectors[36];
    const float v[6] = {1.0f, -1.0f, 1.0f, 1.0f, -1.0f, 1.0f};
    jcal_sym_zero(m, 6);
    jcal_sym_rank1(m, 6, v, 1.0f);
    TEST_ASSERT_TRUE(jcal_eig_symmetric(m, 6, values, vectors));
    assert_eigen(m, 6, values, vectors);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 6.0f, values[0]);
}

static void very_unequal_diagonal_elements_do_not_overflow(void)
{
    const float m[3] = {1e30f, 1e-5f, 1e-30f};
    float values[2];
    float vectors[4];
    TEST_ASSERT_TRUE(jcal_eig_symmetric(m, 2, values, vectors));
    TEST_ASSERT_EQUAL_FLOAT(1e30f, values[0]);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, vectors[0]);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, vectors[3]);
}

static void the_largest_component_of_an_eigenvector_is_positive(void)
{
    const float m[3] = {1.0f, -2.0f, 5.0f};
    float values[2];
    float vectors[4];
    TEST_ASSERT_TRUE(jcal_eig_symmetric(m, 2, values, vectors));
    TEST_ASSERT_TRUE(vectors[1] > fabsf(vectors[0]));
    TEST_ASSERT_TRUE(vectors[2] > fabsf(vectors[3]));
}

static void nan_infinity_and_wrong_arguments_leave_the_outputs_untouched(void)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};
    float values[3] = {-5.0f, -5.0f, -5.0f};
    float vectors[9] = {-5.0f};
    for (size_t k = 0; k < 6; ++k) {
        for (size_t b = 0; b < 3; ++b) {
            float m[6] = {1.0f, 0.5f, 1.0f, 0.5f, 0.5f, 1.0f};
            m[k] = bad[b];
            TEST_ASSERT_FALSE(jcal_eig_symmetric(m, 3, values, vectors));
        }
    }
    const float good[1] = {1.0f};
    TEST_ASSERT_FALSE(jcal_eig_symmetric(NULL, 1, values, vectors));
    TEST_ASSERT_FALSE(jcal_eig_symmetric(good, 1, NULL, vectors));
    TEST_ASSERT_FALSE(jcal_eig_symmetric(good, 1, values, NULL));
    TEST_ASSERT_FALSE(jcal_eig_symmetric(good, 0, values, vectors));
    TEST_ASSERT_FALSE(jcal_eig_symmetric(good, JCAL_EIG_MAX + 1u, values, vectors));
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, values[0]);
    TEST_ASSERT_EQUAL_FLOAT(-5.0f, vectors[0]);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(random_matrices_of_every_size_are_decomposed);
    RUN_TEST(a_diagonal_matrix_is_sorted);
    RUN_TEST(equal_eigenvalues_still_give_an_orthonormal_basis);
    RUN_TEST(very_unequal_diagonal_elements_do_not_overflow);
    RUN_TEST(the_largest_component_of_an_eigenvector_is_positive);
    RUN_TEST(nan_infinity_and_wrong_arguments_leave_the_outputs_untouched);
    return UNITY_END();
}

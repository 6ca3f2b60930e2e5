/* SPDX-License-Identifier: MIT */
/// @file
/// Cholesky factorisation of packed symmetric matrices, row by row (Cholesky-Banachiewicz).
#include "math/chol.h"

#include <float.h>
#include <math.h>

/* Largest diagonal element; a NaN on the diagonal is caught by the pivot test of its own row. */
static float largest_diagonal(const float *m, size_t n)
{
    float largest = 0.0f;
    for (size_t i = 0u; i < n; ++i) {
        /* The analyser gives up on loops and believes that a copied matrix was not filled. */
        const float d = m[jcal_sym_at(i, i)]; /* NOLINT(clang-analyzer-core.uninitialized.Assign) */
        largest = (d > largest) ? d : largest;
    }
    return largest;
}

/* m(i, j) less the scalar product of the first j elements of rows i and j of the factor, for j <= i. */
static float reduced(const float *m, size_t i, size_t j)
{
    const float *const li = &m[jcal_sym_at(i, 0u)];
    const float *const lj = &m[jcal_sym_at(j, 0u)];
    float sum = m[jcal_sym_at(i, j)];
    for (size_t k = 0u; k < j; ++k) {
        sum -= li[k] * lj[k];
    }
    return sum;
}

jcal_status_t jcal_chol_factor_in_place(float *m, size_t n, float *pivot_ratio)
{
    if ((m == NULL) || (n < 1u) || (n > JCAL_CHOL_MAX)) {
        return JCAL_ERR_ARG;
    }
    const float tolerance = JCAL_CHOL_PIVOT_FACTOR * (float)n * FLT_EPSILON * largest_diagonal(m, n);
    float smallest_ratio = 1.0f;
    for (size_t i = 0u; i < n; ++i) {
        for (size_t j = 0u; j < i; ++j) {
            m[jcal_sym_at(i, j)] = reduced(m, i, j) / m[jcal_sym_at(j, j)];
        }
        const float pivot = reduced(m, i, i);
        /* Written this way round so that NaN fails. With an infinite element the tolerance or the pivot is one of
           infinity, -infinity and NaN, and fails as well. */
        if (!(pivot > tolerance)) {
            return JCAL_ERR_SINGULAR;
        }
        const float ratio = pivot / m[jcal_sym_at(i, i)];
        smallest_ratio = (ratio < smallest_ratio) ? ratio : smallest_ratio;
        m[jcal_sym_at(i, i)] = sqrtf(pivot);
    }
    if (pivot_ratio != NULL) {
        *pivot_ratio = smallest_ratio;
    }
    return JCAL_OK;
}

jcal_status_t jcal_chol_factor(const float *m, size_t n, float *l, float *pivot_ratio)
{
    if ((m == NULL) || (l == NULL) || (n < 1u) || (n > JCAL_CHOL_MAX)) {
        return JCAL_ERR_ARG;
    }
    float work[JCAL_SYM_SIZE(JCAL_CHOL_MAX)]; /* n x n, packed */
    for (size_t k = 0u; k < JCAL_SYM_SIZE(n); ++k) {
        work[k] = m[k];
    }
    const jcal_status_t status = jcal_chol_factor_in_place(work, n, pivot_ratio);
    for (size_t k = 0u; (k < JCAL_SYM_SIZE(n)) && (status == JCAL_OK); ++k) {
        l[k] = work[k];
    }
    return status;
}

void jcal_chol_scale(float *m, size_t n, float *scale)
{
    for (size_t i = 0u; i < n; ++i) {
        const float diagonal = m[jcal_sym_at(i, i)];
        scale[i] = (diagonal > 0.0f) ? (1.0f / sqrtf(diagonal)) : 1.0f;
        for (size_t k = 0u; k <= i; ++k) {
            m[jcal_sym_at(i, k)] *= scale[i] * scale[k];
        }
    }
}

void jcal_chol_solve(const float *l, size_t n, const float *b, float *x)
{
    /* L y = b, top down; y is kept in x. */
    for (size_t i = 0u; i < n; ++i) {
        float sum = b[i];
        for (size_t k = 0u; k < i; ++k) {
            sum -= l[jcal_sym_at(i, k)] * x[k];
        }
        x[i] = sum / l[jcal_sym_at(i, i)];
    }
    /* L^T x = y, bottom up. */
    for (size_t step = 0u; step < n; ++step) {
        const size_t i = n - 1u - step;
        float sum = x[i];
        for (size_t k = i + 1u; k < n; ++k) {
            sum -= l[jcal_sym_at(k, i)] * x[k];
        }
        x[i] = sum / l[jcal_sym_at(i, i)];
    }
}

jcal_status_t jcal_chol_factor_damped(float *m, size_t n, float damping, float *scale)
{
    jcal_chol_scale(m, n, scale);
    for (size_t i = 0u; i < n; ++i) {
        m[jcal_sym_at(i, i)] += damping;
    }
    return jcal_chol_factor_in_place(m, n, NULL);
}

void jcal_chol_solve_scaled(const float *l, size_t n, const float *scale, float *x)
{
    for (size_t i = 0u; i < n; ++i) {
        x[i] *= scale[i];
    }
    jcal_chol_solve(l, n, x, x);
    for (size_t i = 0u; i < n; ++i) {
        x[i] *= scale[i];
    }
}

void jcal_chol_inverse(const float *l, size_t n, float *inverse)
{
    float column[JCAL_CHOL_MAX];
    for (size_t j = 0u; j < n; ++j) {
        for (size_t i = 0u; i < n; ++i) {
            column[i] = (i == j) ? 1.0f : 0.0f;
        }
        jcal_chol_solve(l, n, column, column);
        for (size_t i = j; i < n; ++i) {
            inverse[jcal_sym_at(i, j)] = column[i];
        }
    }
}

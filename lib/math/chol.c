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

/* m(i, j) less the scalar product of the first j elements of rows i and j of the factor. */
static float reduced(float m, const float *li, const float *lj, size_t j)
{
    float sum = m;
    for (size_t k = 0u; k < j; ++k) {
        sum -= li[k] * lj[k];
    }
    return sum;
}

bool jcal_chol_factor(const float *m, size_t n, float *l, float *pivot_ratio)
{
    if ((m == NULL) || (l == NULL) || (n < 1u) || (n > JCAL_CHOL_MAX)) {
        return false;
    }
    const float tolerance = JCAL_CHOL_PIVOT_FACTOR * (float)n * FLT_EPSILON * largest_diagonal(m, n);
    float smallest_ratio = 1.0f;
    const float *mi = m; /* row i of m ... */
    float *li = l;       /* ... and of l */
    for (size_t i = 0u; i < n; ++i) {
        const float *lj = l;
        for (size_t j = 0u; j < i; ++j) {
            li[j] = reduced(mi[j], li, lj, j) / lj[j];
            lj = &lj[j + 1u];
        }
        const float diagonal = mi[i];
        const float pivot = reduced(diagonal, li, li, i);
        /* Written this way round so that NaN fails. With an infinite element the tolerance or the pivot is one of
           infinity, -infinity and NaN, and fails as well. */
        if (!(pivot > tolerance)) {
            return false;
        }
        const float ratio = pivot / diagonal;
        smallest_ratio = (ratio < smallest_ratio) ? ratio : smallest_ratio;
        li[i] = sqrtf(pivot);
        mi = &mi[i + 1u];
        li = &li[i + 1u];
    }
    if (pivot_ratio != NULL) {
        *pivot_ratio = smallest_ratio;
    }
    return true;
}

void jcal_chol_scale(float *m, size_t n, float *scale)
{
    float *row = m;
    for (size_t i = 0u; i < n; ++i) {
        const float diagonal = row[i];
        const float own = (diagonal > 0.0f) ? (1.0f / sqrtf(diagonal)) : 1.0f;
        scale[i] = own;
        for (size_t k = 0u; k <= i; ++k) {
            row[k] *= own * scale[k];
        }
        row = &row[i + 1u];
    }
}

void jcal_chol_solve(const float *l, size_t n, const float *b, float *x)
{
    /* L y = b, top down; y is kept in x. */
    const float *row = l;
    for (size_t i = 0u; i < n; ++i) {
        float sum = b[i];
        for (size_t k = 0u; k < i; ++k) {
            sum -= row[k] * x[k];
        }
        x[i] = sum / row[i];
        row = &row[i + 1u];
    }
    /* L^T x = y, bottom up; from one row to the next a column's element is further by the row's length. */
    for (size_t step = 0u; step < n; ++step) {
        const size_t i = n - 1u - step;
        const float *const diagonal = &l[jcal_sym_at(i, i)];
        const float *below = diagonal;
        float sum = x[i];
        for (size_t k = i + 1u; k < n; ++k) {
            below = &below[k];
            sum -= *below * x[k];
        }
        x[i] = sum / *diagonal;
    }
}

bool jcal_chol_factor_damped(float *m, size_t n, float damping, float *scale)
{
    jcal_chol_scale(m, n, scale);
    for (size_t i = 0u; i < n; ++i) {
        m[jcal_sym_at(i, i)] += damping;
    }
    return jcal_chol_factor(m, n, m, NULL);
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

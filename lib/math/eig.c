/* SPDX-License-Identifier: MIT */
/// @file
/// Cyclic Jacobi eigenvalues (Golub and Van Loan, Matrix Computations, 8.5).
#include "math/eig.h"

#include <float.h>
#include <math.h>

/* An element whose square is this share of the product of its diagonal elements changes no float of either eigenvalue. */
#define NEGLIGIBLE 1e-15f

/* The matrix on its way to a diagonal one, and the rotations applied so far. */
typedef struct {
    float a[JCAL_SYM_SIZE(JCAL_EIG_MAX)]; /* n x n, packed */
    float v[JCAL_EIG_MAX * JCAL_EIG_MAX]; /* n x n, rows are eigenvectors */
    size_t n;
} jacobi_t;

/* A rotation in the plane (p, q). */
typedef struct {
    float c, s;
} rotation_t;

static void jacobi_begin(jacobi_t *self, const float *m, size_t n)
{
    self->n = n;
    for (size_t k = 0u; k < JCAL_SYM_SIZE(n); ++k) {
        self->a[k] = m[k];
    }
    for (size_t i = 0u; i < n; ++i) {
        for (size_t j = 0u; j < n; ++j) {
            self->v[(i * n) + j] = (i == j) ? 1.0f : 0.0f;
        }
    }
}

/* The smaller of the two rotations that make a(p, q) zero; a(p, q) is not zero. */
static rotation_t annihilating_rotation(float app, float aqq, float apq)
{
    const float tau = (aqq - app) / (2.0f * apq);
    /* For a huge tau the square is infinite and t is 0, which is right. */
    const float t = ((tau >= 0.0f) ? 1.0f : -1.0f) / (fabsf(tau) + sqrtf(1.0f + (tau * tau)));
    const float c = 1.0f / sqrtf(1.0f + (t * t));
    const rotation_t r = {c, t * c};
    return r;
}

/* (x, y) <- R^T (x, y). */
static void rotate(rotation_t r, float *x, float *y)
{
    const float before = *x;
    *x = (r.c * before) - (r.s * *y);
    *y = (r.s * before) + (r.c * *y);
}

/* a <- R^T a R and v <- R^T v for the rotation that makes a(p, q) zero, p < q. */
static void annihilate(jacobi_t *self, size_t p, size_t q)
{
    const size_t n = self->n;
    float *const ap = &self->a[jcal_sym_at(p, 0u)]; /* rows */
    float *const aq = &self->a[jcal_sym_at(q, 0u)];
    const float apq = aq[p];
    const float app = ap[p];
    const float aqq = aq[q];
    aq[p] = 0.0f;
    if ((apq * apq) <= (NEGLIGIBLE * fabsf(app * aqq))) { /* also where everything is zero */
        return;
    }
    const rotation_t r = annihilating_rotation(app, aqq, apq);
    for (size_t k = 0u; k < p; ++k) {
        rotate(r, &ap[k], &aq[k]);
    }
    for (size_t k = p + 1u; k < q; ++k) {
        rotate(r, &self->a[jcal_sym_at(k, p)], &aq[k]);
    }
    for (size_t k = q + 1u; k < n; ++k) {
        float *const ak = &self->a[jcal_sym_at(k, 0u)];
        rotate(r, &ak[p], &ak[q]);
    }
    float *const vp = &self->v[p * n];
    float *const vq = &self->v[q * n];
    for (size_t k = 0u; k < n; ++k) {
        rotate(r, &vp[k], &vq[k]);
    }
    const float t = r.s / r.c;
    ap[p] = app - (t * apq);
    aq[q] = aqq + (t * apq);
}

/* Sum of |a(p, q)| above the diagonal. */
static float off_diagonal(const jacobi_t *self)
{
    float sum = 0.0f;
    for (size_t p = 1u; p < self->n; ++p) {
        for (size_t q = 0u; q < p; ++q) {
            sum += fabsf(self->a[jcal_sym_at(p, q)]);
        }
    }
    return sum;
}

/* Row of the largest eigenvalue that is not above `taken` others: selection without recursion or swaps. */
static size_t row_of_rank(const jacobi_t *self, size_t rank)
{
    size_t row = 0u;
    for (size_t i = 0u; i < self->n; ++i) {
        /* The analyser gives up on loops and believes that the copied matrix was not filled. */
        const float value = self->a[jcal_sym_at(i, i)]; /* NOLINT(clang-analyzer-core.uninitialized.Assign) */
        size_t above = 0u;
        for (size_t k = 0u; k < self->n; ++k) {
            const float other = self->a[jcal_sym_at(k, k)];
            above += ((other > value) || ((other == value) && (k < i))) ? 1u : 0u;
        }
        row = (above == rank) ? i : row;
    }
    return row;
}

/* +1 or -1: the sign of the component of largest magnitude. */
static float dominant_sign(const float *v, size_t n)
{
    float dominant = 0.0f;
    for (size_t k = 0u; k < n; ++k) {
        dominant = (fabsf(v[k]) > fabsf(dominant)) ? v[k] : dominant;
    }
    return (dominant < 0.0f) ? -1.0f : 1.0f;
}

bool jcal_eig_symmetric(const float *m, size_t n, float *values, float *vectors)
{
    if ((m == NULL) || (values == NULL) || (vectors == NULL) || (n < 1u) || (n > JCAL_EIG_MAX)) {
        return false;
    }
    for (size_t k = 0u; k < JCAL_SYM_SIZE(n); ++k) {
        if (!(fabsf(m[k]) <= FLT_MAX)) {
            return false;
        }
    }
    jacobi_t work;
    jacobi_begin(&work, m, n);
    for (size_t sweep = 0u; (sweep < JCAL_EIG_SWEEPS) && (off_diagonal(&work) > 0.0f); ++sweep) {
        for (size_t p = 0u; (p + 1u) < n; ++p) {
            for (size_t q = p + 1u; q < n; ++q) {
                annihilate(&work, p, q);
            }
        }
    }
    for (size_t rank = 0u; rank < n; ++rank) {
        const size_t row = row_of_rank(&work, rank);
        const float sign = dominant_sign(&work.v[row * n], n);
        values[rank] = work.a[jcal_sym_at(row, row)];
        for (size_t k = 0u; k < n; ++k) {
            vectors[(rank * n) + k] = sign * work.v[(row * n) + k];
        }
    }
    return true;
}

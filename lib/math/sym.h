/* SPDX-License-Identifier: MIT */
/// @file
/// Packed symmetric matrices. The one place where their layout is stated.
///
/// A symmetric n x n matrix is kept as its lower triangle, row after row: (0,0), (1,0), (1,1), (2,0), ...;
/// element (i, j) with i >= j stands at i (i + 1) / 2 + j. A matrix of size n holds JCAL_SYM_SIZE(n) floats.
/// A leading k x k block of a larger matrix is therefore its first JCAL_SYM_SIZE(k) floats.
#ifndef JCAL_SYM_H
#define JCAL_SYM_H

#include "jointcal/config.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Floats in a packed symmetric n x n matrix; usable in array sizes.
#define JCAL_SYM_SIZE(n) (((n) * ((n) + 1u)) / 2u)

/// Place of element (i, j) = (j, i). Cost: one compare, one multiply.
static inline size_t jcal_sym_at(size_t i, size_t j)
{
    return (i >= j) ? (((i * (i + 1u)) / 2u) + j) : (((j * (j + 1u)) / 2u) + i);
}

/// m (n x n) <- 0. Cost: O(n^2).
static inline void jcal_sym_zero(float *m, size_t n)
{
    for (size_t k = 0u; k < JCAL_SYM_SIZE(n); ++k) {
        m[k] = 0.0f;
    }
}

/// m (n x n) <- s m. Cost: O(n^2).
static inline void jcal_sym_scale(float *m, size_t n, float s)
{
    for (size_t k = 0u; k < JCAL_SYM_SIZE(n); ++k) {
        m[k] *= s;
    }
}

/// m (n x n) <- m + weight v v^T, with v (n). A negative weight takes a row out again.
///
/// Cost:     n (n + 3) / 2 multiply-adds.
static inline void jcal_sym_rank1(float *m, size_t n, const float *v, float weight)
{
    size_t k = 0u;
    for (size_t i = 0u; i < n; ++i) {
        const float scaled = weight * v[i];
        for (size_t j = 0u; j <= i; ++j) {
            m[k] += scaled * v[j];
            ++k;
        }
    }
}

/// out (n) <- m v, with m (n x n), v (n). `out` must not overlap `v` or `m`.
///
/// One pass over the packed elements, each used for its row and for its column. Cost: n^2 multiply-adds.
static inline void jcal_sym_times(const float *m, size_t n, const float *v, float *out)
{
    size_t k = 0u;
    for (size_t i = 0u; i < n; ++i) {
        float row = 0.0f;
        for (size_t j = 0u; j < i; ++j) {
            row += m[k] * v[j];
            out[j] += m[k] * v[i];
            ++k;
        }
        out[i] = row + (m[k] * v[i]);
        ++k;
    }
}

/// v^T m v, with m (n x n), v (n). Cost: n (n + 3) / 2 multiply-adds.
static inline float jcal_sym_quadratic(const float *m, size_t n, const float *v)
{
    float diagonal = 0.0f;
    float below = 0.0f;
    size_t k = 0u;
    for (size_t i = 0u; i < n; ++i) {
        float row = 0.0f;
        for (size_t j = 0u; j < i; ++j) {
            row += m[k] * v[j];
            ++k;
        }
        below += row * v[i];
        diagonal += m[k] * v[i] * v[i];
        ++k;
    }
    return diagonal + (2.0f * below);
}

/// out (k x k) <- T^T m T, with m (n x n) and T (n x k, row-major). `out` must not overlap `m` or `T`.
///
/// Cost:     k n (n + 1 + k / 2) multiply-adds.
static inline void jcal_sym_congruence(const float *m, size_t n, const float *t, size_t k, float *out)
{
    jcal_sym_zero(out, k);
    for (size_t i = 0u; i < n; ++i) {
        for (size_t b = 0u; b < k; ++b) {
            float mt = 0.0f; /* (m T)(i, b) */
            for (size_t j = 0u; j < n; ++j) {
                mt += m[jcal_sym_at(i, j)] * t[(j * k) + b];
            }
            for (size_t a = b; a < k; ++a) {
                out[jcal_sym_at(a, b)] += t[(i * k) + a] * mt;
            }
        }
    }
}

#ifdef __cplusplus
}
#endif

#endif /* JCAL_SYM_H */

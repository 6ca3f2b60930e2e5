/* SPDX-License-Identifier: MIT */
/// @file
/// Cholesky factorisation M = L L^T of packed symmetric positive definite matrices up to JCAL_CHOL_MAX.
///
/// Layout of M, L and the inverse: sym.h. The pivot test is relative and a NaN fails it.
#ifndef JCAL_CHOL_H
#define JCAL_CHOL_H

#include "jointcal/config.h"
#include "math/sym.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Largest size that can be factorised.
#define JCAL_CHOL_MAX 12u

/// A pivot must exceed this factor times n * FLT_EPSILON * (largest diagonal element).
///
/// Rounding moves a pivot by about n * FLT_EPSILON / 2 times the diagonal; below 4 times n * FLT_EPSILON no
/// digit of the pivot is left.
#define JCAL_CHOL_PIVOT_FACTOR 4.0f

/// Factorises m (n x n, packed) into l (n x n, packed lower triangle).
///
/// Unknowns of very different units should be scaled first: the test compares with the largest diagonal element.
///
/// Inputs:   m; n in [1, JCAL_CHOL_MAX].
/// Outputs:  l, which may be m itself; pivot_ratio (may be null) the smallest of pivot / original diagonal element,
///           in (0, 1]: 1 for a diagonal matrix, near 0 when some unknown follows from the ones before it.
/// Returns:  false if an argument is null or n out of range, or if a pivot is not above the tolerance (NaN; infinity): l is lost.
/// Cost:     n^3 / 6 multiply-adds, n square roots, n^2 / 2 divisions; stack about 100 B.
JCAL_MUST_CHECK bool jcal_chol_factor(const float *m, size_t n, float *l, float *pivot_ratio);

/// Brings m (n x n) to a unit diagonal: m_ik <- s_i s_k m_ik with s_i = 1 / sqrt(m_ii); an element of the diagonal that is
/// not positive keeps s_i = 1. Unknowns of very different units or information can then be factorised together.
///
/// Outputs:  scale (n). With y = s b the solution of the original equations is x = s (M_scaled^-1 y).
/// Cost:     n^2 multiplications, n square roots and divisions.
void jcal_chol_scale(float *m, size_t n, float *scale);

/// x (n) <- M^-1 b (n) from the factor l. x may be b. Cost: n^2 multiply-adds, 2 n divisions.
void jcal_chol_solve(const float *l, size_t n, const float *b, float *x);

/// m (n x n) <- factor of M + damping D, D the diagonal of M, brought to a unit diagonal before: for jcal_chol_solve_scaled.
///
/// Outputs:  scale (n), as jcal_chol_scale.
/// Returns:  as jcal_chol_factor; m is lost.
/// Cost:     n^3 / 6 + n^2 multiply-adds, 2 n square roots.
JCAL_MUST_CHECK bool jcal_chol_factor_damped(float *m, size_t n, float damping, float *scale);

/// x (n) <- M^-1 x from the factor l of the scaled matrix and its scale (n). Cost: as jcal_chol_solve.
void jcal_chol_solve_scaled(const float *l, size_t n, const float *scale, float *x);

/// inverse (n x n, packed) <- M^-1 from the factor l; for covariances only, equations are solved with jcal_chol_solve.
///
/// `inverse` must not overlap `l`; n in [1, JCAL_CHOL_MAX].
/// Cost:     n^3 multiply-adds, 2 n^2 divisions; stack about 100 B.
void jcal_chol_inverse(const float *l, size_t n, float *inverse);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CHOL_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Eigenvalues and eigenvectors of packed symmetric matrices up to JCAL_EIG_MAX, for starts and sample selection.
#ifndef JCAL_EIG_H
#define JCAL_EIG_H

#include "jointcal/config.h"
#include "math/sym.h"

#include <stdbool.h>
#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Largest size.
#define JCAL_EIG_MAX 6u

/// Sweeps of the cyclic Jacobi method. It converges quadratically: float32 needs 4 to 6 for 6 x 6.
#define JCAL_EIG_SWEEPS 10u

/// All eigenvalues and eigenvectors of m (n x n, packed), by cyclic Jacobi rotations.
///
/// Inputs:   m, finite; n in [1, JCAL_EIG_MAX].
/// Outputs:  values (n) in descending order; vectors (n x n, row-major): row k is the unit eigenvector of values[k],
///           its largest component positive. Untouched where it returns false. Absolute error of a value: a few FLT_EPSILON times
///           the largest one.
/// Returns:  false if an argument is null, n out of range, or something in m not finite.
/// Cost:     at most JCAL_EIG_SWEEPS * n (n - 1) / 2 rotations of 6 n multiply-adds; stack about 350 B.
JCAL_MUST_CHECK bool jcal_eig_symmetric(const float *m, size_t n, float *values, float *vectors);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_EIG_H */

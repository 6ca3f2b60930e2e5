/* SPDX-License-Identifier: MIT */
/// @file
/// Eigenvalues and eigenvectors of packed symmetric matrices up to JCAL_EIG_MAX, for starts and sample selection.
#ifndef JCAL_EIG_H
#define JCAL_EIG_H

#include "jointcal/status.h"
#include "math/sym.h"

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
///           its largest component positive. Untouched on error. Absolute error of a value: a few FLT_EPSILON times
///           the largest one.
/// Errors:   JCAL_ERR_ARG (null, n); JCAL_ERR_SINGULAR (something is not finite).
/// Cost:     at most JCAL_EIG_SWEEPS * n (n - 1) / 2 rotations of 6 n multiply-adds; stack about 350 B.
JCAL_MUST_CHECK jcal_status_t jcal_eig_symmetric(const float *m, size_t n, float *values, float *vectors);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_EIG_H */

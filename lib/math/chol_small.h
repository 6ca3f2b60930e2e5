/* SPDX-License-Identifier: MIT */
/// @file
/// Cholesky factors of 3 x 3, 4 x 4 and 6 x 6 matrices, written out: the same operations in the same order as in chol.h, and so the
/// same bits, for a third of the instructions, since nothing is spent on loops. Private.
///
/// Packed as in sym.h. Solving in place is allowed.
#ifndef JCAL_CHOL_SMALL_H
#define JCAL_CHOL_SMALL_H

#include <stdbool.h>

/// m (6, 10, 21) <- its factor. False unless every pivot is above rounding (jcal_chol_factor); m is spoilt then.
bool jcal_chol3_factor(float *m);
bool jcal_chol4_factor(float *m);
bool jcal_chol6_factor(float *m);

/// x (3, 4, 6) <- solution of L L' x = x.
void jcal_chol3_solve(const float *l, float *x);
void jcal_chol4_solve(const float *l, float *x);
void jcal_chol6_solve(const float *l, float *x);

#endif /* JCAL_CHOL_SMALL_H */

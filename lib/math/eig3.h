/* SPDX-License-Identifier: MIT */
/// @file
/// Eigenvalues of symmetric 3 x 3 matrices without their vectors, and what they are good for.
#ifndef JCAL_EIG3_H
#define JCAL_EIG3_H

#ifdef __cplusplus
extern "C" {
#endif

/// m (3 x 3, packed) <- its eigenvalues on its diagonal, by cyclic Jacobi rotations written out. Cost: about 600 instructions.
void jcal_eig3_values(float *m);

/// Largest tr(R' G) over rotations R: the sum of the singular values of G (3 x 3), the last with the sign of the determinant.
float jcal_eig3_alignment(const float *g);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_EIG3_H */

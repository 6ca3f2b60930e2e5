/* SPDX-License-Identifier: MIT */
/// @file
/// Sums over all samples; lib/two_dof/model.h has the equations.
#ifndef JCAL_PRIVATE_TWO_DOF_MOMENTS_H
#define JCAL_PRIVATE_TWO_DOF_MOMENTS_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Number of features of each constraint; lib/two_dof/model.h says which.
#define JCAL_TWO_DOF_FEATURES 27

/// Weighted sums over all samples.
typedef struct {
    float rotation[378];     ///< 27 x 27, packed: products of the features of the rotation-based constraint.
    float orientation[378];  ///< The same for the orientation-based one.
    float mean[27];          ///< Sum of the features of the orientation-based one.
    float weight;            ///< Sum of its weights.
} jcal_two_dof_moments_t;

/// Cost at a point with half its gradient and Gauss-Newton matrix; the unknowns are the steps of j1 (2), j2 (2) and delta.
typedef struct {
    float cost;
    float gradient[5];
    float matrix[15];  ///< 5 x 5, packed.
} jcal_two_dof_lin_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_MOMENTS_H */

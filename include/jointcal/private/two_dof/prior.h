/* SPDX-License-Identifier: MIT */
/// @file
/// What forgotten samples said.
#ifndef JCAL_PRIVATE_TWO_DOF_PRIOR_H
#define JCAL_PRIVATE_TWO_DOF_PRIOR_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What forgotten samples said of the axes, as a quadratic around an anchor.
typedef struct {
    jcal_vec3_t j1, j2;  ///< The anchor.
    float gradient[4];   ///< Half the gradient there.
    float matrix[10];    ///< 4 x 4, packed.
} jcal_two_dof_prior_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_PRIOR_H */

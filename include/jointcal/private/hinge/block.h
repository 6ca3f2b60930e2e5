/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of one block; lib/hinge/refine.h has the equations.
#ifndef JCAL_PRIVATE_HINGE_BLOCK_H
#define JCAL_PRIVATE_HINGE_BLOCK_H

#include "jointcal/private/plane.h"

#ifdef __cplusplus
extern "C" {
#endif

/// One sensor's rate, less its bias, in the directions of its axis.
typedef struct {
    jcal_plane_t across;  ///< Along u and v.
    float along;          ///< Along j.
} jcal_hinge_view_t;

/// Sums of the current block; lib/hinge/refine.h has the equations.
typedef struct {
    float matrix[45];          ///< Packed 9 x 9: tilts of axis 1, of axis 2, biases of sensor 1, of sensor 2, phase.
    float gradient[9];         ///< Half the gradient in the same unknowns.
    float acc_score[4];        ///< Half the gradient of the accelerometer part.
    float power2;              ///< Weighted sum of |z2|^2; that of |z1|^2 is in the matrix.
    float joint;               ///< Weighted sum of the joint's own squared rate.
    float time_s;              ///< Time in the block.
    jcal_plane_t match;        ///< How z1, turned, matches z2.
    jcal_plane_t match_other;  ///< The same for the other sign pairing.
    jcal_plane_t turn_other;   ///< exp(-i theta) of the other pairing.
    jcal_plane_t path1;        ///< Integral of z1 since the block began.
    jcal_plane_t path2;
} jcal_hinge_block_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_BLOCK_H */

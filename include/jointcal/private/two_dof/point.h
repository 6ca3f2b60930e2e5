/* SPDX-License-Identifier: MIT */
/// @file
/// The unknowns of a joint with two axes.
#ifndef JCAL_PRIVATE_TWO_DOF_POINT_H
#define JCAL_PRIVATE_TWO_DOF_POINT_H

#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The unknowns.
typedef struct {
    jcal_vec3_t j1, j2;
    jcal_plane_t heading;  ///< exp(i delta).
} jcal_two_dof_point_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_POINT_H */

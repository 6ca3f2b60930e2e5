/* SPDX-License-Identifier: MIT */
/// @file
/// What the heading offset does while the status is `ready`.
#ifndef JCAL_PRIVATE_TWO_DOF_MEMORY_H
#define JCAL_PRIVATE_TWO_DOF_MEMORY_H

#include "jointcal/private/plane.h"

#ifdef __cplusplus
extern "C" {
#endif

/// When the sums were last faded, and how the heading offset drifts.
typedef struct {
    jcal_plane_t heading_then;  ///< Heading offset when the sums were last faded ...
    float drift_rad_s;          ///< ... and how fast it drifts.
    float since_s;              ///< Time since the sums were last faded.
} jcal_two_dof_memory_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_MEMORY_H */

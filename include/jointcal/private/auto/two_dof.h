/* SPDX-License-Identifier: MIT */
/// @file
/// State of a joint with two axes of either kind. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_AUTO_TWO_DOF_H
#define JCAL_PRIVATE_AUTO_TWO_DOF_H

#include "jointcal/private/two_axes/pair.h"
#include "jointcal/private/two_dof/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Both models on the same readings. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_two_dof_t rigid;
    jcal_two_axes_pair_t functional;
    float max_bound_rad;  ///< For axes.
    float carrying;       ///< Sine of the functional model's carrying angle, over the last seconds.
    uint64_t last_us;     ///< Time of the last pair.
    bool has_carrying;
} jcal_two_dof_auto_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_AUTO_TWO_DOF_H */

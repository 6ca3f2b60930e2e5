/* SPDX-License-Identifier: MIT */
/// @file
/// Orientations on their way from push to step, and the last ones that step has taken. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_TWO_DOF_KEPT_H
#define JCAL_PRIVATE_TWO_DOF_KEPT_H

#include "jointcal/private/ring.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Orientations that a rate takes: that in the middle and its neighbours.
#define JCAL_TWO_DOF_KEPT 3u

/// Orientations that wait for step, and step's own copies of the last ones.
typedef struct {
    jcal_orientation_pair_t slots[JCAL_INBOX_CAPACITY];
    uint8_t pushes_of[JCAL_INBOX_CAPACITY];  ///< Samples pushed for each of them.
    jcal_ring_t ring;
    jcal_orientation_pair_t last[JCAL_TWO_DOF_KEPT];  ///< Newest first.
    uint8_t pushes;                                   ///< Samples since one was last kept; of push.
    bool has_kept;                                    ///< One was kept; of push.
    uint8_t count;                                    ///< How many there are in `last`; of step.
} jcal_two_dof_kept_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_KEPT_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// When the 2-DoF stream engine forgets, and how it follows the drift of the heading offset. Private.
///
/// The heading offset drifts, so old samples are forgotten by fading the sums. While the status is `ready` what they said of the axes
/// goes to the prior; before that all of it fades, slowly, or soon if what is remembered does not fit together.
#ifndef JCAL_TWO_DOF_MEMORY_H
#define JCAL_TWO_DOF_MEMORY_H

#include "jointcal/private/two_dof/memory.h"
#include "jointcal/private/two_dof/verdict.h"
#include "jointcal/two_dof_config.h"

/// What sums keep when they fade.
#define JCAL_TWO_DOF_FADE_KEEP 0.75f

/// True if it is time to forget.
bool jcal_two_dof_fade_is_due(const jcal_two_dof_memory_t *self, const jcal_two_dof_config_t *cfg,
                              const jcal_two_dof_verdict_t *verdict);

/// Follows the drift while the status is `ready`: the sums have been faded, and the heading offset is `now`.
///
/// Outputs:  turn  by which it drifts in the time since they were last faded.
/// Returns:  false, and no turn, if there is no drift to tell yet.
bool jcal_two_dof_follow_drift(jcal_two_dof_memory_t *self, const jcal_two_dof_config_t *cfg, jcal_plane_t now,
                               jcal_plane_t *turn);

#endif /* JCAL_TWO_DOF_MEMORY_H */

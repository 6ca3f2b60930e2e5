/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of a 2-DoF joint. Private.
#ifndef JCAL_TWO_DOF_JUDGE_H
#define JCAL_TWO_DOF_JUDGE_H

#include "jointcal/two_dof.h"

/// Judges the estimate; search.lin is that of the sums at the estimate, without the prior.
void jcal_two_dof_judge(jcal_two_dof_t *self);

/// True if it is time to forget. Then jcal_two_dof_fade_now, while search.lin is still that of the sums at the estimate, and
/// jcal_two_dof_follow_drift.
bool jcal_two_dof_fade_is_due(const jcal_two_dof_t *self);

/// Fades all sums; while the status is ready, what they said of the axes goes to the prior.
void jcal_two_dof_fade_now(jcal_two_dof_t *self);

/// Follows the drift of the heading offset while the status is ready, and refers the sums to where it is by now.
void jcal_two_dof_follow_drift(jcal_two_dof_t *self);

#endif /* JCAL_TWO_DOF_JUDGE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of a 2-DoF joint. Private.
#ifndef JCAL_TWO_DOF_JUDGE_H
#define JCAL_TWO_DOF_JUDGE_H

#include "jointcal/two_dof.h"

/// Judges the estimate; search.lin is that of the sums at the estimate, without the prior.
void jcal_two_dof_judge(jcal_two_dof_t *self);

#endif /* JCAL_TWO_DOF_JUDGE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum of a 2-DoF joint and looks for others, one bounded slice at a time. Private.
#ifndef JCAL_TWO_DOF_SEARCH_H
#define JCAL_TWO_DOF_SEARCH_H

#include "jointcal/two_dof.h"

/// One slice of work: half a Gauss-Newton step of the estimate or of a probe, a new start, the cost of the rival, or a judgement.
void jcal_two_dof_work(jcal_two_dof_t *self);

#endif /* JCAL_TWO_DOF_SEARCH_H */

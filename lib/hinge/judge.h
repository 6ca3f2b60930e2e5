/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of the hinge. Private. The reasoning is in docs/METHOD.md, sections 5 to 7.
#ifndef JCAL_HINGE_JUDGE_H
#define JCAL_HINGE_JUDGE_H

#include "jointcal/hinge.h"

/// Works out bounds, sign margin and status from the sums and writes them into self->verdict.
void jcal_hinge_judge(jcal_hinge_t *self);

#endif /* JCAL_HINGE_JUDGE_H */

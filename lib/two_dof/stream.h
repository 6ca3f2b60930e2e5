/* SPDX-License-Identifier: MIT */
/// @file
/// What the parts of the 2-DoF stream engine call of each other. Private.
#ifndef JCAL_TWO_DOF_STREAM_H
#define JCAL_TWO_DOF_STREAM_H

#include "jointcal/two_dof.h"

/// Forgets all that was learnt of the joint and begins again with the given status; samples, counters and config stay.
void jcal_two_dof_begin_anew(jcal_two_dof_t *self, jcal_calibration_t status);

#endif /* JCAL_TWO_DOF_STREAM_H */

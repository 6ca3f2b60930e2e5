/* SPDX-License-Identifier: MIT */
/// @file
/// What the engines of the 2-DoF joint tell their user. Private.
#ifndef JCAL_TWO_DOF_RESULT_H
#define JCAL_TWO_DOF_RESULT_H

#include "jointcal/two_dof.h"

/// out <- status, bounds and progress of the verdict and, unless `point` is null, axes and angles there; all other fields zero.
void jcal_two_dof_report(const jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                         const jcal_two_dof_point_t *point, jcal_two_dof_result_t *out);

/// out <- the counters of the gate, and what it complains of.
void jcal_two_dof_report_gate(const jcal_orientation_gate_t *gate, jcal_two_dof_result_t *out);

#endif /* JCAL_TWO_DOF_RESULT_H */

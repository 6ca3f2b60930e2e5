/* SPDX-License-Identifier: MIT */
/// @file
/// Judges the estimate of the 2-DoF stream engine. Private.
#ifndef JCAL_TWO_DOF_JUDGE_H
#define JCAL_TWO_DOF_JUDGE_H

#include "two_dof/search.h"
#include "two_dof/verdict.h"

/// What a judgement reads besides the config.
typedef struct {
    const jcal_two_dof_search_t *search;  ///< Its `lin` is that of the moments at the estimate, without the prior.
    const jcal_two_dof_landscape_t *landscape;
    float age_s;              ///< Mean age of what is in the moments.
    jcal_reason_t complaint;  ///< Of the gate.
} jcal_two_dof_case_t;

/// verdict <- bounds and status of the estimate.
void jcal_two_dof_judge(jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                        const jcal_two_dof_case_t *of);

#endif /* JCAL_TWO_DOF_JUDGE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Judges the estimate of the 2-DoF stream engine. See two_dof/judge.h.
#include "two_dof/judge.h"

#include "math/sym.h"
#include "two_dof/model.h"
#include "two_dof/prior.h"

#include <stddef.h>

/// Covariance (5 x 5, packed) from the moments and the prior; false if there is none.
static bool covariance_of(const jcal_two_dof_case_t *of, float *inverse)
{
    jcal_two_dof_lin_t all;
    jcal_two_dof_prior_apply(of->landscape->prior, &of->search->best.point, &of->search->lin, &all);
    return jcal_two_dof_covariance(all.matrix, JCAL_TWO_DOF_UNKNOWNS, inverse);
}

void jcal_two_dof_judge(jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                        const jcal_two_dof_case_t *of)
{
    const jcal_two_dof_search_t *const search = of->search;
    float inverse[JCAL_SYM_SIZE(JCAL_TWO_DOF_UNKNOWNS)];
    const jcal_two_dof_evidence_t evidence = {
        .point = &search->best.point,
        .covariance = covariance_of(of, inverse) ? inverse : NULL,
        .parts = {search->parts[0], search->parts[1]},
        .moving_s = of->landscape->moving_s,
        .age_s = of->age_s,
        .sine = jcal_two_dof_mean(of->landscape->moments, &search->best.point),
        .complaint = of->complaint,
        .cost = search->cost,
        .rival_cost = search->rival_cost,
        .has_rival = search->has_rival,
        .tried = search->tried,
        .exchanges = search->exchanges,
    };
    jcal_two_dof_conclude(verdict, cfg, &evidence);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of the hinge. Private. The reasoning is in docs/METHOD.md, sections 5 to 7.
#ifndef JCAL_HINGE_JUDGE_H
#define JCAL_HINGE_JUDGE_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/coarse.h"
#include "jointcal/private/hinge/refine.h"
#include "jointcal/private/hinge/search.h"
#include "jointcal/private/hinge/verdict.h"
#include "jointcal/status.h"

#include <stdbool.h>

/// What a judgement reads.
typedef struct {
    const jcal_hinge_config_t *cfg;
    const jcal_hinge_coarse_t *coarse;
    const jcal_hinge_refine_t *refine;
    const jcal_hinge_search_t *search;
    const jcal_hinge_amount_t *amount;
    jcal_reason_t complaint;  ///< Of the gate about the sensors.
    const int8_t *kept_sign;  ///< Of both axes, from the first `ready` on: largest components may tie.
} jcal_hinge_evidence_t;

/// Works out bounds, sign margin and status from the sums. Returns true if the other sign pairing should become the estimate.
bool jcal_hinge_judge(const jcal_hinge_evidence_t *self, jcal_hinge_verdict_t *verdict);

#endif /* JCAL_HINGE_JUDGE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and readiness of a 2-DoF joint from what an engine knows: the rules that both engines share. Private.
#ifndef JCAL_TWO_DOF_VERDICT_H
#define JCAL_TWO_DOF_VERDICT_H

#include "jointcal/private/two_dof/verdict.h"
#include "jointcal/status.h"
#include "jointcal/two_dof_config.h"
#include "two_dof/point.h"

/// What a judgement rests on.
typedef struct {
    const jcal_two_dof_point_t *point;  ///< The estimate.
    const float
        *covariance;  ///< 5 x 5, packed, of the steps of j1 (2), j2 (2) and delta, rad^2; null if there is none.
    float parts[2];   ///< Of the cost at the estimate, residuals over variance: rotation- and orientation-based.
    float moving_s;   ///< Time in the cost, rest left out.
    float age_s;      ///< Its mean age.
    float sine;       ///< Mean of the orientation-based constraint.
    jcal_reason_t complaint;  ///< Of the gate.
    float cost, rival_cost;   ///< Of the estimate and of the best other minimum, in units of the variance.
    bool has_rival;
    uint8_t tried;      ///< Probes that ended.
    uint8_t exchanges;  ///< Probes that started from the exchanged axes of this estimate.
} jcal_two_dof_evidence_t;

/// The verdict before there is any: unknown bounds, no data.
void jcal_two_dof_verdict_begin(jcal_two_dof_verdict_t *verdict, jcal_calibration_t status);

/// inverse (n x n, packed) <- matrix^-1 after scaling; the matrix is lost. False if it is singular.
bool jcal_two_dof_covariance(float *matrix, unsigned n, float *inverse);

/// Judges: verdict <- bounds, sine, status, weak, hint, reason, excess, and judgements in a row that found nothing missing.
void jcal_two_dof_conclude(jcal_two_dof_verdict_t *verdict, const jcal_two_dof_config_t *cfg,
                           const jcal_two_dof_evidence_t *evidence);

#endif /* JCAL_TWO_DOF_VERDICT_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// The last judgement.
#ifndef JCAL_PRIVATE_TWO_DOF_VERDICT_H
#define JCAL_PRIVATE_TWO_DOF_VERDICT_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The last judgement.
typedef struct {
    float bound1_rad;
    float bound2_rad;
    float bound_heading_rad;
    float sine;  ///< Mean of the orientation-based constraint: sine of the carrying angle.
    float
        excess;  ///< Residuals, squared, over what the config takes for usual, at least 1: divides the data's information.
    uint8_t status, weak, hint, reason;  ///< As in jcal_two_dof_result_t.
    uint8_t agreed;                      ///< Judgements in a row that found nothing missing.
    int8_t sign1, sign2;                 ///< Which signs the axes are reported with; lib/joint/sign.h.
} jcal_two_dof_verdict_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_VERDICT_H */

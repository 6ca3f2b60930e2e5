/* SPDX-License-Identifier: MIT */
/// @file
/// The last judgement.
#ifndef JCAL_PRIVATE_HINGE_VERDICT_H
#define JCAL_PRIVATE_HINGE_VERDICT_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// The last judgement.
typedef struct {
    float bound1_rad;
    float bound2_rad;
    float sign_margin;
    uint8_t status, weak, hint, reason;  ///< As in jcal_hinge_result_t.
    uint8_t agreed;                      ///< Judgements in a row that found nothing missing.
    bool contradicted;                   ///< No hinge explains the sums.
    uint8_t sign_progress;               ///< Evidence for the sign pairing, in 255ths of what is needed.
    bool after_doubt;                    ///< Sums that no hinge explained were given up; those since then are few.
} jcal_hinge_verdict_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_VERDICT_H */

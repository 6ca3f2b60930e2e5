/* SPDX-License-Identifier: MIT */
/// @file
/// Orientations of the two IMUs of a joint: what the estimators that need them take in, and the check of each pair.
///
/// An orientation is a 6D (magnetometer-free) one, from a chip's own fusion or from a filter such as VQF: `q_s_e` rotates from
/// the sensor's frame to an earth frame with z up. Each sensor has an earth frame of its own, with its own heading.
#ifndef JCAL_ORIENTATION_H
#define JCAL_ORIENTATION_H

#include "jointcal/gate.h"
#include "jointcal/private/orientation.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Checks a pair, remembers it and counts the outcome.
///
/// A quaternion whose length differs from 1 by more than 0.05 is out of range. Of `config` only frozen_s and gap_s count.
/// Returns:  JCAL_REJECT_NONE, or the cause that counts.
/// Cost:     constant, about 40 floating-point operations.
/// Threads:  one caller at a time; inside push it is push.
jcal_reject_t jcal_orientation_gate_check(jcal_orientation_gate_t *self, const jcal_gate_config_t *config,
                                          const jcal_orientation_pair_t *pair);

/// What is wrong with the stream as a whole: JCAL_REASON_NONE or _BAD_SAMPLES, when more than a fifth of the last 50 or so were bad:
/// not finite, of a wrong length, out of order, after a gap, frozen or repeated.
jcal_reason_t jcal_orientation_gate_complaint(const jcal_orientation_gate_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_ORIENTATION_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Orientations of the two IMUs of a joint: what the estimators that need them take in, and the check of each pair.
///
/// An orientation is a 6D (magnetometer-free) one, from a chip's own fusion or from a filter such as VQF: `q_s_e` rotates from
/// the sensor's frame to an earth frame with z up. Each sensor has an earth frame of its own, with its own heading.
#ifndef JCAL_ORIENTATION_H
#define JCAL_ORIENTATION_H

#include "jointcal/gate.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Simultaneous orientations of the two IMUs of a joint: 1 on the proximal segment, 2 on the distal one.
typedef struct {
    uint64_t t_us;   ///< Time in microseconds, any origin, strictly increasing.
    jcal_quat_t q1;  ///< Sensor 1 to its earth frame E1.
    jcal_quat_t q2;  ///< Sensor 2 to its earth frame E2.
} jcal_orientation_pair_t;

/// Checks orientations as jcal_gate_t checks readings, with the same causes and counters; nothing is ever `saturated`.
/// Caller-owned, plain, copyable; all members are private.
typedef struct {
    jcal_orientation_pair_t last;
    float still1_s;  ///< How long q1 has not changed by a bit.
    float still2_s;
    uint32_t samples;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    float
        bad_share;  ///< Share of samples that are out of range, frozen or repeated, averaged over about 2 s of samples.
    bool has_last;
} jcal_orientation_gate_t;

/// Checks a pair, remembers it and counts the outcome.
///
/// A quaternion whose length differs from 1 by more than 0.05 is out of range. Of `config` only frozen_s and gap_s count.
/// Returns:  JCAL_REJECT_NONE, or the cause that counts.
/// Cost:     constant, about 40 floating-point operations.
jcal_reject_t jcal_orientation_gate_check(jcal_orientation_gate_t *self, const jcal_gate_config_t *config,
                                          const jcal_orientation_pair_t *pair);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_ORIENTATION_H */

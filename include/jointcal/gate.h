/* SPDX-License-Identifier: MIT */
/// @file
/// Decides for every incoming sample pair whether it may be used, and counts why not.
///
/// The gate looks at readings and their predecessors only; it knows nothing of joints. It also notices rates that
/// look like deg/s and specific forces that look like g, which no single reading shows.
#ifndef JCAL_GATE_H
#define JCAL_GATE_H

#include "jointcal/private/gate.h"
#include "jointcal/reject.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Limits of the gate.
typedef struct {
    /// Largest believable component of a rate, rad/s. Range [1, 200], default 36 (2000 deg/s and a little).
    float gyr_max_rad_s;
    /// Largest believable component of a specific force, m/s^2. Range [20, 4000], default 320 (32 g and a little).
    float acc_max_m_s2;
    float frozen_s;  ///< Longest believable repetition of a reading, s. Range [0.02, 10], default 0.3.
    /// Longest distance of two samples that still counts as continuous, s. Range [0.02, 10], default 0.25.
    float gap_s;
} jcal_gate_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_gate_config_t jcal_gate_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_gate_config_check(const jcal_gate_config_t *config);

/// Empties the gate.
/// Threads:  one caller at a time; inside push it is push.
void jcal_gate_init(jcal_gate_t *self);

/// Checks one sample pair against a valid config, remembers it and counts the outcome.
///
/// Returns:  JCAL_REJECT_NONE, or the cause that counts.
/// Cost:     constant, about 150 floating-point operations; no square root but two.
/// Threads:  one caller at a time; inside push it is push.
jcal_reject_t jcal_gate_check(jcal_gate_t *self, const jcal_gate_config_t *config, const jcal_pair_t *pair);

/// What is wrong with the stream as a whole: JCAL_REASON_NONE, _RATE_TOO_LOW, _WRONG_UNITS_GYR, _WRONG_UNITS_ACC or
/// _BAD_SAMPLES.
/// Threads:  one caller at a time; inside push it is push.
jcal_reason_t jcal_gate_complaint(const jcal_gate_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_GATE_H */

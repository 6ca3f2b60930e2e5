/* SPDX-License-Identifier: MIT */
/// @file
/// Decides for every incoming sample pair whether it may be used, and counts why not.
///
/// The gate looks at readings and their predecessors only; it knows nothing of joints. It also notices rates that
/// look like deg/s and specific forces that look like g, which no single reading shows.
#ifndef JCAL_GATE_H
#define JCAL_GATE_H

#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Why a sample was not used; one cause counts: not finite, else time, else the first of the others. Also the index of its counter.
///
/// Time that does not increase is never believed again: after a wild time stamp far in the future, or a clock that starts
/// anew, every sample is rejected (and the status says `bad_samples`) until the caller resets.
typedef enum {
    JCAL_REJECT_NOT_FINITE = 0,    ///< A value is NaN or infinite.
    JCAL_REJECT_OUT_OF_RANGE = 1,  ///< Beyond what a sensor can read, or wrong units.
    JCAL_REJECT_SATURATED = 2,     ///< A component stands at its extreme: clipped.
    JCAL_REJECT_FROZEN = 3,        ///< A sensor has repeated itself for longer than `frozen_s`.
    JCAL_REJECT_REPEATED = 4,      ///< A sensor repeats its previous reading: a lost packet.
    JCAL_REJECT_TIME_ORDER = 5,    ///< Time did not increase.
    JCAL_REJECT_GAP = 6,           ///< First sample after a hole in time.
    JCAL_REJECT_COUNT = 7,         ///< Number of causes.
    JCAL_REJECT_NONE = 7           ///< The sample was accepted.
} jcal_reject_t;

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

/// Private: what the gate remembers of one sensor.
typedef struct {
    float last[6];        ///< Previous reading: rate, specific force.
    float extreme[6];     ///< Largest magnitude of each component so far.
    float gravity_m_s2;   ///< Magnitude of the specific force, averaged over about 1 s.
    float turn_measured;  ///< Leaky sum of |da|^2, the change of the specific force from sample to sample.
    float turn_expected;  ///< Leaky sum of |a x w dt|^2, the change that the rate alone would make.
    float repeated_s;     ///< How long the reading has stood still.
} jcal_gate_sensor_t;

/// The gate. Caller-owned, plain, copyable; all members are private.
typedef struct {
    jcal_gate_sensor_t sensor1;
    jcal_gate_sensor_t sensor2;
    uint64_t last_us;
    uint32_t samples;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    float bad_share;        ///< Share of frozen and out-of-range samples, averaged over about 2 s of samples.
    float saturated_share;  ///< Share of saturated samples, averaged over about 10 s of samples.
    bool has_last;
} jcal_gate_t;

/// The defaults described at each field.
jcal_gate_config_t jcal_gate_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid.
const char *jcal_gate_config_check(const jcal_gate_config_t *config);

/// Empties the gate.
void jcal_gate_init(jcal_gate_t *self);

/// Checks one sample pair against a valid config, remembers it and counts the outcome.
///
/// Returns:  JCAL_REJECT_NONE, or the cause that counts.
/// Cost:     constant, about 150 floating-point operations; no square root but two.
jcal_reject_t jcal_gate_check(jcal_gate_t *self, const jcal_gate_config_t *config, const jcal_pair_t *pair);

/// What is wrong with the stream as a whole: JCAL_REASON_NONE, _WRONG_UNITS_GYR, _WRONG_UNITS_ACC or _BAD_SAMPLES.
jcal_reason_t jcal_gate_complaint(const jcal_gate_t *self);

/// Name as used in `rejected_by`: `not_finite`, `out_of_range`, ...; `accepted` for JCAL_REJECT_NONE; never null.
const char *jcal_reject_string(jcal_reject_t reject);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_GATE_H */

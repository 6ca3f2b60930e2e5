/* SPDX-License-Identifier: MIT */
/// @file
/// State of the gates for readings and for orientations. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_GATE_H
#define JCAL_PRIVATE_GATE_H

#include "jointcal/reject.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the gate remembers of one sensor.
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

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_GATE_H */

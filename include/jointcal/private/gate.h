/* SPDX-License-Identifier: MIT */
/// @file
/// State of the gate for readings. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_GATE_H
#define JCAL_PRIVATE_GATE_H

#include "jointcal/private/clock.h"
#include "jointcal/reject.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the gate remembers of one sensor.
typedef struct {
    float last[6];  ///< Previous reading: rate, specific force.
    /// Largest magnitude that each component held, fading, in 65535ths of the largest believable one.
    uint16_t extreme[6];
    float gravity_m_s2;  ///< Magnitude of the specific force, averaged over about 1 s.
    float turns;         ///< Turns that were compared, the older ones less ...
    /// ... and the sum of |da|^2 / |a x angle|^2 over them: how gravity turned beside what the rates say.
    float turned;
    /// What is suspected of the rates and of the specific forces: 0 nothing; 1, 2, 3: that component stands still; 4, 5, 6: x and y, y
    /// and z, z and x are the same; 7: all stand ...
    uint8_t suspicion[2];
    /// ... and how much speaks for it, in units of lib/sample/sensor.c; 0 when a reading speaks against it.
    uint16_t total[2];
    uint16_t repeated;  ///< How long the whole reading has stood still, 1/4096 s.
} jcal_gate_sensor_t;

/// A turn of one sensor on its way.
typedef struct {
    jcal_vec3_t from_m_s2;  ///< Specific force where it began.
    jcal_vec3_t angle_rad;  ///< Integral of the rates since.
    float time_s;           ///< Its time; 0: none has begun.
    uint8_t sensor;         ///< 1 or 2, taking turns; 0 before any.
    bool has_first;         ///< Of the gate: there was a sample with believable values.
} jcal_gate_turn_t;

/// The gate. Caller-owned, plain, copyable; all members are private.
typedef struct {
    jcal_gate_sensor_t sensor1;
    jcal_gate_sensor_t sensor2;
    jcal_clock_t clock;
    jcal_gate_turn_t turn;
    uint32_t samples;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    float bad_share;        ///< Share of frozen and out-of-range samples, averaged over about 2 s of samples.
    float saturated_share;  ///< Share of saturated samples, averaged over about 10 s of samples.
} jcal_gate_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_GATE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// What is believed of what a joint's engine says. Private.
///
/// An engine sees two sensors and takes their times and values for what they are. What is known of the sensors beside stands above it:
///
///     a sensor is named bad                      collecting, sensor_bad, check_sensors: nothing that the engine says is worth telling
///     it was told that they share no joint       collecting, not_one_joint, check_sensors, for a minute after the engine said so last
///     the engine is ready, the lag not known     collecting, out_of_step, move_joint: times may be wrong by more than the bounds hold for
///     else                                       what the engine says
#ifndef JCAL_BODY_TRUST_H
#define JCAL_BODY_TRUST_H

#include "jointcal/head.h"
#include "jointcal/health.h"

/// What is known of the two sensors of a joint.
typedef struct {
    uint16_t bad1, bad2;  ///< Findings that are named, a bit for each.
    bool not_one;         ///< It was told that the two share no joint.
    bool lag_known;
} jcal_trust_t;

/// Findings that make results worthless. The others a joint meets by itself: its gate and its filters see gaps, uneven times, frozen
/// stretches and vibration.
#define JCAL_TRUST_BAD                                                                                                 \
    ((1u << (unsigned)JCAL_FINDING_HELD) | (1u << (unsigned)JCAL_FINDING_DEAD) |                                       \
     (1u << (unsigned)JCAL_FINDING_CLIPPED) | (1u << (unsigned)JCAL_FINDING_NO_GRAVITY) |                              \
     (1u << (unsigned)JCAL_FINDING_GRAVITY_OFF) | (1u << (unsigned)JCAL_FINDING_RATE_UNIT) |                           \
     (1u << (unsigned)JCAL_FINDING_FRAMES) | (1u << (unsigned)JCAL_FINDING_SCALE))

/// Changes `head` to what is believed.
void jcal_trust(const jcal_trust_t *trust, jcal_head_t *head);

/// What is named of a sensor after an examination said `result`: what it names comes in, what it shows to be fine goes, and of what it
/// does not tell stays what was.
uint16_t jcal_trust_findings(uint16_t before, const jcal_health_result_t *result);

#endif /* JCAL_BODY_TRUST_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Pairs of readings at common times, of two sensors that read when they like.
///
/// Rates may differ, 25 to 400 Hz, times jitter, packets be lost, and one sensor may be ahead of the other by JCAL_PAIRING_WAITING periods.
/// Pairs are at multiples of the period, whatever comes; each sensor's reading there lies on the straight line between its readings before
/// and after. All times are those of one clock, the hub's. What they are wrong by between the sensors lag.h finds out.
///
/// How it is used:
///
///     static jcal_pairing_t knee;
///     const jcal_pairing_config_t config = jcal_pairing_config_default();
///     if (jcal_pairing_init(&knee, &config) != JCAL_OK) { ... }
///     (void)jcal_pairing_push(&knee, 1u, &reading);          for each reading, as it comes, of sensor 1 or 2
///     jcal_pair_t pair;
///     while (jcal_pairing_pull(&knee, &pair) == JCAL_OK) {   then everything that it made
///         ... jcal_hinge_push(&hinge, &pair) ...
///     }
///
/// What is not interpolated. Where two readings of a sensor are further apart than gap_s there are no pairs between them: the next pair's
/// time has jumped, which the gate of every joint sees. A reading with a number that no sensor makes counts as lost.
///
/// What interpolation costs: a sine of frequency f, read every h s, loses at most (pi f h)^2 / 2 of itself in the middle between two
/// readings, two thirds of that in the mean: of 1 Hz 0.05 % at 100 Hz and 0.8 % at 25 Hz, of 5 Hz 1.2 and 20 %. It is not delayed.
/// Noise becomes smaller where it falls between two readings, by up to the root of 2.
///
/// Cost: 1.2 KiB of state. Units: types.h. Method: docs/METHOD_SENSORS.md, section 2.
/// Threads: all calls on one pairing belong to one task, or behind the caller's lock.
#ifndef JCAL_PAIRING_H
#define JCAL_PAIRING_H

#include "jointcal/lag.h"
#include "jointcal/pairing_config.h"
#include "jointcal/private/pairing/stream.h"
#include "jointcal/sensor.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Largest lag that may be taken off in all, s.
#define JCAL_PAIRING_SHIFT_MAX_S 0.3f
/// Time without pairs after a lag was taken off, us: all that follows shall see a gap.
#define JCAL_PAIRING_HOLE_US 300000u

/// What became of the readings.
typedef struct {
    float shift_s;      ///< Lag that is taken off: sensor 2's times less this are sensor 1's.
    uint32_t pairs;     ///< Pairs that were handed out.
    uint32_t lost1;     ///< Common times that only sensor 1 told of: the other one had a gap, or was too late.
    uint32_t lost2;     ///< The same of sensor 2.
    uint32_t rejected;  ///< Readings: time that does not increase, numbers that no sensor makes.
    unsigned waiting;   ///< Readings that wait now ...
    unsigned ahead;     ///< ... and whose they are: 1 or 2.
} jcal_pairing_result_t;

/// Prepares a pairing; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_pairing_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_pairing_init(jcal_pairing_t *self, const jcal_pairing_config_t *config);

/// Takes in a reading of sensor `which`, 1 or 2. Pairs of the push before that were not pulled are lost.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted) if its time does not increase or a number is one that no sensor makes; JCAL_ERR_ARG.
///           A clock that goes back is believed after 0.4 s (types.h); pairs then go back, too.
/// Cost:     at most gap_s / period_s interpolations of six numbers, and as many readings that are dropped as can wait: at equal rates 320
///           instructions on a Cortex-M4F, 380 at most, and a pull 70, 140 at most.
jcal_status_t jcal_pairing_push(jcal_pairing_t *self, unsigned which, const jcal_reading_t *reading);

/// The next pair, if there is one.
///
/// Returns:  JCAL_OK; JCAL_IDLE if there is none, pair untouched; JCAL_ERR_ARG.
/// Cost:     one interpolation, and as many readings that are dropped as can wait. At most gap_s / period_s pairs follow a push.
jcal_status_t jcal_pairing_pull(jcal_pairing_t *self, jcal_pair_t *pair);

/// Takes `lag_s` more off sensor 2's times, and makes a hole in the pairs that everything behind it takes for a gap. Readings that wait
/// are lost.
///
/// Errors:   JCAL_ERR_ARG: null, or more than JCAL_PAIRING_SHIFT_MAX_S in all; self untouched.
jcal_status_t jcal_pairing_shift(jcal_pairing_t *self, float lag_s);

/// Takes off what the estimator of the lag says is to be taken off. Call it after jcal_lag_step.
///
/// Returns:  JCAL_OK: it was; JCAL_IDLE: nothing is to be; JCAL_ERR_ARG: null, or the shift is refused (jcal_pairing_shift); then the lag
///           counts as left, both untouched.
jcal_status_t jcal_pairing_align(jcal_pairing_t *self, jcal_lag_t *lag);

/// Copies the counters. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_pairing_get(const jcal_pairing_t *self, jcal_pairing_result_t *out);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PAIRING_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// By how much the times of two sensors of one joint are wrong against each other.
///
/// What both sensors share is the velocity of the joint's centre, 0.4 to 3 Hz; the lag at which they agree best is the lag of their times.
/// No axis is asked for, and any joint will do: hinges, two axes, balls, the rig and people. Two sensors that share no joint agree at no
/// lag, and nothing is known then.
///
/// How it is used, behind a pairing (pairing.h):
///
///     static jcal_lag_t lag;
///     (void)jcal_lag_init(&lag);
///     (void)jcal_lag_add(&lag, &tick1, &tick2);      for each pair of ticks that sensors (sensor.h) made of the pairs
///     (void)jcal_lag_step(&lag);                     a slice of work for each pair, say
///     (void)jcal_pairing_align(&knee, &lag);         takes the lag off once it is sure
///     jcal_lag_result_t result;
///     (void)jcal_lag_get(&lag, &result);
///
/// The lag is found within +-0.25 s, to some milliseconds, after some seconds of motion, and is then to be taken off. Once it is known the
/// estimator may be used for another joint.
///
/// Cost: 4.3 KiB of state. Units and frames: types.h.
/// Method: docs/METHOD_SENSORS.md, section 3; float64 reference: tools/python/jointcal_tools/lag_reference.py.
/// Threads: all calls on one estimator belong to one task, or behind the caller's lock.
#ifndef JCAL_LAG_H
#define JCAL_LAG_H

#include "jointcal/private/pairing/lag.h"
#include "jointcal/status.h"
#include "jointcal/tick.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Bound of a lag that is not known, s.
#define JCAL_LAG_UNKNOWN_S 1.0f

/// What is known of the lag.
typedef struct {
    /// Three judgements in a row agreed within their bounds, at most 10 ms, nothing else explained the motion as well, and none since speaks against it.
    bool lag_known;
    float lag_s;    ///< Sensor 2's times are late by it, what was taken off included; that alone while it is not known.
    float bound_s;  ///< 95 % bound of it; JCAL_LAG_UNKNOWN_S while it is not known.
    float taken_s;  ///< Part of lag_s that was taken off.
    float left;     ///< Share of the centre's squared velocity that no lag explains; 1 before any judgement.
    float motion_s;  ///< Motion that was summed, s.
} jcal_lag_result_t;

/// Prepares an estimator; whatever `self` held before is lost. Errors: JCAL_ERR_ARG (null).
JCAL_MUST_CHECK jcal_status_t jcal_lag_init(jcal_lag_t *self);

/// Takes in the ticks of both sensors of the same time: sums only. Those of the first 2 s after a gap say too little, and are left out.
///
/// Returns:  JCAL_OK; JCAL_REJECTED if the times differ or do not increase, or a number is one that no sensor makes; JCAL_ERR_ARG.
/// Cost:     about 800 multiply-adds, 5,500 instructions on a Cortex-M4F.
jcal_status_t jcal_lag_add(jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// One bounded slice of solving: one a hundredth of a second judges every 1.5 s.
///
/// Returns:  JCAL_OK; JCAL_IDLE if there is too little to judge yet; JCAL_ERR_ARG.
/// Cost:     about 1000 multiply-adds, at most 5,700 instructions on a Cortex-M4F, 3,200 in the mean; stack 0.9 KiB.
jcal_status_t jcal_lag_step(jcal_lag_t *self);

/// What is to be taken off sensor 2's times from now on, s; 0: nothing, or null.
float jcal_lag_due(const jcal_lag_t *self);

/// The same, and it counts as taken off: all sums begin anew. jcal_pairing_align does both.
float jcal_lag_take(jcal_lag_t *self);

/// Copies what is known. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_lag_get(const jcal_lag_t *self, jcal_lag_result_t *out);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_LAG_H */

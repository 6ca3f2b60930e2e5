/* SPDX-License-Identifier: MIT */
/// @file
/// A calibration of yesterday, until motion confirms it or speaks against it.
///
/// Sensors are put on anew every day: turned on the strap, upside down, on each other's place, on another person. What was kept may be
/// shown meanwhile, as remembered; it is not known. Some seconds of motion say whether the same axes, levers and signs still explain
/// what both sensors feel.
///
///     static jcal_remember_t knee;
///     jcal_kept_t kept;
///     const jcal_kept_refusal_t refusal = jcal_keep_load(&flash, &wanted, &kept);
///     (void)jcal_remember_init(&knee, &kept, refusal);
///     (void)jcal_remember_add(&knee, &thigh_tick, &shank_tick);    for each pair of ticks of the same time, as functional.h
///     (void)jcal_remember_step(&knee);                             until JCAL_IDLE, or once for each reading
///     jcal_remember_result_t result;
///     (void)jcal_remember_get(&knee, &result);
///
/// The joint's own estimator runs beside it. If that is ready first, jcal_remember_settle compares both.
///
/// What motion must show, of a hinge: that both axes are within the limit of the model, 3 deg (rigid) or 10 deg (functional), of where
/// they were, whatever direction they might have moved in; the pairing of the signs; and, where levers were kept, that the joint's centre
/// moves as one point. A joint that does not bend, or motion in one plane, shows too little: it stays remembered, for ever if need be. A
/// turn of a sensor about the joint's own axis changes no axis and is not seen; the zero of the angle is the user's to set again.
/// Of two axes and of a ball joint only the levers are looked at: they may be dropped, and are confirmed by jcal_remember_settle alone.
///
/// Units and frames: types.h. Cost: 1 KiB of state. Until it is confirmed or dropped an add takes 1,800 instructions on a Cortex-M4F, a slice at
/// most 5,100, and there are three slices every quarter of a second: 900 per reading at 100 Hz. Method, measured: docs/METHOD_HUB.md, section 4.
/// Threads:  all calls on one of these belong to one task.
#ifndef JCAL_REMEMBER_H
#define JCAL_REMEMBER_H

#include "jointcal/keep.h"
#include "jointcal/private/remember/state.h"
#include "jointcal/status.h"
#include "jointcal/tick.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How far it is to be believed.
typedef enum {
    JCAL_REMEMBERED = 0,          ///< Not confirmed yet.
    JCAL_REMEMBER_CONFIRMED = 1,  ///< It still holds, within the bounds of the result.
    JCAL_REMEMBER_DROPPED = 2     ///< It does not; `reason` says why.
} jcal_remember_state_t;

/// Why it was dropped, or what is missing until it is confirmed.
typedef enum {
    JCAL_REMEMBER_NONE = 0,  ///< Confirmed.
    JCAL_REMEMBER_NO_RECORD =
        1,  ///< Dropped: nothing was kept, or it was refused as damaged, of another version or kind.
    JCAL_REMEMBER_OTHER_SENSORS = 2,  ///< Dropped: other serial numbers.
    JCAL_REMEMBER_AXES = 3,       ///< Dropped: an axis is elsewhere. Remembered: axes are not known well enough yet.
    JCAL_REMEMBER_PLACES = 4,     ///< The centre does not move as one point with these levers, or not enough to tell.
    JCAL_REMEMBER_SENSE = 5,      ///< The other pairing of signs explains the motion better, or as well.
    JCAL_REMEMBER_NO_MOTION = 6,  ///< Remembered: 2 s of motion are needed, in which the joint bends.
    JCAL_REMEMBER_ESTIMATE = 7    ///< Dropped: the joint's own estimator found something else.
} jcal_remember_reason_t;

/// What is said of it.
typedef struct {
    jcal_remember_state_t state;
    jcal_remember_reason_t reason;
    /// 95 % bounds of the axes; while remembered a right angle. Once confirmed: the kept ones, or what motion showed, the larger.
    float bound1_rad, bound2_rad;
    float motion_s;  ///< Motion so far, s.
} jcal_remember_result_t;

/// Begins with what flash gave: `kept` is read if `refusal` is JCAL_KEPT_FITS only; else it is dropped at once, for that reason.
///
/// Errors:   JCAL_ERR_ARG (null, or values that no record has); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_remember_init(jcal_remember_t *self, const jcal_kept_t *kept,
                                                 jcal_kept_refusal_t refusal);

/// Takes in the ticks of both sensors of the same time: sums only. Nothing is taken in once it is confirmed or dropped.
///
/// Returns:  JCAL_OK; JCAL_REJECTED if the times differ or do not increase, or a number is one that no sensor makes; JCAL_ERR_ARG.
jcal_status_t jcal_remember_add(jcal_remember_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// One bounded slice of looking. Returns: JCAL_OK; JCAL_IDLE if nothing is due; JCAL_ERR_ARG.
jcal_status_t jcal_remember_step(jcal_remember_t *self);

/// The joint's own estimator has become ready and says `now` (jcal_kept_from_hinge ...). What is still remembered becomes confirmed if each
/// axis, and each lever with a bound, is within the root of both bounds' squares; else it is dropped. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_remember_settle(jcal_remember_t *self, const jcal_kept_t *now);

/// True if two records are of one joint as far as their bounds tell: what jcal_remember_settle asks. False for null.
bool jcal_remember_agrees(const jcal_kept_t *kept, const jcal_kept_t *now);

/// Copies what is said. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_remember_get(const jcal_remember_t *self, jcal_remember_result_t *out);

/// `remembered`, `confirmed`, `dropped`; never null.
const char *jcal_remember_state_string(jcal_remember_state_t state);
/// `no_record`, `other_sensors`, `axes`, `places`, `sense`, `no_motion`, `estimate`; null for JCAL_REMEMBER_NONE.
const char *jcal_remember_reason_string(jcal_remember_reason_t reason);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_REMEMBER_H */

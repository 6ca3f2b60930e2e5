/* SPDX-License-Identifier: MIT */
/// @file
/// Kept calibrations of a body's joints: read one after the other, looked at some at a time, confirmed or dropped. Private.
///
/// Their looks and the estimator of the lag share one piece of memory: kept calibrations come first, and the lag waits for it. A joint whose sensors
/// do not move gives its place to another; if none moves, the lag has the memory for a minute. docs/METHOD_HUB.md, section 4.
#ifndef JCAL_BODY_RESTORE_H
#define JCAL_BODY_RESTORE_H

#include "jointcal/body.h"

/// What became of a joint's kept calibration.
typedef enum {
    JCAL_BODY_KEPT_NONE = 0,       ///< There is none.
    JCAL_BODY_KEPT_TO_READ = 1,    ///< It is to be read.
    JCAL_BODY_KEPT_WAITS = 2,      ///< Remembered: it waits for a place,
    JCAL_BODY_KEPT_LOOKED_AT = 3,  ///< has one,
    JCAL_BODY_KEPT_STILL = 4,      ///< gave it back, for nothing moved,
    JCAL_BODY_KEPT_LEFT = 5,       ///< or is left to the joint's own estimator.
    JCAL_BODY_KEPT_CONFIRMED = 6,  ///< By motion; it is compared once the joint's own estimator is ready.
    JCAL_BODY_KEPT_SETTLED = 7,    ///< Confirmed by the joint's own estimator.
    JCAL_BODY_KEPT_DROPPED = 8
} jcal_body_kept_phase_t;

/// The power came: all that is kept is to be read, if there is a flash.
void jcal_body_restore_begin(jcal_body_t *self);

/// Takes in the ticks of a joint whose kept calibration is looked at.
void jcal_body_restore_add(jcal_body_t *self, unsigned joint, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// Reads a record, does a slice of a look, or gives places; false if nothing was due.
bool jcal_body_restore_step(jcal_body_t *self);

/// True if the shared memory is in use here, or is wanted: no lag may begin.
bool jcal_body_restore_first(const jcal_body_t *self);

/// A joint is ready: by its own estimator, unless it sleeps with what was handed over. What was kept is confirmed or dropped.
void jcal_body_restore_settle(jcal_body_t *self, unsigned joint);

/// A sensor of a joint slipped: what was confirmed does not hold any more.
void jcal_body_restore_moved(jcal_body_t *self, unsigned joint);

/// A joint's estimator began anew, for its lag was another: what was not dropped is looked at again.
void jcal_body_restore_again(jcal_body_t *self, unsigned joint);

/// True if motion is to confirm what was kept of a hinge.
bool jcal_body_restore_waits(const jcal_body_t *self, unsigned joint);

/// Fills in has_kept, kept and kept_reason.
void jcal_body_restore_report(const jcal_body_t *self, unsigned joint, jcal_body_joint_result_t *out);

#endif /* JCAL_BODY_RESTORE_H */

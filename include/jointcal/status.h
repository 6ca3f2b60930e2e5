/* SPDX-License-Identifier: MIT */
/// @file
/// Words that every estimator shares: call results, calibration status, reasons.
///
/// A call result (jcal_status_t) says whether a call was understood. A calibration status (jcal_calibration_t)
/// says what is known about the joint. They are never mixed: a call can succeed while nothing is calibrated yet.
#ifndef JCAL_STATUS_H
#define JCAL_STATUS_H

#include "jointcal/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Result of a call. Zero is success, negative values are errors, positive values are notices.
typedef enum {
    JCAL_OK = 0,            ///< Done.
    JCAL_REJECTED = 1,      ///< push: the sample was understood and not used; head.rejected_by counts why.
    JCAL_IDLE = 2,          ///< step: no sample was waiting.
    JCAL_TICK = 3,          ///< push of a sensor: done, and there are new features.
    JCAL_ERR_ARG = -1,      ///< A pointer is null or an argument is outside its documented range.
    JCAL_ERR_CONFIG = -2,   ///< A field of the config is not finite or outside its documented range.
    JCAL_ERR_STORAGE = -3,  ///< The storage handed over is too small or not aligned.
    JCAL_ERR_FULL = -4,     ///< push: the inbox is full because step is not called often enough.
    JCAL_ERR_FLASH = -5     ///< The flash failed, or reads other than what was written.
} jcal_status_t;

/// What is known about the joint.
typedef enum {
    JCAL_COLLECTING = 0,  ///< Not known well enough; `reason`, `weak` and `hint` say why.
    JCAL_AMBIGUOUS = 1,   ///< Separated minima (or both sign pairings of a hinge) explain the data about equally.
    JCAL_READY = 2,       ///< Every bound holds, the data fit the model, nothing else explains them as well.
    JCAL_MOVED = 3        ///< After ready, the data no longer fit: a sensor slipped. It begins again.
} jcal_calibration_t;

/// Which engine made a result.
typedef enum {
    JCAL_ENGINE_STREAM = 0,  ///< Moments, constant memory: the default.
    JCAL_ENGINE_WINDOW = 1   ///< Selected samples in a buffer, as in the papers.
} jcal_engine_t;

/// The unknown that is known worst.
typedef enum {
    JCAL_WEAK_NONE = 0,
    JCAL_WEAK_AXIS1 = 1,    ///< Axis in sensor frame 1.
    JCAL_WEAK_AXIS2 = 2,    ///< Axis in sensor frame 2.
    JCAL_WEAK_SIGN = 3,     ///< Sign pairing of the two axes.
    JCAL_WEAK_HEADING = 4,  ///< Heading offset of the two orientations.
    JCAL_WEAK_CENTER1 = 5,  ///< Joint centre as seen from sensor 1.
    JCAL_WEAK_CENTER2 = 6   ///< Joint centre as seen from sensor 2.
} jcal_weak_t;

/// The motion that would help most.
typedef enum {
    JCAL_HINT_NONE = 0,
    JCAL_HINT_MOVE_JOINT = 1,     ///< Bend and stretch the joint; the two segments must turn differently.
    JCAL_HINT_MOVE_SEGMENT1 = 2,  ///< Turn the proximal segment.
    JCAL_HINT_MOVE_SEGMENT2 = 3,  ///< Turn the distal segment.
    JCAL_HINT_TILT_AXIS = 4,      ///< Tilt the joint axis out of the horizontal, so that gravity shows its sense.
    /// More of the same motion will not help: units, range, mounting or pairing are wrong.
    JCAL_HINT_CHECK_SENSORS = 5,
    JCAL_HINT_MORE_DIRECTIONS = 6,  ///< Turn both segments about other axes too: so far a direction is left open.
    JCAL_HINT_MOVE_FASTER = 7,      ///< Move faster, so that the joint itself is accelerated.
    JCAL_HINT_BEND_ONLY = 8,        ///< Of a joint with two axes: bend and stretch only, for ten seconds.
    JCAL_HINT_TURN_ONLY =
        9  ///< Of a joint with two axes: turn the distal segment about its own line only, for ten seconds.
} jcal_hint_t;

/// Why the status is not `ready`.
typedef enum {
    JCAL_REASON_NONE = 0,
    JCAL_REASON_NO_DATA = 1,        ///< Too few accepted samples yet.
    JCAL_REASON_NO_MOTION = 2,      ///< The segments hardly turn against each other.
    JCAL_REASON_UNCERTAIN = 3,      ///< A bound is above its limit.
    JCAL_REASON_SIGN_OPEN = 4,      ///< Both sign pairings explain the data about equally.
    JCAL_REASON_OTHER_MINIMUM = 5,  ///< Other axes explain the data about equally well.
    JCAL_REASON_DOES_NOT_FIT =
        6,                        ///< No joint of this kind explains the data: other joint, or sensors that share none.
    JCAL_REASON_BAD_SAMPLES = 7,  ///< Too many samples are rejected (saturated, frozen, repeated ...).
    JCAL_REASON_WRONG_UNITS_GYR = 8,  ///< Angular rates look like deg/s.
    JCAL_REASON_WRONG_UNITS_ACC = 9,  ///< Accelerations look like g.
    JCAL_REASON_RATE_TOO_LOW = 10,    ///< Fewer than 10 samples a second.
    JCAL_REASON_GRAVITY_OFF = 11,     ///< A sensor's specific force is not near 9.81 m/s^2 in the median.
    /// The two accelerations do not belong to one joint: other pair, not the same time, or frames of gyroscope and accelerometer differ.
    JCAL_REASON_NOT_ONE_JOINT = 12,
    JCAL_REASON_NO_BEND = 13,    ///< The segments move, but the joint between them hardly bends.
    JCAL_REASON_MORE_AXES = 14,  ///< The joint turns about more than one axis.
    JCAL_REASON_SENSOR_BAD =
        15,  ///< Something is named of a sensor of the joint that makes results worthless: health.h.
    JCAL_REASON_OUT_OF_STEP = 16  ///< The lag of the two sensors is not known yet: lag.h.
} jcal_reason_t;

/// Short English text for a call result; never null. Threads: no state.
const char *jcal_status_string(jcal_status_t status);
/// `collecting`, `ambiguous`, `ready`, `moved`; never null. Threads: no state.
const char *jcal_calibration_string(jcal_calibration_t calibration);
/// `stream` or `window`; never null. Threads: no state.
const char *jcal_engine_string(jcal_engine_t engine);
/// `axis1`, `axis2`, `sign`, `heading`, `center1`, `center2`; null for JCAL_WEAK_NONE. Threads: no state.
const char *jcal_weak_string(jcal_weak_t weak);
/// `move_joint`, ...; null for JCAL_HINT_NONE. Threads: no state.
const char *jcal_hint_string(jcal_hint_t hint);
/// `no_data`, `does_not_fit`, ...; null for JCAL_REASON_NONE. Threads: no state.
const char *jcal_reason_string(jcal_reason_t reason);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_STATUS_H */

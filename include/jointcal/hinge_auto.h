/* SPDX-License-Identifier: MIT */
/// @file
/// A hinge on a rig or on a person: both models on the same readings, and the one that holds is reported.
///
/// Rigid segments have axes that are exact, and the rigid model (hinge.h) finds them to a fraction of a degree. On a person it never
/// fits, and rightly: skin moves. There the functional model (functional.h) finds the axis that explains most of the bending, and what
/// that is worth in degrees of flexion. The functional model speaks only where the rates show that the segments are not rigid;
/// and a rigid hinge is believed only if the functional model has nothing against it.
///
/// A joint with two axes is a hinge as long as only one of them moves: ready then holds for that motion, and ends, with more_axes or
/// does_not_fit, within seconds after the other axis begins to move.
///
/// How it is used:
///
///     static jcal_hinge_auto_t knee;
///     const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
///     if (jcal_hinge_auto_init(&knee, &config) != JCAL_OK) { ... }
///     (void)jcal_hinge_auto_update(&knee, &pair);                  for each pair of readings
///     jcal_hinge_auto_result_t result;
///     (void)jcal_hinge_auto_get(&knee, &result);                   whenever you like
///     if (result.ready_for != JCAL_FOR_NOTHING) { ... jcal_hinge_auto_flexion(&knee) ... }
///
/// Units and frames: types.h. Cost: 6.2 KiB of state; docs/measurements/budget.md has the instructions of both parts. Where one sensor
/// serves two joints, or work must be spread finer, use sensor.h, functional.h and hinge.h themselves.
#ifndef JCAL_HINGE_AUTO_H
#define JCAL_HINGE_AUTO_H

#include "jointcal/functional_config.h"
#include "jointcal/hinge.h"
#include "jointcal/private/auto/hinge.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Which model the axes are of.
typedef enum {
    JCAL_MODEL_RIGID = 0,      ///< Rigid segments: the axes are the joint's own.
    JCAL_MODEL_FUNCTIONAL = 1  ///< The axes that explain most of a person's motion.
} jcal_model_t;

/// What a calibration is good for.
typedef enum {
    JCAL_FOR_NOTHING = 0,  ///< Not ready.
    JCAL_FOR_AXES = 1,     ///< Both axes are within max_bound_rad, and so is whatever is made of them.
    JCAL_FOR_FLEXION = 2,  ///< The angle of the joint is within max_flexion_rad; the axes are further off.
    JCAL_FOR_ANGLES = 3    ///< The angles of a person's joint (two_dof_auto.h): axes and heading are within its limits.
} jcal_ready_for_t;

/// Settings: those of the rigid model, and the limit of the angle's error.
typedef struct {
    jcal_hinge_config_t hinge;  ///< max_bound_rad, sign_hint and axis1_toward hold for both models.
    float max_flexion_rad;      ///< As of functional_config.h. Range [0.001, 0.5], default 3 deg.
} jcal_hinge_auto_config_t;

/// What a hinge of either kind says.
typedef struct {
    jcal_hinge_result_t hinge;  ///< Status, axes and bounds of the model in use.
    jcal_model_t model;
    jcal_ready_for_t ready_for;
    float flexion_uncertainty_rad;   ///< Error that the axes make in the joint's angle, rms; a right angle if unknown.
    float bend_rad;                  ///< How far the joint bent so far, rms about its mean; 0 before anything is known.
    float gravity_off_m_s2;          ///< As of functional.h.
    jcal_heading_t heading;          ///< Level frame of sensor 2 to that of sensor 1, now.
    bool has_levers;                 ///< The places below are known; of how well nothing is said yet.
    jcal_vec3_t joint_to_sensor1_m;  ///< In sensor frame 1.
    jcal_vec3_t joint_to_sensor2_m;  ///< In sensor frame 2.
} jcal_hinge_auto_result_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_hinge_auto_config_t jcal_hinge_auto_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_hinge_auto_config_check(const jcal_hinge_auto_config_t *config);

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG; self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_auto_init(jcal_hinge_auto_t *self, const jcal_hinge_auto_config_t *config);

/// Puts a pair of readings into the inbox; step takes it out, checks it and works off what is due. Copies only: may run in an interrupt.
///
/// Returns:  JCAL_OK; JCAL_ERR_ARG; JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_hinge_auto_push(jcal_hinge_auto_t *self, const jcal_pair_t *pair);

/// Works off one pair of the inbox.
///
/// Returns:  what update returns of it; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_hinge_auto_step(jcal_hinge_auto_t *self);

/// Takes in a pair of readings, past the inbox, and works off what is due in both models.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL never.
/// Threads:  one task.
jcal_status_t jcal_hinge_auto_update(jcal_hinge_auto_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_hinge_auto_get(const jcal_hinge_auto_t *self, jcal_hinge_auto_result_t *out);

/// The joint's angle at the last pair, rad, positive about the reported axis: of which functional.h says more. NaN while unknown.
float jcal_hinge_auto_flexion(const jcal_hinge_auto_t *self);

/// Orientation of sensor 1 or 2 (`which`) to its level frame after the last pair.
jcal_quat_t jcal_hinge_auto_orientation(const jcal_hinge_auto_t *self, unsigned which);

/// `rigid` or `functional`; never null. Threads: no state.
const char *jcal_model_string(jcal_model_t model);
/// `axes`, `flexion`, `angles`; null for JCAL_FOR_NOTHING. Threads: no state.
const char *jcal_ready_for_string(jcal_ready_for_t ready_for);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_AUTO_H */

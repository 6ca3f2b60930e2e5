/* SPDX-License-Identifier: MIT */
/// @file
/// A joint with two axes on a rig or on a person: both models on the same readings, and the one that holds is reported.
///
/// On rigid segments the rigid model (two_dof.h) finds both axes and the heading to a degree from any motion about both. On a person it
/// never fits, and rightly: skin moves. There the functional model (two_axes.h) finds each axis from motion that is mostly about it. The
/// rigid model speaks where it is ready; else the functional one, once it knows something.
///
/// How it is used:
///
///     static jcal_two_dof_auto_t elbow;
///     const jcal_two_dof_auto_config_t config = jcal_two_dof_auto_config_default();
///     if (jcal_two_dof_auto_init(&elbow, &config) != JCAL_OK) { ... }
///     (void)jcal_two_dof_auto_update(&elbow, &pair, NULL);          for each pair of readings
///     jcal_two_dof_auto_result_t result;
///     (void)jcal_two_dof_auto_get(&elbow, &result);                 whenever you like
///     if (result.ready_for != JCAL_FOR_NOTHING) { ... joint_angles.h, jcal_two_dof_auto_orientation ... }
///
/// Units and frames: types.h. Cost: 7.2 KiB of state. Where one sensor serves two joints use sensor.h and two_axes.h themselves.
#ifndef JCAL_TWO_DOF_AUTO_H
#define JCAL_TWO_DOF_AUTO_H

#include "jointcal/hinge_auto.h"
#include "jointcal/orientation.h"
#include "jointcal/private/auto/two_dof.h"
#include "jointcal/two_axes.h"
#include "jointcal/two_dof.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of both models.
typedef struct {
    jcal_two_dof_config_t two_dof;  ///< max_bound_rad is what `for axes` means, of either model.
    jcal_two_axes_config_t people;  ///< Its limits are those of `for angles`.
} jcal_two_dof_auto_config_t;

/// What a joint with two axes of either kind says.
typedef struct {
    /// Of the model in use. Of the functional one an axis of which nothing is known is zero; the heading is that between the
    /// orientations of jcal_two_dof_auto_orientation; the carrying angle is 0 until both axes are known.
    jcal_two_dof_result_t two_dof;
    jcal_model_t model;
    jcal_ready_for_t ready_for;  ///< JCAL_FOR_AXES, JCAL_FOR_ANGLES or nothing.
    jcal_ball_result_t ball;     ///< Levers and heading of the functional model, whichever is in use.
    bool for_heading, for_axis1,
        for_axis2;  ///< What is known: by the rigid model all once it is ready, by the other each by itself.
} jcal_two_dof_auto_result_t;

/// The defaults of both models.
/// Threads:  no state.
jcal_two_dof_auto_config_t jcal_two_dof_auto_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_two_dof_auto_config_check(const jcal_two_dof_auto_config_t *config);

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG; self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_two_dof_auto_init(jcal_two_dof_auto_t *self,
                                                     const jcal_two_dof_auto_config_t *config);

/// Takes in a pair of readings and works off what is due in both models.
///
/// Inputs:   orientations of the same time for the rigid model, where the user has better ones; null: those that are made here.
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG.
/// Threads:  one task.
jcal_status_t jcal_two_dof_auto_update(jcal_two_dof_auto_t *self, const jcal_pair_t *pair,
                                       const jcal_orientation_pair_t *orientations);

/// Copies the current result. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_dof_auto_get(const jcal_two_dof_auto_t *self, jcal_two_dof_auto_result_t *out);

/// Orientation of sensor 1 or 2 (`which`) to its level frame after the last pair, as made here.
jcal_quat_t jcal_two_dof_auto_orientation(const jcal_two_dof_auto_t *self, unsigned which);

/// The orientations that are given began anew, with other headings: the rigid model forgets what it has, its counters too. The functional
/// one has orientations of its own. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_dof_auto_restart(jcal_two_dof_auto_t *self);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_dof_auto_reset(jcal_two_dof_auto_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_DOF_AUTO_H */

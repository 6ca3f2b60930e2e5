/* SPDX-License-Identifier: MIT */
/// @file
/// Joint with two axes, like elbow and forearm: both axes and the heading offset from orientations. Stream engine, and what both
/// engines say.
///
/// How it is used: as hinge.h, with pairs of orientations in place of readings.
///
///     static jcal_two_dof_t elbow;
///     const jcal_two_dof_config_t config = jcal_two_dof_config_default();
///     if (jcal_two_dof_init(&elbow, &config) != JCAL_OK) { ... }
///     (void)jcal_two_dof_update(&elbow, &orientations);
///     jcal_two_dof_result_t result;
///     (void)jcal_two_dof_get(&elbow, &result);
///
/// Unknowns are j1, fixed in segment 1, j2, fixed in segment 2, and the heading offset delta: v_E1 = Rz(delta) v_E2. Units and
/// frames: types.h. Settings: two_dof_config.h. Cost: 3.9 KiB of state; docs/measurements/budget.md has the instructions.
/// Source: [LAI22]; docs/METHOD_TWO_DOF.md derives what differs from it.
#ifndef JCAL_TWO_DOF_H
#define JCAL_TWO_DOF_H

#include "jointcal/head.h"
#include "jointcal/orientation.h"
#include "jointcal/private/two_dof/stream.h"
#include "jointcal/status.h"
#include "jointcal/two_dof_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What both engines say.
typedef struct {
    jcal_head_t head;
    bool has_axes;  ///< False until there is any estimate; until then axes, heading and carrying angle are zero.
    /// Unit axis j1 in sensor frame 1. It points towards axis1_toward of the config, or else its largest component is positive; once
    /// the status is `ready` it stays as it is then, until `moved`.
    jcal_vec3_t axis1;
    jcal_vec3_t axis2;         ///< Unit axis j2 in sensor frame 2, its sign likewise and separately.
    float heading_offset_rad;  ///< delta, in (-pi, pi]: turns earth frame 2 to earth frame 1 about z.
    float carrying_angle_rad;  ///< beta0: j1 . j2 = sin(beta0) in a common frame.
    /// 95 % bound of the angle between axis1 and the truth; JCAL_BOUND_UNKNOWN_RAD if unknown, as while other axes explain the data as well.
    float uncertainty1_rad;
    float uncertainty2_rad;         ///< The same for axis2.
    float uncertainty_heading_rad;  ///< 95 % bound of the error of the heading offset at the time t_us.
    float progress_axis1;           ///< 0 to 1: how far axis1 is on the way to its bound.
    float progress_axis2;           ///< The same for axis2.
    float progress_heading;         ///< The same for the heading offset.
} jcal_two_dof_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
/// A struct that this never prepared, all zero: push and step return JCAL_ERR_ARG, get knows nothing, reset returns JCAL_ERR_CONFIG.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_two_dof_config_check says which field); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_two_dof_init(jcal_two_dof_t *self, const jcal_two_dof_config_t *config);

/// Takes in one pair of orientations: checks it and keeps about 25 a second. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_two_dof_push(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair);

/// Works off one bounded share of what is to be done.
///
/// Returns:  JCAL_OK; JCAL_IDLE if there is nothing to do; JCAL_ERR_ARG.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_two_dof_step(jcal_two_dof_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_two_dof_update(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_two_dof_get(const jcal_two_dof_t *self, jcal_two_dof_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_two_dof_reset(jcal_two_dof_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_DOF_H */

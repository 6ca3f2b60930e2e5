/* SPDX-License-Identifier: MIT */
/// @file
/// A person's joint with two axes, like elbow and forearm: the axis of bending, fixed in the proximal segment, and the axis of turning,
/// fixed in the distal one; with heading and levers of ball.h.
///
/// Each axis is found where a motion is mostly about it: bend only, then turn only, for some seconds each, as often as one likes. No stretch
/// of time needs both, and what was found stays. Heading, axis 1 and axis 2 become known each by itself; which axis a motion is about is
/// told by the lever of sensor 2, which bending shows best.
///
/// Axis 2 is the distal segment's own line, as in a forearm: bending is what happens across the lever from the joint to sensor 2, turning what
/// happens along it. So sensor 2 must be on that segment, at least 10 cm from the joint and nearer to the line than to the joint. For
/// other joints with two axes, such as a wrist or a rig whose second axis is across its lever, use two_dof.h.
///
///     static jcal_two_axes_t elbow;
///     const jcal_two_axes_config_t config = jcal_two_axes_config_default();
///     if (jcal_two_axes_init(&elbow, &config) != JCAL_OK) { ... }
///     (void)jcal_two_axes_add(&elbow, &upper_arm_tick, &forearm_tick);    as in ball.h
///     (void)jcal_two_axes_step(&elbow);
///     jcal_two_axes_result_t result;
///     (void)jcal_two_axes_get(&elbow, &result);
///
/// The angles: joint_angles.h with axis1, axis2 and the heading. For rigid mounts two_dof.h is sharper.
/// Units and frames: types.h. Settings: two_axes_config.h. Cost: 1.4 KiB of state; docs/measurements/budget.md has the instructions.
/// Method: docs/METHOD_PEOPLE.md, section 11.
#ifndef JCAL_TWO_AXES_H
#define JCAL_TWO_AXES_H

#include "jointcal/ball.h"
#include "jointcal/private/two_axes/stream.h"
#include "jointcal/two_axes_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the joint says.
typedef struct {
    /// `ready`: heading and both axes are known. While it is not, `weak` and `hint` say what to do next, for the heading first, then axis 1,
    /// then axis 2.
    jcal_ball_result_t ball;  ///< `head` is that of the whole joint.
    bool for_heading;         ///< The heading is known; what ball.h calls ready.
    bool for_axis1,
        for_axis2;      ///< The bound of the axis is within max_bound_rad, and the motion is still that of one joint.
    jcal_vec3_t axis1;  ///< Unit axis of bending in sensor frame 1; zero while nothing is known of it.
    jcal_vec3_t axis2;  ///< Unit axis of turning in sensor frame 2; likewise.
    float uncertainty1_rad, uncertainty2_rad;  ///< 95 % bounds; a right angle if unknown.
    uint8_t windows1, windows2;  ///< Windows of 5 s, half of each new, that agree on the axis; the last 12 count.
    float progress_axis1, progress_axis2;  ///< 0 to 1: how far each is on the way to its limit.
} jcal_two_axes_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_two_axes_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_two_axes_init(jcal_two_axes_t *self, const jcal_two_axes_config_t *config);

/// Takes in the ticks of both sensors of the same time: sums only.
///
/// Returns:  JCAL_OK; JCAL_REJECTED as jcal_ball_add; JCAL_ERR_ARG.
/// Threads:  the task of step.
jcal_status_t jcal_two_axes_add(jcal_two_axes_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// One bounded slice of solving. One a hundredth of a second is enough with the default of slices_per_s.
///
/// Returns:  JCAL_OK; JCAL_IDLE if nothing is due; JCAL_ERR_ARG.
/// Threads:  one task; not beside add or get.
jcal_status_t jcal_two_axes_step(jcal_two_axes_t *self);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock.
jcal_status_t jcal_two_axes_get(const jcal_two_axes_t *self, jcal_two_axes_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_two_axes_reset(jcal_two_axes_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_AXES_H */

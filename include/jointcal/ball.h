/* SPDX-License-Identifier: MIT */
/// @file
/// Ball joint of a person, such as hip and shoulder: how both sensors' level frames stand to each other, and where the joint's centre is.
///
/// No axis is asked for. What both sensors share is the velocity of the joint's centre, 0.4 to 3 Hz; from it come the heading between the
/// level frames, and with it the relative orientation of both segments without drift, and the levers from the centre to each sensor.
/// Each is known or not by itself: a pelvis that hardly turns says nothing of its own lever.
///
/// How it is used: as functional.h, with the ticks of two jcal_sensor_t (sensor.h).
///
///     static jcal_ball_t hip;
///     const jcal_ball_config_t config = jcal_ball_config_default();
///     if (jcal_ball_init(&hip, &config) != JCAL_OK) { ... }
///     (void)jcal_ball_add(&hip, &pelvis_tick, &thigh_tick);      for each pair of ticks of the same time
///     (void)jcal_ball_step(&hip);                                a slice of work, for each reading, say
///     jcal_ball_result_t result;
///     (void)jcal_ball_get(&hip, &result);
///     if (result.head.status == JCAL_READY) { ... jcal_ball_relative(&hip, pelvis, thigh) ... }
///
/// Units and frames: types.h. Settings: ball_config.h. Cost: 0.9 KiB of state; docs/measurements/budget.md has the instructions.
/// Method: docs/METHOD_PEOPLE.md, section 10.
#ifndef JCAL_BALL_H
#define JCAL_BALL_H

#include "jointcal/ball_config.h"
#include "jointcal/head.h"
#include "jointcal/private/ball/stream.h"
#include "jointcal/status.h"
#include "jointcal/tick.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the ball joint says.
typedef struct {
    jcal_head_t head;                ///< `ready`: the heading is known within max_heading_rad.
    bool has_estimate;               ///< False until there is any; until then everything below is zero or unknown.
    bool for_center1;                ///< While ready: uncertainty1_m is within max_lever_m.
    bool for_center2;                ///< The same from sensor 2.
    jcal_heading_t heading;          ///< L2 to L1, now.
    float uncertainty_heading_rad;   ///< 95 % bound of it; a right angle while unknown.
    jcal_vec3_t joint_to_sensor1_m;  ///< In sensor frame 1.
    jcal_vec3_t joint_to_sensor2_m;  ///< In sensor frame 2.
    /// 95 % bounds; JCAL_BOUND_UNKNOWN_M if unknown. 17 and 10 % of the lever are in them for skin that goes along with its segment.
    float uncertainty1_m, uncertainty2_m;
    float speed_m_s;         ///< How fast the centre moved, rms, 0.4 to 3 Hz.
    float gravity_off_m_s2;  ///< As of functional.h.
    float progress_heading;  ///< 0 to 1: how far the heading is on the way to its limit.
    float progress_center1, progress_center2;
} jcal_ball_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_ball_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_ball_init(jcal_ball_t *self, const jcal_ball_config_t *config);

/// Takes in the ticks of both sensors of the same time: sums only.
///
/// Returns:  JCAL_OK; JCAL_REJECTED if the times differ or do not increase, or a number is one that no sensor makes; JCAL_ERR_ARG.
/// Threads:  the task of step.
jcal_status_t jcal_ball_add(jcal_ball_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// One bounded slice of solving. One a hundredth of a second is enough with the default of slices_per_s.
///
/// Returns:  JCAL_OK; JCAL_IDLE if nothing is due; JCAL_ERR_ARG.
/// Threads:  one task; not beside add or get.
jcal_status_t jcal_ball_step(jcal_ball_t *self);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock.
jcal_status_t jcal_ball_get(const jcal_ball_t *self, jcal_ball_result_t *out);

/// Orientation of sensor 2 in sensor 1, from both sensors' orientations to their level frames: R1' Rz R2. Causal, without drift. All NaN
/// while the heading is unknown.
jcal_quat_t jcal_ball_relative(const jcal_ball_t *self, jcal_quat_t orientation1, jcal_quat_t orientation2);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_ball_reset(jcal_ball_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_BALL_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Functional joint: the axis that explains most of how a person's joint bends, from motion as it comes.
///
/// On a person skin and straps move, and no axis is exact. What both sensors share is at low frequency: the joint's centre has one
/// velocity, the axis is one direction in space. From that come the headings between both level frames, the sign pairing, the axes and
/// where the joint is; and the angle of the joint without drift. On rigid mounts the same sums give the axes of a hinge.
///
/// How it is used: one jcal_sensor_t per IMU (sensor.h) makes ticks of readings, and each joint takes the ticks of its two sensors:
///
///     static jcal_functional_t knee;
///     const jcal_functional_config_t config = jcal_functional_config_default();
///     if (jcal_functional_init(&knee, &config) != JCAL_OK) { ... }
///     (void)jcal_functional_add(&knee, &thigh_tick, &shank_tick);      for each pair of ticks of the same time
///     (void)jcal_functional_step(&knee);                               a slice of work, for each reading, say
///     jcal_functional_result_t result;
///     (void)jcal_functional_get(&knee, &result);                       whenever you like
///     if (result.head.status == JCAL_READY) { ... jcal_functional_flexion(&knee, thigh, shank) ... }
///
/// Units and frames: types.h. Settings: functional_config.h. Cost: 3 KiB of state; docs/measurements/budget.md has the instructions.
/// Method: docs/METHOD_PEOPLE.md.
#ifndef JCAL_FUNCTIONAL_H
#define JCAL_FUNCTIONAL_H

#include "jointcal/functional_config.h"
#include "jointcal/head.h"
#include "jointcal/private/functional/stream.h"
#include "jointcal/status.h"
#include "jointcal/tick.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the functional joint says.
typedef struct {
    jcal_head_t head;
    bool has_axes;           ///< False until there is any estimate; until then axes and places are zero.
    bool for_axes;           ///< While ready: the bounds of both axes are within max_bound_rad.
    bool for_flexion;        ///< While ready: the error of the angle is within max_flexion_rad.
    jcal_vec3_t axis1;       ///< Unit axis in sensor frame 1; its sign as in hinge.h.
    jcal_vec3_t axis2;       ///< Unit axis in sensor frame 2, sign following the pairing.
    float uncertainty1_rad;  ///< 95 % bound of axis1: of what other parts of the same motion would give; a right angle
                             ///< while it is unknown, as while the sums are not those of one joint with one axis.
    float uncertainty2_rad;  ///< The same for axis2.
    float flexion_uncertainty_rad;  ///< Error that the axes make in the angle, rms.
    float rate_share;  ///< Rates across the axis as a share of the rates, rms: what rigid segments would not leave.
    float bend_rad;    ///< How far the joint bent so far, rms about its mean.
    float
        gravity_off_m_s2;  ///< How far the mean specific force of the worse sensor is from 9.81: its inclination is off by as much.
    float sign_margin;       ///< What the other pairing leaves of the centre's motion over what this one leaves.
    jcal_heading_t heading;  ///< L2 to L1, now.
    jcal_vec3_t joint_to_sensor1_m;                       ///< In sensor frame 1.
    jcal_vec3_t joint_to_sensor2_m;                       ///< In sensor frame 2.
    float progress_axis1, progress_axis2, progress_sign;  ///< 0 to 1: how far each is on the way to its limit.
} jcal_functional_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_functional_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_functional_init(jcal_functional_t *self, const jcal_functional_config_t *config);

/// Takes in the ticks of both sensors of the same time: sums only.
///
/// Returns:  JCAL_OK; JCAL_REJECTED if the times differ or do not increase, or a number is one that no sensor makes; JCAL_ERR_ARG.
/// Threads:  the task of step.
jcal_status_t jcal_functional_add(jcal_functional_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// One bounded slice of solving. One a hundredth of a second is enough with the default of slices_per_s.
///
/// Returns:  JCAL_OK; JCAL_IDLE if nothing is due; JCAL_ERR_ARG.
/// Threads:  one task; not beside add or get.
jcal_status_t jcal_functional_step(jcal_functional_t *self);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock.
jcal_status_t jcal_functional_get(const jcal_functional_t *self, jcal_functional_result_t *out);

/// The joint's angle now, rad, from both sensors' orientations to their level frames: the twist about the axes of R1' Rz R2.
///
/// In [-pi, pi], from an arbitrary zero that is the same for all times; growing with turns of sensor 2 about axis2. Causal, without
/// drift. NaN while there are no axes.
float jcal_functional_flexion(const jcal_functional_t *self, jcal_quat_t orientation1, jcal_quat_t orientation2);

/// The error that axes off by `bound_rad` make in the joint's angle, rad rms: F of docs/METHOD_PEOPLE.md; a right angle while unknown.
float jcal_functional_flexion_error(const jcal_functional_t *self, float bound_rad);

/// Puts a joint that is ready to sleep, or wakes it. Asleep nothing is learnt: the heading is followed, and slips are watched for; a slip
/// wakes it, and it begins anew. Awake, it learns on; if what it has was adopted, it begins with nothing.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (to sleep: it is not ready); JCAL_ERR_ARG.
/// Cost:     asleep an add takes 700 instructions on a Cortex-M4F at 20 ticks a second, a step 20.
jcal_status_t jcal_functional_sleep(jcal_functional_t *self, bool asleep);

/// True if it sleeps; false for null.
bool jcal_functional_sleeps(const jcal_functional_t *self);

/// A calibration that is known from elsewhere: kept over night, and confirmed by motion (remember.h).
typedef struct {
    jcal_vec3_t axis1, axis2;  ///< Unit axes; their signs are the pairing.
    jcal_vec3_t joint_to_sensor1_m, joint_to_sensor2_m;
    float uncertainty1_rad, uncertainty2_rad;  ///< 95 % bounds.
    float flexion_uncertainty_rad;             ///< Error that the axes make in the angle, rms.
    float usual[3];                            ///< Mean squares of its residuals, above zero: jcal_functional_usual.
} jcal_functional_known_t;

/// Forgets all data and takes over what is known: the joint is ready with it, and asleep.
///
/// Returns:  JCAL_OK; JCAL_REJECTED: the bounds are too wide for any use that the config has, and nothing is changed; JCAL_ERR_ARG.
JCAL_MUST_CHECK jcal_status_t jcal_functional_adopt(jcal_functional_t *self, const jcal_functional_known_t *known);

/// Mean squares of the residuals so far, of direction, rate and the centre's velocity: rad^2, 1, (m/s)^2. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_functional_usual(const jcal_functional_t *self, float usual[3]);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_functional_reset(jcal_functional_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_FUNCTIONAL_H */

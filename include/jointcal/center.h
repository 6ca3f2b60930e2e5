/* SPDX-License-Identifier: MIT */
/// @file
/// Joint centre: where both sensors sit relative to the joint, from rates and specific forces. Stream engine, and what both engines
/// say.
///
/// How it is used: as hinge.h.
///
///     static jcal_center_t center;
///     const jcal_center_config_t config = jcal_center_config_default();
///     if (jcal_center_init(&center, &config) != JCAL_OK) { ... }
///     (void)jcal_center_update(&center, &pair);
///     jcal_center_result_t result;
///     (void)jcal_center_get(&center, &result);
///
/// Unknowns are r1 and r2, from the joint to sensor 1 and 2: a_i = a_0 + K(w_i, dw_i) r_i, where a_0 is what both segments share,
/// so that |a_1 - K_1 r1| = |a_2 - K_2 r2|. A hinge has no centre along its axis: give its axes in the config. Units and frames:
/// types.h. Settings: center_config.h. Cost: 3.9 KiB of state; docs/measurements/budget.md has the instructions.
/// Sources: [OLS17], [SEE12]; docs/METHOD_CENTER.md derives what differs from them.
#ifndef JCAL_CENTER_H
#define JCAL_CENTER_H

#include "jointcal/center_config.h"
#include "jointcal/head.h"
#include "jointcal/private/center/stream.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What both engines say.
typedef struct {
    jcal_head_t head;
    /// False until there is an estimate within JCAL_CENTER_REACH_M of both sensors. Then what follows is zero, and bounds are unknown.
    bool has_center;
    jcal_vec3_t joint_to_sensor1_m;  ///< r1, from the joint centre to sensor 1, in sensor frame 1.
    jcal_vec3_t joint_to_sensor2_m;  ///< r2, from the joint centre to sensor 2, in sensor frame 2.
    /// 95 % bound of |r1 - truth|; JCAL_BOUND_UNKNOWN_M if unknown. With known hinge axes: across the axis.
    float uncertainty1_m;
    float uncertainty2_m;            ///< The same for r2.
    jcal_vec3_t weakest_direction1;  ///< Unit vector in sensor frame 1 along which r1 is known worst ...
    jcal_vec3_t weakest_direction2;  ///< ... and r2 in sensor frame 2.
    float uncertainty_weakest1_m;    ///< 95 % bound of the error of r1 along that direction.
    float uncertainty_weakest2_m;    ///< The same for r2.
    jcal_vec3_t
        acc_bias1_m_s2;  ///< Estimated bias of accelerometer 1 (part of it looks like a tilt and cannot be told).
    jcal_vec3_t acc_bias2_m_s2;  ///< The same of accelerometer 2.
    float heading_offset_rad;    ///< With JCAL_CENTER_LS: turns earth frame 2 to earth frame 1 about z; else 0.
    float misfit;                ///< Root of the share of the joint's effect that remains unexplained, 0 to 1.
    float progress1;             ///< 0 to 1: how far r1 is on the way to its bound.
    float progress2;             ///< The same for r2.
} jcal_center_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
/// A struct that this never prepared, all zero: push and step return JCAL_ERR_ARG, get knows nothing, reset returns JCAL_ERR_CONFIG.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_center_config_check says which field); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_center_init(jcal_center_t *self, const jcal_center_config_t *config);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG (null, or JCAL_CENTER_LS); JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_center_push(jcal_center_t *self, const jcal_pair_t *pair);

/// The same with both sensors' orientations, each to its earth frame: with JCAL_CENTER_LS it needs them.
///
/// Returns:  as jcal_center_push; a quaternion that is not of length 1 is JCAL_REJECTED as out of range.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_center_push_oriented(jcal_center_t *self, const jcal_pair_t *pair,
                                        const jcal_attitudes_t *attitudes);

/// Works off one sample of the inbox and one bounded slice of solving.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_center_step(jcal_center_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_center_update(jcal_center_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_center_get(const jcal_center_t *self, jcal_center_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_center_reset(jcal_center_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CENTER_H */

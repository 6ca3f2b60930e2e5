/* SPDX-License-Identifier: MIT */
/// @file
/// Hip and knee of a person: where three sensors, on pelvis, thigh and shank, sit relative to both joint centres.
///
/// chain.h does this for rigid mounts. On a person skin moves with the sensors: here each joint is a ball joint of ball.h, from what both of
/// its sensors share at low frequency, and the thigh's sensor stage serves both. Each of the four vectors is known or not by itself: a
/// pelvis that hardly turns says nothing of its own, and the others are known all the same.
///
/// Skin that goes along with its segment makes all levers of the thigh longer or shorter by a common factor, which no IMU can see; it is in
/// the bounds. A known length of the thigh takes it out (leg_config.h).
///
/// How it is used:
///
///     static jcal_leg_t leg;
///     const jcal_leg_config_t config = jcal_leg_config_default();
///     if (jcal_leg_init(&leg, &config, NULL) != JCAL_OK) { ... }
///     (void)jcal_leg_update(&leg, &triple);       for each triple of readings
///     jcal_leg_result_t result;
///     (void)jcal_leg_get(&leg, &result);
///     if (result.known[JCAL_CHAIN_HIP_TO_THIGH]) { ... result.place_m[JCAL_CHAIN_HIP_TO_THIGH] ... }
///
/// Units and frames: types.h. Settings: leg_config.h. Cost: 5 KiB of state.
/// Method: docs/METHOD_PEOPLE.md, section 13. Source of the chain: [SAL15].
#ifndef JCAL_LEG_H
#define JCAL_LEG_H

#include "jointcal/head.h"
#include "jointcal/leg_config.h"
#include "jointcal/private/leg/stream.h"
#include "jointcal/status.h"
#include "jointcal/triple.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The two joints.
typedef enum { JCAL_LEG_HIP = 0, JCAL_LEG_KNEE = 1 } jcal_leg_joint_t;
#define JCAL_LEG_JOINTS 2

/// What is known of hip and knee. Its status is never JCAL_AMBIGUOUS.
typedef struct {
    /// `ready` when all four vectors are known. Else `weak` is JCAL_WEAK_HEADING while a joint is not known as one (`hint` and `reason` are
    /// that joint's, of two the one with the larger bound of its heading), then JCAL_WEAK_CENTER1 or _CENTER2: of the vectors that are not
    /// known the worst belongs to the hip or to the knee; `hint` is the segment of that joint that should turn more, 1 its proximal and
    /// 2 its distal one, or JCAL_HINT_NONE where the share of skin alone is above the limit. JCAL_REASON_DOES_NOT_FIT: the length of the
    /// thigh that was given cannot be; neither vector on the thigh is known then.
    jcal_head_t head;
    bool
        has_joint[JCAL_LEG_JOINTS];  ///< By jcal_leg_joint_t: both of its vectors have an estimate, else they are zero.
    bool known[JCAL_CHAIN_PLACES];  ///< By jcal_chain_place_t: the bound is within max_lever_m, of a joint that is one.
    jcal_vec3_t place_m[JCAL_CHAIN_PLACES];          ///< The vectors, each in its sensor's frame.
    float uncertainty_m[JCAL_CHAIN_PLACES];          ///< 95 % bounds; JCAL_BOUND_UNKNOWN_M if unknown.
    jcal_heading_t heading[JCAL_LEG_JOINTS];         ///< Of the distal sensor's level frame to the proximal one's, now.
    float uncertainty_heading_rad[JCAL_LEG_JOINTS];  ///< 95 % bounds; a right angle while unknown.
    float segment_length_m;       ///< Distance of hip and knee; 0 until both joints have an estimate.
    float uncertainty_segment_m;  ///< 95 % bound: the sum of those of both vectors on the thigh.
    float
        length_factor;  ///< What both vectors on the thigh were scaled by to have the known length; 1 if they were not.
    jcal_calibration_t joint_status[JCAL_LEG_JOINTS];  ///< Of each joint's heading by itself.
} jcal_leg_result_t;

/// Prepares an estimator; whatever `self` held before is lost. `limits` of single samples; null: the defaults.
/// A struct that this never prepared, all zero: push, step, update and reset return JCAL_ERR_ARG, get knows nothing.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_leg_config_check says which field); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_leg_init(jcal_leg_t *self, const jcal_leg_config_t *config,
                                            const jcal_gate_config_t *limits);

/// Takes in one reading of all three sensors: checks, sensor stages, sums of both joints.
///
/// What one sensor cannot follow, or the gate refuses of it, none follows: their ticks stay of the same times.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG.
/// Cost:     three calls of jcal_sensor_push and, at a tick, two of jcal_ball_add.
/// Threads:  the task of step.
jcal_status_t jcal_leg_push(jcal_leg_t *self, const jcal_triple_t *triple);

/// One bounded slice of solving of one joint, both taking turns; one that has nothing to do leaves its turn to the other.
///
/// Returns:  JCAL_OK; JCAL_IDLE if neither has anything to do; JCAL_ERR_ARG.
/// Cost:     one call of jcal_ball_step.
/// Threads:  one task; not beside push or get.
jcal_status_t jcal_leg_step(jcal_leg_t *self);

/// Push, and the slices that are due. Returns what push returned.
/// Threads:  one task.
jcal_status_t jcal_leg_update(jcal_leg_t *self, const jcal_triple_t *triple);

/// Copies the current result; what the gate complains of stands above what was judged. Errors: JCAL_ERR_ARG; `out` untouched.
/// Cost:     about 500 multiply-adds.
/// Threads:  the task of step, or behind a lock.
jcal_status_t jcal_leg_get(const jcal_leg_t *self, jcal_leg_result_t *out);

/// Forgets all data, keeps the settings. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_leg_reset(jcal_leg_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_LEG_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Hip and knee together: where three sensors, on pelvis, thigh and shank, sit relative to both joint centres. Stream engine.
///
/// How it is used: as center.h, with triples of readings and jcal_chain_push, then jcal_chain_step.
///
/// Each joint has a stream engine of center.h. What ties them together comes on top: both see the same accelerometer on the thigh,
/// hip and knee are a fixed distance apart, which may be known, and (15b) of [SAL15] puts the thigh into the plane of the flexion
/// axes. Units and frames: types.h. Settings: chain_config.h. Cost: 8 KiB of state; docs/measurements/budget.md has the instructions.
/// Source: [SAL15]; docs/METHOD_CENTER.md says what each tie buys.
#ifndef JCAL_CHAIN_H
#define JCAL_CHAIN_H

#include "jointcal/center.h"
#include "jointcal/chain_config.h"
#include "jointcal/head.h"
#include "jointcal/private/chain/stream.h"
#include "jointcal/triple.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Orientations of the three IMUs, each to an earth frame of its own.
typedef struct {
    jcal_quat_t q1, q2, q3;
} jcal_triple_attitudes_t;

/// What is known of hip and knee. Its status is never JCAL_AMBIGUOUS.
typedef struct {
    /// Its `weak` is JCAL_WEAK_CENTER1 for the hip and JCAL_WEAK_CENTER2 for the knee; its `hint` is the motion that would help that
    /// joint, segments 1 and 2 being its proximal and distal one; a triple that either joint rejects is rejected.
    jcal_head_t head;
    bool has_places;  ///< False until both joints have an estimate; until then a place may be that of one joint alone.
    jcal_vec3_t place_m[JCAL_CHAIN_PLACES];  ///< By jcal_chain_place_t.
    float uncertainty_m[JCAL_CHAIN_PLACES];  ///< 95 % bounds; JCAL_BOUND_UNKNOWN_M if unknown.
    float segment_length_m;                  ///< Distance of hip and knee as estimated.
    float uncertainty_segment_m;             ///< 95 % bound of that.
    jcal_calibration_t joint_status[2];      ///< Of hip and knee, each by itself.
    float misfit;                            ///< The larger of both joints' (center.h): on a person 0.2 and more.
} jcal_chain_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
/// A struct that this never prepared, all zero: push and step return JCAL_ERR_ARG, get knows nothing, reset returns JCAL_ERR_CONFIG.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_chain_config_check says which field); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_chain_init(jcal_chain_t *self, const jcal_chain_config_t *config);

/// Takes in one sample of all three. `attitudes` may be null unless the method is JCAL_CENTER_LS.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL: neither joint has taken anything.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_chain_push(jcal_chain_t *self, const jcal_triple_t *triple,
                              const jcal_triple_attitudes_t *attitudes);

/// Works off one sample of each joint and a bounded slice of solving for each.
///
/// Returns:  JCAL_OK; JCAL_IDLE if there was nothing; JCAL_ERR_ARG.
/// Cost:     two steps of center.h.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_chain_step(jcal_chain_t *self);

/// Push and step in one call, for those who need no split; after pushes without steps it makes room first. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_chain_update(jcal_chain_t *self, const jcal_triple_t *triple,
                                const jcal_triple_attitudes_t *attitudes);

/// Ties both joints together and says what is known. Errors: JCAL_ERR_ARG.
///
/// What a tie makes ready stays so while the joint's own bound grows by less than a fifth, as a joint that is ready by itself does.
///
/// Cost:     about 4000 multiply-adds; stack about 1.4 KiB.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_chain_get(const jcal_chain_t *self, jcal_chain_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_chain_reset(jcal_chain_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CHAIN_H */

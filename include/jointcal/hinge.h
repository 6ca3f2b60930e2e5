/* SPDX-License-Identifier: MIT */
/// @file
/// Hinge: the joint axis as both sensors see it, from rates and specific forces in any motion. Stream engine, and what both engines
/// say.
///
/// How it is used:
///
///     static jcal_hinge_t hinge;
///     const jcal_hinge_config_t config = jcal_hinge_config_default();
///     if (jcal_hinge_init(&hinge, &config) != JCAL_OK) { ... }
///     (void)jcal_hinge_update(&hinge, &pair);        for each pair of readings
///     jcal_hinge_result_t result;
///     (void)jcal_hinge_get(&hinge, &result);         whenever you like
///     if (result.head.status == JCAL_READY) { ... result.axis1, result.axis2 ... }
///
/// Or jcal_hinge_push in an interrupt and jcal_hinge_step outside. Units and frames: types.h. Settings: hinge_config.h.
/// Cost: 2 KiB of state; docs/measurements/budget.md has the instructions of push and step.
/// Source: [OLS20]; docs/METHOD.md derives what differs from it.
#ifndef JCAL_HINGE_H
#define JCAL_HINGE_H

#include "jointcal/head.h"
#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/stream.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What both hinge engines say.
typedef struct {
    jcal_head_t head;
    bool has_axes;        ///< False until there is any estimate; until then axis1, axis2 are zero.
    bool paper_accepted;  ///< Window engine: what Algorithm 4 of [OLS20] says. Stream engine: false.
    /// Unit joint axis in sensor frame 1. Its sign follows axis1_toward of the config, or makes the largest component positive; once
    /// `ready` it stays as it is until `moved`.
    jcal_vec3_t axis1;
    jcal_vec3_t axis2;  ///< Unit joint axis in sensor frame 2, sign following the pairing.
    /// 95 % bound of the angle between axis1 and the truth; JCAL_BOUND_UNKNOWN_RAD if unknown.
    float uncertainty1_rad;
    float uncertainty2_rad;  ///< The same for axis2.
    float sign_margin;       ///< Cost of the other sign pairing over the cost of this one; 0 while unknown.
    float progress_axis1;    ///< 0 to 1: how far axis1 is on the way to its bound.
    float progress_axis2;    ///< The same for axis2.
    float progress_sign;     ///< The same for the evidence of the sign pairing.
} jcal_hinge_result_t;

/// Prepares an estimator; whatever `self` held before is lost.
/// A struct that this never prepared, all zero: push rejects every sample, get knows nothing, reset returns JCAL_ERR_CONFIG.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_hinge_config_check says which field); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_init(jcal_hinge_t *self, const jcal_hinge_config_t *config);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_hinge_push(jcal_hinge_t *self, const jcal_pair_t *pair);

/// Works off one sample of the inbox and one bounded slice of solving.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_hinge_step(jcal_hinge_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_hinge_update(jcal_hinge_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_hinge_get(const jcal_hinge_t *self, jcal_hinge_result_t *out);

/// Forgets all data, keeps the config. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_hinge_reset(jcal_hinge_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Joint centre, window engine: [OLS17] over the last samples, in storage of the caller.
///
/// Every sample that is kept is followed by one Gauss-Newton step over all that are in the window, (17) to (19) of [OLS17]. For
/// absolute differences a residual beyond what the config calls usual weighs in as usual / |e|: iteratively reweighted least squares.
/// Its minimum is that of Huber's loss, |e| with a rounded tip. A gradient step on |e| itself, as printed, has no length of its own at
/// the kinks; this one is the step that least squares takes anyway, and lowers the loss each time on a linear problem.
///
/// Where the paper is silent or differs from this engine:
/// - Samples are kept as they come, about 50 a second, instead of 500 drawn from a whole recording.
/// - The angular acceleration is that of the config, by default not (8).
/// - Biases of the accelerometers are unknowns unless acc_bias_m_s2 is 0; positions have a Gaussian prior of 0.3 m, so that an open
///   direction has a value.
/// - With orientations the heading offset between both earth frames is an unknown too.
#ifndef JCAL_CENTER_WINDOW_H
#define JCAL_CENTER_WINDOW_H

#include "jointcal/center.h"
#include "jointcal/private/center/window.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Bytes of storage for n_max; usable in array sizes: 96 KB for 500.
#define JCAL_CENTER_WINDOW_STORAGE_BYTES(n_max) ((size_t)(n_max) * sizeof(jcal_kinematic_t))

/// Bytes of storage that a config needs: JCAL_CENTER_WINDOW_STORAGE_BYTES of its field; 0 for null.
/// Threads:  no state.
size_t jcal_center_window_storage_bytes(const jcal_center_window_config_t *config);

/// Prepares an estimator; whatever `self` and the storage held before is lost.
/// A struct that this never prepared, all zero: push, step, reset and attach return JCAL_ERR_ARG, get knows nothing.
///
/// Inputs:   storage, aligned for uint64_t, of at least jcal_center_window_storage_bytes(config); it belongs to `self` as long as
///           `self` is used.
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_center_window_config_check says which field); JCAL_ERR_STORAGE (too small or
///           not aligned); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_center_window_init(jcal_center_window_t *self,
                                                      const jcal_center_window_config_t *config, void *storage,
                                                      size_t storage_bytes);

/// Tells a copy of an estimator where the copy of its storage is.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_STORAGE (too small or not aligned); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_center_window_attach(jcal_center_window_t *self, void *storage,
                                                        size_t storage_bytes);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG (null, or JCAL_CENTER_LS); JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_center_window_push(jcal_center_window_t *self, const jcal_pair_t *pair);

/// The same with both sensors' orientations, each to its earth frame: with JCAL_CENTER_LS it needs them.
///
/// Returns:  as jcal_center_window_push; a quaternion that is not of length 1 is JCAL_REJECTED as out of range.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_center_window_push_oriented(jcal_center_window_t *self, const jcal_pair_t *pair,
                                               const jcal_attitudes_t *attitudes);

/// Works off one sample of the inbox; if it is kept, with one Gauss-Newton step over all samples.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
/// Cost:     about 200 multiply-adds and 2 square roots for each sample in the window.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_center_window_step(jcal_center_window_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_center_window_update(jcal_center_window_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_center_window_get(const jcal_center_window_t *self, jcal_center_result_t *out);

/// Forgets all data, keeps the config and the storage. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_center_window_reset(jcal_center_window_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CENTER_WINDOW_H */

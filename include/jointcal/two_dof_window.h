/* SPDX-License-Identifier: MIT */
/// @file
/// Joint with two degrees of freedom, window engine: [LAI22] as it is printed, over the last samples in storage of the caller.
///
/// One sample is kept every 0.05 s, the last n_max of them stay, and from the half-full buffer on each kept sample is followed by one
/// Gauss-Newton step over all of them (section 4.4, B.2). The rotation-based constraint (7) has 5 parameters, the orientation-based
/// one (13) has 6. All samples weigh alike. Status, bounds and reasons follow the rules of the stream engine (two_dof.h).
///
/// Where the paper is silent or differs from this engine:
/// - The axes move on the unit sphere in its tangent plane instead of by spherical angles: the same minimum, no poles.
/// - The sixth parameter is sin(beta0), and the residual of (13) the difference of sines instead of angles.
/// - Rates come from the orientations kept before and after each sample: a mean over 0.1 s, which takes the place of the low-pass of
///   C.2 (-3 dB at 4.4 Hz, no delay). The newest orientation is used when the next one is there.
/// - Steps are damped slightly. The paper does not say where they start: here a fixed set of starts is tried one after the other, as
///   long as the engine runs, and the best minimum is followed together with the second best.
#ifndef JCAL_TWO_DOF_WINDOW_H
#define JCAL_TWO_DOF_WINDOW_H

#include "jointcal/private/two_dof/window.h"
#include "jointcal/two_dof.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Bytes of storage for n_max; usable in array sizes: 14.4 KB for 200.
#define JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(n_max) ((size_t)(n_max) * sizeof(jcal_two_dof_row_t))

/// Bytes of storage that a config needs: JCAL_TWO_DOF_WINDOW_STORAGE_BYTES of its n_max; 0 for null.
/// Threads:  no state.
size_t jcal_two_dof_window_storage_bytes(const jcal_two_dof_window_config_t *config);

/// Prepares an estimator; whatever `self` and the storage held before is lost.
/// A struct that this never prepared, all zero: push, step, reset and attach return JCAL_ERR_ARG, get knows nothing.
///
/// Inputs:   storage, aligned for uint64_t, of at least jcal_two_dof_window_storage_bytes(config); it belongs to `self` as long as
///           `self` is used.
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_two_dof_window_config_check says which field); JCAL_ERR_STORAGE (too small or
///           not aligned); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_two_dof_window_init(jcal_two_dof_window_t *self,
                                                       const jcal_two_dof_window_config_t *config, void *storage,
                                                       size_t storage_bytes);

/// Tells a copy of an estimator where the copy of its storage is.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_STORAGE (too small or not aligned); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_two_dof_window_attach(jcal_two_dof_window_t *self, void *storage,
                                                         size_t storage_bytes);

/// Takes in one pair of orientations: checks it and keeps it if it comes at least 0.05 s after the last one kept. May run in an
/// interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_two_dof_window_push(jcal_two_dof_window_t *self, const jcal_orientation_pair_t *pair);

/// Works off the orientation that waits.
///
/// Returns:  JCAL_OK; JCAL_IDLE if there is none; JCAL_ERR_ARG.
/// Cost:     at most three passes over the buffer: the estimate's own step, and two of the search (a step of the second best minimum,
///           a step from a start, or the costs of a start's 8 headings). A pass takes about 250 multiply-adds and one square root per
///           row, that over headings about 400 and 8.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_two_dof_window_step(jcal_two_dof_window_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_two_dof_window_update(jcal_two_dof_window_t *self, const jcal_orientation_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_two_dof_window_get(const jcal_two_dof_window_t *self, jcal_two_dof_result_t *out);

/// Forgets all data, keeps the config and the storage. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_two_dof_window_reset(jcal_two_dof_window_t *self);

/// Times of the samples in the buffer, oldest first.
///
/// Inputs:   count  room in t_us; n_max is enough.
/// Outputs:  t_us; count how many. Untouched on error.
/// Errors:   JCAL_ERR_ARG (null, or too little room).
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_two_dof_window_kept(const jcal_two_dof_window_t *self, uint64_t *t_us, size_t *count);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_DOF_WINDOW_H */

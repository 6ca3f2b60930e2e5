/* SPDX-License-Identifier: MIT */
/// @file
/// Hinge joint, window engine: [OLS20] as it is printed, over selected samples in storage of the caller.
///
/// Every accepted sample is scored n samples later, selected or not ([OLS20] section 5), and followed by one Gauss-Newton step
/// over the selected samples. Once in `solve_period_s` of sample time Algorithm 1 runs from a random start, in slices.
///
/// Where the paper is silent or differs from this engine:
/// - The axes move on the unit sphere in its tangent plane instead of by spherical angles: the same minimum, no poles.
/// - Damped Gauss-Newton (Levenberg-Marquardt) instead of a line search.
/// - Algorithm 4 uses the closed form of mu + 2 sigma; it does not stop: `paper_accepted` says whether both criteria
///   hold at the last full solve. The paper's algorithm would have returned when it was first true.
/// - Besides the estimate of the last full solve one is followed from sample to sample; the better one is reported.
/// - Selection starts anew from the samples kept, so a sample that was dropped stays dropped.
/// - The newest n samples are not used yet, as their windows are not complete.
#ifndef JCAL_HINGE_WINDOW_H
#define JCAL_HINGE_WINDOW_H

#include "jointcal/hinge.h"
#include "jointcal/private/hinge/window.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Most Gauss-Newton iterations of a full solve from one start; it ends earlier once a step is below 1e-5 rad.
#define JCAL_HINGE_WINDOW_ITERATIONS 20u

/// Iterations of a full solve per step. A full solve has at most 62 of them (two pairings, the other pairing of the
/// best, two comparisons), so it is over after 31 steps: 0.6 s at 50 Hz. Below 31 Hz solves may come later than asked.
#define JCAL_HINGE_WINDOW_SLICES 2u

/// Bytes of storage for n_max and half_window; usable in array sizes: 34.8 KB for 500 and 21.
#define JCAL_HINGE_WINDOW_STORAGE_BYTES(n_max, half_window)                                                            \
    (((2u * (size_t)(half_window) + 1u) * sizeof(jcal_score_slot_t)) +                                                 \
     ((2u * (size_t)(n_max) + 1u) * sizeof(jcal_row_t)))

/// Bytes of storage that a config needs: JCAL_HINGE_WINDOW_STORAGE_BYTES of its fields; 0 for null.
/// Threads:  no state.
size_t jcal_hinge_window_storage_bytes(const jcal_hinge_window_config_t *config);

/// Prepares an estimator; whatever `self` and the storage held before is lost.
/// A struct that this never prepared, all zero: push rejects every sample, step returns JCAL_ERR_ARG, get knows nothing.
///
/// Inputs:   storage, aligned for float, of at least jcal_hinge_window_storage_bytes(config); it belongs to `self`
///           as long as `self` is used.
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_hinge_window_config_check says which field); JCAL_ERR_STORAGE
///           (too small or not aligned); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_window_init(jcal_hinge_window_t *self,
                                                     const jcal_hinge_window_config_t *config, void *storage,
                                                     size_t storage_bytes);

/// Tells a copy of an estimator where the copy of its storage is.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_STORAGE (too small or not aligned); self untouched.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_window_attach(jcal_hinge_window_t *self, void *storage, size_t storage_bytes);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
/// Threads:  may preempt step and get, or run beside them on another core; not beside itself.
jcal_status_t jcal_hinge_window_push(jcal_hinge_window_t *self, const jcal_pair_t *pair);

/// Works off one sample of the inbox: scores, selection, one Gauss-Newton step, a slice of the full solve.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
/// Cost:     (1 + JCAL_HINGE_WINDOW_SLICES) iterations, each about 130 n_max multiply-adds and 6 n_max square roots;
///           once, when more than n_max samples have been seen, O(n_max log n_max) moves of 32 bytes.
///           Stack <= 1.5 KiB.
/// Threads:  one task; a push may preempt it. Not beside get.
jcal_status_t jcal_hinge_window_step(jcal_hinge_window_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
/// Threads:  one task; no push beside it.
jcal_status_t jcal_hinge_window_update(jcal_hinge_window_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_hinge_window_get(const jcal_hinge_window_t *self, jcal_hinge_result_t *out);

/// Forgets all data, keeps the config and the storage. Errors: JCAL_ERR_ARG.
/// Threads:  nothing else runs on this estimator meanwhile, push neither.
jcal_status_t jcal_hinge_window_reset(jcal_hinge_window_t *self);

/// Which samples are selected now, in no particular order: numbers of the pushes since init or reset, from 0,
/// rejected ones counted.
///
/// Inputs:   n_gyr, n_acc  room in gyr and acc; n_max is enough for each.
/// Outputs:  gyr, acc; n_gyr, n_acc how many. Untouched on error.
/// Errors:   JCAL_ERR_ARG (null, or too little room).
/// Threads:  the task of step, or behind a lock; a push may preempt it.
jcal_status_t jcal_hinge_window_selection(const jcal_hinge_window_t *self, uint32_t *gyr, size_t *n_gyr, uint32_t *acc,
                                          size_t *n_acc);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_WINDOW_H */

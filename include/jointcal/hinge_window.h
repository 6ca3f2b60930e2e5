/* SPDX-License-Identifier: MIT */
/// @file
/// Hinge joint, window engine: [OLS20] as it is printed, over selected samples in storage of the caller.
///
/// Every accepted sample is scored n samples later, selected or not (select.h), and followed by one Gauss-Newton step
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

#include "jointcal/gate.h"
#include "jointcal/hinge.h"
#include "jointcal/inbox.h"
#include "jointcal/select.h"

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

/// Settings of the window engine. Start from jcal_hinge_window_config_default().
typedef struct {
    /// What both engines share.
    jcal_hinge_config_t hinge;
    /// Samples kept per sensor kind. Range [20, 10000], default 500. [OLS20] 7.3 tried 125 to 1000.
    uint16_t n_max;
    /// n of (44) and (45): windows of 2n + 1 samples. Range [0, 100], default 21: 43 samples, as the paper's text says.
    /// Its "0.42 s" and its public code mean 21 samples in all: 10. Larger is more cautious about outliers and
    /// transitions, and needs longer calm for the accelerometers.
    uint16_t half_window;
    /// Weight ratio of (70). Range [1e-3, 1e10], default 50. Larger trusts the gyroscopes more.
    float w0;
    /// E_th of Algorithm 3. Range (0, 1e4], default 1. Larger admits faster motion.
    float energy_max_rad2_s2;
    /// Accelerometer samples kept whatever E_th says. Range [0, 10000], default 250; at most n_max of them count.
    /// 0 is the paper's: on lively motion few or none are left, and the sign pairing is a guess.
    uint16_t acc_min;
    /// E_max of Algorithm 4. Range [0.001, 0.5], default 3 deg.
    float accept_bound_rad;
    /// n_min of Algorithm 4. Range [1, 100], default 10.
    uint16_t accept_count;
    /// Seconds of sample time between full solves. Range [0.1, 60], default 1.
    float solve_period_s;
    /// Seed of the random starts, any value; default 2020. Equal seeds and samples give equal results.
    uint32_t seed;
} jcal_hinge_window_config_t;

/// Both axes. j[0] in sensor frame 1, j[1] in sensor frame 2; unit.
typedef struct {
    jcal_vec3_t j[2];
} jcal_hinge_axes_t;

/// Private: a full solve on its way.
typedef struct {
    uint8_t phase;       ///< See lib/hinge/window_solve.c.
    uint8_t iterations;  ///< Done in this phase.
    float damping;
    uint32_t random;          ///< State of the generator of starts.
    jcal_hinge_axes_t at;     ///< The estimate of this phase.
    jcal_hinge_axes_t first;  ///< The result from the start, before its other pairing was tried.
} jcal_hinge_solve_t;

/// Private: Algorithm 4.
typedef struct {
    jcal_hinge_axes_t previous;  ///< The last estimate, with the sign of (66).
    bool has_previous;
    bool accepted;
    uint16_t agreeing;   ///< Consecutive estimates with SEQAD below E_max; stops at n_min.
    float seqad_rad;     ///< (67) of the last estimate.
    float local_rad[2];  ///< mu + 2 sigma of the last estimate; pi/2 if unknown.
} jcal_hinge_accept_t;

/// The window engine. Caller-owned; all members are private.
///
/// It may be copied together with its storage; jcal_hinge_window_attach() then tells the copy where its storage is.
typedef struct {
    jcal_hinge_window_config_t cfg;
    void *storage;
    jcal_score_t score;
    jcal_select_gyr_t gyr;
    jcal_select_acc_t acc;
    jcal_hinge_axes_t axes;  ///< The estimate, followed from sample to sample; its sign is free.
    float damping;
    float sign_margin;
    jcal_hinge_solve_t solve;
    jcal_hinge_accept_t accept;
    bool has_axes;
    bool has_stepped;
    uint64_t stepped_us;  ///< Time of the last sample that step worked off.
    uint64_t solve_due_us;
    /// A stream engine over the same samples: its bounds, its readiness; gate and inbox serve both.
    jcal_hinge_t guard;
    uint32_t inbox_ids[JCAL_INBOX_CAPACITY];  ///< Number of each pair in the inbox.
} jcal_hinge_window_t;

/// The defaults described at each field.
jcal_hinge_window_config_t jcal_hinge_window_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid.
const char *jcal_hinge_window_config_check(const jcal_hinge_window_config_t *config);

/// Bytes of storage that a config needs: JCAL_HINGE_WINDOW_STORAGE_BYTES of its fields.
size_t jcal_hinge_window_storage_bytes(const jcal_hinge_window_config_t *config);

/// Prepares an estimator; whatever `self` and the storage held before is lost.
///
/// Inputs:   storage, aligned for float, of at least jcal_hinge_window_storage_bytes(config); it belongs to `self`
///           as long as `self` is used.
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_CONFIG (jcal_hinge_window_config_check says which field); JCAL_ERR_STORAGE
///           (too small or not aligned); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_window_init(jcal_hinge_window_t *self,
                                                     const jcal_hinge_window_config_t *config, void *storage,
                                                     size_t storage_bytes);

/// Tells a copy of an estimator where the copy of its storage is.
///
/// Errors:   JCAL_ERR_ARG (null); JCAL_ERR_STORAGE (too small or not aligned); self untouched.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_window_attach(jcal_hinge_window_t *self, void *storage, size_t storage_bytes);

/// Takes in one sample pair: checks it and puts it into the inbox. May run in an interrupt that preempts step.
///
/// Returns:  JCAL_OK; JCAL_REJECTED (counted, see result); JCAL_ERR_ARG; JCAL_ERR_FULL.
jcal_status_t jcal_hinge_window_push(jcal_hinge_window_t *self, const jcal_pair_t *pair);

/// Works off one sample of the inbox: scores, selection, one Gauss-Newton step, a slice of the full solve.
///
/// Returns:  JCAL_OK; JCAL_IDLE if the inbox was empty; JCAL_ERR_ARG.
/// Cost:     (1 + JCAL_HINGE_WINDOW_SLICES) iterations, each about 130 n_max multiply-adds and 6 n_max square roots;
///           once, when more than n_max samples have been seen, O(n_max log n_max) moves of 32 bytes.
///           Stack <= 1.5 KiB.
jcal_status_t jcal_hinge_window_step(jcal_hinge_window_t *self);

/// Push and step in one call, for those who need no split. Returns what push returned.
jcal_status_t jcal_hinge_window_update(jcal_hinge_window_t *self, const jcal_pair_t *pair);

/// Copies the current result. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_hinge_window_get(const jcal_hinge_window_t *self, jcal_hinge_result_t *out);

/// Forgets all data, keeps the config and the storage. Errors: JCAL_ERR_ARG.
jcal_status_t jcal_hinge_window_reset(jcal_hinge_window_t *self);

/// Which samples are selected now, in no particular order: numbers of the pushes since init or reset, from 0,
/// rejected ones counted.
///
/// Inputs:   n_gyr, n_acc  room in gyr and acc; n_max is enough for each.
/// Outputs:  gyr, acc; n_gyr, n_acc how many. Untouched on error.
/// Errors:   JCAL_ERR_ARG (null, or too little room).
jcal_status_t jcal_hinge_window_selection(const jcal_hinge_window_t *self, uint32_t *gyr, size_t *n_gyr, uint32_t *acc,
                                          size_t *n_acc);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_WINDOW_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Sample selection of [OLS20] section 5, one sample at a time: scores, Algorithm 2 and Algorithm 3.
///
/// The score of a sample depends on n samples before and n after it, so it is known n samples later. All buffers
/// belong to the caller and are handed to every call; the structs hold no pointers and may be copied with them.
#ifndef JCAL_SELECT_H
#define JCAL_SELECT_H

#include "jointcal/types.h"

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Penalty (45) of a sample whose window is cut off: larger than any threshold.
#define JCAL_PENALTY_INFINITE 3.0e38f

/// Rows above this coherence (52) point mostly along w_1. [OLS20] 5.2
#define JCAL_COHERENT 0.5f

/// One selected sample of one kind. 32 bytes.
typedef struct {
    float key;    ///< What it is ranked by: s_w of (43), its negative, or s_a of (46).
    uint32_t id;  ///< Number of the sample, as the caller counts.
    float v[6];   ///< Gyroscope row: w1, w2 in rad/s. Accelerometer row of (53): a1, -a2 in m/s^2.
} jcal_row_t;

/// One sample that waits for its score. 64 bytes.
typedef struct {
    float w[6];  ///< w1, w2, rad/s.
    float a[6];  ///< a1, -a2, m/s^2.
    float
        least;  ///< Delta_w of (42), rad/s; after a round that of smallest magnitude from here to the end of the round.
    float energy1;  ///< |w1|^2, rad^2/s^2; after a round the sum from here to the end of the round.
    float energy2;  ///< The same for sensor 2.
    uint32_t id;
} jcal_score_slot_t;

/// A sample with its scores.
typedef struct {
    jcal_row_t gyr;  ///< key: s_w of (43), rad/s.
    jcal_row_t acc;  ///< key: s_a of (46), rad^2/s^2, or JCAL_PENALTY_INFINITE.
} jcal_scored_t;

/// Sliding window over the last 2n + 1 samples. All members are private.
///
/// Rounds of 2n + 1 samples: a window is the end of the last round (sums and minima from each slot to its end are
/// made once, when the round is complete) and the beginning of this one (running). Nothing is ever subtracted, so
/// nothing drifts, however long it runs, and slow samples after fast ones lose no digits.
typedef struct {
    uint16_t half_window;
    uint16_t pos;            ///< Slot of the next sample.
    bool full;               ///< A round has been completed since the last restart.
    float least;             ///< Delta_w of smallest magnitude in this round, rad/s.
    float energy1, energy2;  ///< Sums over this round.
} jcal_score_t;

/// Algorithm 2 as the samples come. All members are private.
typedef struct {
    uint32_t low_max;   ///< Room for the smallest scores: N_max / 2.
    uint32_t high_max;  ///< Room for the largest scores: the other half, one more if N_max is odd.
    uint32_t low;       ///< Rows held of the smallest scores: a heap at rows[0].
    uint32_t high;      ///< Rows held of the largest scores: a heap at rows[low_max].
} jcal_select_gyr_t;

/// Algorithm 3 as the samples come. All members are private.
typedef struct {
    uint32_t capacity;  ///< N_max.
    uint32_t acc_min;   ///< Rows kept whatever the threshold says, at most `capacity`.
    uint32_t count;     ///< Rows held: a heap, the largest penalty at rows[0].
    uint32_t seen;      ///< Rows offered; stops at `capacity`.
    float energy_max;   ///< E_th, rad^2/s^2.
    float ata[21];      ///< A^T A of (27), 6 x 6 packed.
} jcal_select_acc_t;

/// Prepares the window for half_window = n >= 0; `slots` of the other calls then has 2n + 1 elements.
void jcal_score_init(jcal_score_t *self, uint16_t half_window);

/// Forgets the samples that wait, after a gap in time: windows never reach across one.
void jcal_score_restart(jcal_score_t *self);

/// Takes in a sample and hands back the one whose window is now complete.
///
/// The first n samples after a start have a window cut off at the start, as in (44), and an infinite penalty (45).
///
/// Inputs:   pair, finite; id, handed back with the scores.
/// Outputs:  out, written if true is returned: the sample of n calls ago.
/// Returns:  false for the first n samples after a start.
/// Cost:     O(1), once in 2n + 1 calls O(n).
bool jcal_score_push(jcal_score_t *self, jcal_score_slot_t *slots, const jcal_pair_t *pair, uint32_t id,
                     jcal_scored_t *out);

/// Prepares Algorithm 2 for n_max samples; `rows` of the other calls then has n_max elements.
void jcal_select_gyr_init(jcal_select_gyr_t *self, uint32_t n_max);

/// Offers a scored sample. Afterwards the rows held are those of Algorithm 2 on all samples so far, up to equal scores.
///
/// Why nothing is lost: a row is dropped only when half of N_max rows score at least as high and half at least as low.
/// Later rows only add to both, so no row that was dropped could come back.
/// Cost:     O(log n_max).
void jcal_select_gyr_offer(jcal_select_gyr_t *self, jcal_row_t *rows, const jcal_row_t *row);

/// Prepares Algorithm 3; `rows` of the other calls then has n_max + 1 elements.
void jcal_select_acc_init(jcal_select_acc_t *self, uint32_t n_max, uint32_t acc_min, float energy_max);

/// Offers a scored sample; its key is the penalty (46).
///
/// - The first n_max samples are all kept. After that those above the threshold go, the largest first, but never so
///   many that fewer than acc_min are left.
/// - When there are more than n_max, the row with the largest penalty goes among those whose coherence with w_1 is
///   above JCAL_COHERENT, or among all if there is none (the paper is silent). w_1 is the top eigenvector of A^T A,
///   which is updated.
///
/// Cost:     12 n_max + 6,000 multiply-adds when the buffer is full; once, when the threshold begins to count,
///           O(n_max log n_max).
/// Source:   [OLS20] Algorithm 3, p. 15. Differs from the paper in: no SVD; a row that was removed does not come back.
void jcal_select_acc_offer(jcal_select_acc_t *self, jcal_row_t *rows, const jcal_row_t *row);

/// Sums A^T A anew from the rows, so that the rounding errors of updates do not add up. Cost: 21 n_max multiply-adds.
void jcal_select_acc_refresh(jcal_select_acc_t *self, const jcal_row_t *rows);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_SELECT_H */

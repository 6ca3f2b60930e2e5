/* SPDX-License-Identifier: MIT */
/// @file
/// Sample selection of [OLS20] section 5, one sample at a time: scores, Algorithm 2 and Algorithm 3.
///
/// The score of a sample depends on n samples before and n after it, so it is known n samples later. All buffers
/// belong to the caller and are handed to every call; the structs hold no pointers and may be copied with them.
#ifndef JCAL_SAMPLE_SELECT_H
#define JCAL_SAMPLE_SELECT_H

#include "jointcal/private/select.h"

#include <stddef.h>

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

#endif /* JCAL_SAMPLE_SELECT_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// State of the sample selection of [OLS20] section 5. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_SELECT_H
#define JCAL_PRIVATE_SELECT_H

#include "jointcal/types.h"

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

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_SELECT_H */

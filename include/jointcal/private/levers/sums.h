/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the lever residual of two sensors. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_LEVERS_SUMS_H
#define JCAL_PRIVATE_LEVERS_SUMS_H

#ifdef __cplusplus
extern "C" {
#endif

/// Products that depend on the relative heading, over a time in which that drifts little: of the horizontal rows of [U B] (4 x 4,
/// complex).
typedef struct {
    float re[16], im[16];
} jcal_lever_block_t;

/// Blocks that are kept apart: the open one, and one that is closed.
#define JCAL_LEVER_BLOCKS 2u

/// All sums.
typedef struct {
    float own1[10], own2[10];                     ///< S: [U B]' [U B] of each sensor (4 x 4, packed).
    float up[16];                                 ///< Sv: products of the vertical rows of [U B].
    float old[16];                                ///< Blocks that were merged, turned by their headings: as `up`.
    jcal_lever_block_t block[JCAL_LEVER_BLOCKS];  ///< Sc. 0 is open.
} jcal_lever_sums_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_LEVERS_SUMS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the functional joint. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_FUNCTIONAL_SUMS_H
#define JCAL_PRIVATE_FUNCTIONAL_SUMS_H

#include "jointcal/private/levers/sums.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Products that depend on the relative heading, over a time in which that drifts little.
typedef struct {
    float turn_re[9], turn_im[9];  ///< C: products of the horizontal rows of both orientations (3 x 3, complex).
    float rate[81];                ///< X4: spin1 (9) times spin2 (9), row-major.
    float motion_s;                ///< Weight: seconds of motion.
    float time_s;                  ///< Seconds.
} jcal_functional_block_t;

/// Blocks that are kept apart: the open one, and one that is closed.
#define JCAL_FUNCTIONAL_BLOCKS JCAL_LEVER_BLOCKS

/// All sums.
typedef struct {
    float motion_s;              ///< W: seconds of motion.
    float rate2;                 ///< Wr: what the squared rates weigh: sum of their weight times both squared rates.
    float turn_up[9];            ///< V: products of the vertical rows of both orientations.
    float rate1[6], rate2nd[6];  ///< A: spin' spin of each sensor (3 x 3, packed).
    float along[9];              ///< G: rate of sensor 1 times rate of sensor 2, each in its frame.
    float rate_up[9];            ///< Products of the vertical rows of spin.
    /// Blocks that were merged, turned by their headings: as turn_up, rate_up; `rate_free` by their relative turns.
    float old_turn[9], old_rate[9], rate_free[9];
    jcal_lever_sums_t levers;
    jcal_functional_block_t block[JCAL_FUNCTIONAL_BLOCKS];  ///< 0 is open.
} jcal_functional_sums_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_FUNCTIONAL_SUMS_H */

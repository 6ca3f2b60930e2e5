/* SPDX-License-Identifier: MIT */
/// @file
/// State of the estimate of a lag. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_PAIRING_LAG_H
#define JCAL_PRIVATE_PAIRING_LAG_H

#include "jointcal/private/levers/sums.h"
#include "jointcal/private/levers/ticks.h"
#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Nodes, the lags at which is summed, on each side of zero; and all of them. They are one tick apart.
#define JCAL_LAG_SIDE 6
#define JCAL_LAG_NODES ((2 * JCAL_LAG_SIDE) + 1)

/// [U B] of a tick, column by column.
typedef struct {
    jcal_vec3_t column[4];
} jcal_lag_columns_t;

/// What depends on the lag: sums over F_1(t) and F_2(t + lag). Nothing but floats.
typedef struct {
    float own2[10];             ///< F_2' F_2 (4 x 4, packed).
    float up[16];               ///< Products of the vertical rows (4 x 4).
    jcal_lever_block_t across;  ///< Of the horizontal rows (4 x 4, complex).
} jcal_lag_node_t;

/// All sums. Nothing but floats.
typedef struct {
    float own1[10];  ///< F_1' F_1 (4 x 4, packed).
    float count;     ///< Terms of each sum.
    float motion_s;  ///< Motion in them, s.
    jcal_lag_node_t node[JCAL_LAG_NODES];
} jcal_lag_sums_t;

/// What is left at one lag.
typedef struct {
    float lag;  ///< Nodes.
    jcal_plane_t heading;
    float lack, own;  ///< Sum of squares that is left, and of both sides, (m/s)^2.
} jcal_lag_point_t;

/// Where the search is.
typedef struct {
    jcal_lag_point_t point;       ///< That is worked at.
    jcal_lag_point_t trial;       ///< The best of the headings at this node.
    jcal_lag_point_t best;        ///< The best so far; then the middle of the parabola.
    float least[JCAL_LAG_NODES];  ///< Least share that is left at each node.
    float before, after;          ///< Share on both sides of the middle.
    float bend;                   ///< Second derivative of the share, per node^2.
    uint8_t slice;                ///< Next slice.
} jcal_lag_search_t;

/// What the last judgement found.
typedef struct {
    float lag_s;     ///< Beside what was taken off.
    float bound_s;   ///< 95 %.
    float share;     ///< Of the squares of both sides, what is left.
    float rival;     ///< How much more another lag leaves.
    float speed2;    ///< Mean square of the centre's velocity, (m/s)^2.
    uint8_t agreed;  ///< Judgements in a row that agree.
} jcal_lag_verdict_t;

/// The estimate of a lag. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_tick_pair_t ticks;
    jcal_lag_sums_t sums;
    jcal_lag_columns_t past1[JCAL_LAG_SIDE + 1];  ///< Oldest first ...
    jcal_lag_columns_t past2[JCAL_LAG_NODES];     ///< ... and the same of sensor 2.
    jcal_lag_search_t search;
    jcal_lag_verdict_t verdict;
    float node_s;         ///< Distance of nodes.
    float taken_s;        ///< Lag that was taken off.
    float left_s;         ///< Lag beside it that is known.
    float known_bound_s;  ///< Bound of both together; JCAL_LAG_UNKNOWN_S before it is known.
    uint8_t filled;       ///< Ticks in past2.
    bool skips;           ///< The next tick is kept only: every second one is summed.
    bool half_done;       ///< The last tick is not yet in the sums of all nodes.
    bool known;
    bool prepared;
} jcal_lag_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_PAIRING_LAG_H */

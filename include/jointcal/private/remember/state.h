/* SPDX-License-Identifier: MIT */
/// @file
/// State of a remembered calibration; lib/remember/sums.h has the equations. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_REMEMBER_STATE_H
#define JCAL_PRIVATE_REMEMBER_STATE_H

#include "jointcal/keep.h"
#include "jointcal/private/levers/ticks.h"
#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Kinds of residuals: of the axis' direction in space, of how it moves, of the centre's velocity.
#define JCAL_REMEMBER_KINDS 3u

/// Products a' Rz b of the columns of two 3 x 3 matrices: cos of `re`, sin of `im`, and `up`. Row by row.
typedef struct {
    float re[9], im[9], up[9];
} jcal_remember_products_t;

/// Sums of one block, in which the heading stands still. Nothing but floats.
typedef struct {
    jcal_remember_products_t turn, rate;
    float turn_coupling[2], rate_coupling[2];  ///< Of axis 2's tilts and the heading.
    float rate1[6], rate2[6];                  ///< Products of each sensor's own rates, packed.
    float lever[3];                            ///< As jcal_remember_products_t, of one column.
    float gain;      ///< Squares of both B: what levers that are off by 1 m would leave, times 3.
    float power;     ///< Squares of both sides of the lever residual.
    float motion_s;  ///< W.
    float time_s;
} jcal_remember_sums_t;

/// Closed blocks, headings eliminated. Nothing but floats.
typedef struct {
    float matrix[10];                 ///< Of the tilts (4 x 4, packed).
    float gradient[4];                ///< Half the gradient.
    float cost[JCAL_REMEMBER_KINDS];  ///< Sums of squares.
    float gain, power, motion_s, bend2;
    float evidence;  ///< For the pairing of signs.
} jcal_remember_past_t;

/// A remembered calibration. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_kept_t kept;
    jcal_vec3_t e1[3], e2[3];  ///< u, v, axis of each sensor.
    jcal_tick_pair_t ticks;
    jcal_remember_sums_t block;
    jcal_remember_past_t past;
    jcal_plane_t heading;          ///< Best one of the grid ...
    float score;                   ///< ... and what it costs.
    float evidence;                ///< What the last look said of the pairing.
    float off1_rad, off2_rad;      ///< What the last look said: how far the axes want to be elsewhere ...
    float sigma1_rad, sigma2_rad;  ///< ... how well that is known ...
    float lack;                    ///< ... and what is left of the centre's motion.
    float speed_m_s, bend_rad, motion_s;
    uint8_t state, reason;
    uint8_t count;               ///< Ticks since the last look.
    uint8_t slice;               ///< Next slice of the look; 0: none is due.
    uint8_t for_it, against_it;  ///< Looks in a row that would confirm it, or drop it.
    bool has_axes, has_levers;
} jcal_remember_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_REMEMBER_STATE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Ticks of two sensors into the sums that headings and levers are solved from. Private.
#ifndef JCAL_BALL_SUMS_H
#define JCAL_BALL_SUMS_H

#include "jointcal/private/ball/stream.h"
#include "jointcal/tick.h"
#include "levers/ticks.h"

#include <stdbool.h>

/// Adds a tick of both sensors, of the same time. Cost: 140 multiply-adds.
void jcal_ball_sums_add(jcal_ball_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                        const jcal_tick_weights_t *weights);

/// True if the open block is long enough to be closed.
bool jcal_ball_sums_full(const jcal_ball_sums_t *self);

/// Closes the open block and begins another; the block before is merged with `heading`.
void jcal_ball_sums_close(jcal_ball_sums_t *self, jcal_plane_t heading);

/// All sums count `share` of what they did.
void jcal_ball_sums_fade(jcal_ball_sums_t *self, float share);

/// What one fixed rotation leaves of both rates, beside the smaller of them: little where both sensors sit on one segment. Cost: about 200
/// multiply-adds.
float jcal_ball_sums_stiffness(const jcal_ball_sums_t *self);

#endif /* JCAL_BALL_SUMS_H */

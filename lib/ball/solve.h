/* SPDX-License-Identifier: MIT */
/// @file
/// Levers and headings of the ball joint, each the best for what the other is. Private.
///
/// Half the sum of squares, each unit counting l = 1 / (s (0.16 W + 1 s)), s the mean square of the residual and W the motion, less what
/// ties the headings: Re(conj(h0) h1) / sigma^2, sigma = 2 deg, for open and closed block, and the same for the closed block and the
/// blocks that were merged, less sure by what their heading's information is worth. Source: docs/METHOD_PEOPLE.md, section 10.
#ifndef JCAL_BALL_SOLVE_H
#define JCAL_BALL_SOLVE_H

#include "jointcal/private/ball/stream.h"

/// 1 / sigma^2 of what a heading may change by from block to block, sigma = 2 deg.
#define JCAL_BALL_PULL 820.7016f

/// Slices of a round.
#define JCAL_BALL_ROUND_SLICES 2u

/// l: what a unit of the sum of squares counts at `point`.
float jcal_ball_weight(const jcal_ball_sums_t *sums, const jcal_ball_point_t *point);

/// What the merged blocks' heading is worth one block later, 1/rad^2.
float jcal_ball_past_pull(const jcal_ball_past_t *past);

/// Slice `part` of a round that improves `point`: 0 levers, and what they leave; 1 the headings of the closed and of the open block.
/// Cost: at most 500 multiply-adds.
void jcal_ball_round(const jcal_ball_sums_t *sums, const jcal_ball_past_t *past, jcal_ball_point_t *point,
                     unsigned part);

/// The closed block of `point` is about to be merged: its heading and what it knows of it join what is known of the past. `left`, as of
/// ball/bounds.h: information about both headings once the levers have taken their share; all of the closed block's that is no tie.
void jcal_ball_past_add(jcal_ball_past_t *past, const jcal_ball_point_t *point, const float *left);

/// All headings of `point` turn by 45 deg times `number`.
void jcal_ball_turn(jcal_ball_point_t *point, unsigned number);

#endif /* JCAL_BALL_SOLVE_H */

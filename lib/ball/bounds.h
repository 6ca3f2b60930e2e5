/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds of heading and levers: what the sums know of each once the others have taken their share. Private.
///
/// The information about r1, r2 and both blocks' headings is the second derivative of the cost (ball/solve.h), and 1/m^2 for
/// each component of a lever, which is known beforehand. The bound of the heading is
/// twice its standard deviation. That of a lever is 3 mm, half of its standard deviation in the direction that is known least, what errors
/// of the regressors shorten it by, and what no IMU can see: skin that goes along with its own segment, 17 % of the proximal lever and 10 %
/// of the distal one. Source: docs/METHOD_PEOPLE.md, section 10.
#ifndef JCAL_BALL_BOUNDS_H
#define JCAL_BALL_BOUNDS_H

#include "jointcal/private/ball/stream.h"

/// Slices: the heading's bound; both levers' covariances; what errors of the regressors are worth, and the levers' bounds.
#define JCAL_BALL_BOUND_SLICES 3u

/// Slice `part`; sets heading_rad, bound1_m and bound2_m of the verdict. Cost: at most 700 multiply-adds.
void jcal_ball_bound(jcal_ball_t *self, unsigned part);

/// Parts of the information at `point`: about both levers (6 x 6, packed), their coupling to both headings (2 x 6), and about the headings
/// (2 x 2, packed). A closed block without motion has 1 for its own and no coupling.
void jcal_ball_information(const jcal_ball_sums_t *sums, const jcal_ball_past_t *past, const jcal_ball_point_t *point,
                           float *levers, float *coupling, float *headings);

#endif /* JCAL_BALL_BOUNDS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds of heading and levers: what the sums know of each once the others have taken their share. Private.
///
/// The information about r1, r2 and both blocks' headings is the second derivative of the cost (ball/solve.h). The bound of the heading is
/// twice its standard deviation. That of a lever is 3 mm, half of its standard deviation in the direction that is known least, what the ridge
/// of its solve and errors of the regressors shorten it by, and what no IMU can see: skin that goes along with its own segment, 17 % of the
/// proximal lever and 10 % of the distal one. Source: docs/METHOD_PEOPLE.md, section 10.
///
/// A segment that hardly turns tells nothing of its own lever, and the other lever and the heading do not depend on that one: so the
/// information is given 1e-5 of its largest diagonal element in all directions, and a lever that is known by that alone has no bound.
/// Errors of the regressors may leave nothing of what is known of both levers. Then each is asked for by itself, with no such errors of
/// the other.
#ifndef JCAL_BALL_BOUNDS_H
#define JCAL_BALL_BOUNDS_H

#include "jointcal/private/ball/stream.h"

/// Shares of the proximal and of the distal lever that skin may hide by going along with its segment.
#define JCAL_BALL_SKIN1 0.17f
#define JCAL_BALL_SKIN2 0.10f

/// Slices: the heading's bound; both levers' covariances; what errors of the regressors are worth, and the levers' bounds.
#define JCAL_BALL_BOUND_SLICES 3u

/// Slice `part`; sets heading_rad, bound1_m and bound2_m of the verdict. Cost: at most 900 multiply-adds.
void jcal_ball_bound(jcal_ball_t *self, unsigned part);

/// The information at a point, in parts.
typedef struct {
    float levers[21];    ///< About both levers (6 x 6, packed).
    float coupling[12];  ///< Of the levers to both headings (2 x 6).
    float headings
        [3];  ///< About the headings (2 x 2, packed). A closed block without motion has 1 for its own and no coupling.
} jcal_ball_information_t;

/// What the sums and the past tell of a point.
void jcal_ball_information(const jcal_ball_sums_t *sums, const jcal_ball_past_t *past, const jcal_ball_point_t *point,
                           jcal_ball_information_t *out);

#endif /* JCAL_BALL_BOUNDS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A low-pass of the rates: what is faster than joints move is not joint motion and must not pass for information. Private.
///
/// Two first-order low-passes in a row, 5 Hz in all, for each component of both rates:
///
///     h <- h + a (w - h),   s <- s + a (h - s),   a = 1 - exp(-dt / T),   T = sqrt(sqrt 2 - 1) / (2 pi 5 Hz) = 20.5 ms
///
/// Of 20 Hz 13 % are left, of 33 Hz 5 %. Both rates are delayed alike, by 41 ms, so that (14) holds of them as long as the joint turns
/// little in that time; what it does not hold by is met as a residual, which the bounds know of (hinge/bounds.h).
///
/// The specific forces are as they were: (18) holds at each moment by itself, no rate takes part in it. docs/METHOD.md, section 2.
#ifndef JCAL_HINGE_SMOOTH_H
#define JCAL_HINGE_SMOOTH_H

#include "jointcal/private/hinge/smooth.h"
#include "jointcal/types.h"

/// Begins at this pair's rates: the first one, or one behind a gap.
void jcal_hinge_smooth_begin(jcal_hinge_smooth_t *self, const jcal_pair_t *pair);

/// The pair, `dt_s` after the one before it, with smooth rates.
///
/// Cost:     about 60 multiply-adds.
jcal_pair_t jcal_hinge_smooth(jcal_hinge_smooth_t *self, const jcal_pair_t *pair, float dt_s);

#endif /* JCAL_HINGE_SMOOTH_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Which way to read the rates lets gravity stay where it is. Private.
///
/// A window is 40 blocks, four seconds. With a way M, R_k the orientation by the turns M th, and m_i the mean of R a over part i of the window,
/// one second each, what M leaves open is
///
///     sum |m_i - mean m|^2 / sum |m_i|^2.
///
/// If M is right it is what the velocity changes by within a second, 0.1 to 1 %; else up to 1. A way of the forces, a <- P a, is the way
/// det(P) P' of the rates, since their vector product is one: so 48 ways of the rates are all there are, and forces that all have the
/// other sign are no way at all.
///
/// Nearly always the rates fit as they stand, so that way is tried first, and the way of no rates, which says whether the window tells anything. All
/// others are tried in the first windows that tell, and then in those that the rates leave open by more than JCAL_HEALTH_OPEN.
#ifndef JCAL_HEALTH_FRAMES_H
#define JCAL_HEALTH_FRAMES_H

#include "jointcal/private/health/state.h"

/// The way that leaves rates as they are, that of rates in deg/s, and that without rates.
#define JCAL_HEALTH_AS_IS 0u
#define JCAL_HEALTH_DEG 48u
#define JCAL_HEALTH_STILL 49u

/// What rates may leave open and fit all the same.
#define JCAL_HEALTH_OPEN 0.004f

/// All begins anew.
void jcal_health_frames_begin(jcal_health_frames_t *self);

/// The window begins anew; sums stay.
void jcal_health_frames_break(jcal_health_frames_t *self);

/// Takes in a full block, unless a full window is being worked at.
void jcal_health_frames_add(jcal_health_frames_t *self, const jcal_health_block_t *block);

/// A slice of work at a full window: one part of one way. Cost: ten turns; none if there is no full window.
void jcal_health_frames_step(jcal_health_frames_t *self);

/// Columns and signs of way `index` of the first 48.
jcal_health_way_t jcal_health_frames_way(unsigned index);

/// Sum over windows of what a way leaves open.
float jcal_health_frames_score(const jcal_health_frames_t *self, unsigned way);

/// The way of the 48 that leaves least, and what the next one leaves.
unsigned jcal_health_frames_best(const jcal_health_frames_t *self, float *next);

#endif /* JCAL_HEALTH_FRAMES_H */

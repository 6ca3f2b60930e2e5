/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum and looks for others, one bounded slice at a time. Private.
#ifndef JCAL_HINGE_SEARCH_H
#define JCAL_HINGE_SEARCH_H

#include "jointcal/hinge.h"

/// One Gauss-Newton step of the estimate.
void jcal_hinge_track(jcal_hinge_t *self);

/// One slice of the global check: begins a probe from the next start, or moves it by one step, or files what it found.
///
/// Starts: the 9 pairs of eigenvectors of the rates' second moments, each with the sign pairing that the specific forces
/// prefer, then the present estimate with axis 2 turned round.
void jcal_hinge_search(jcal_hinge_t *self);

/// The other sign pairing becomes the estimate.
void jcal_hinge_turn_round(jcal_hinge_t *self);

/// The best axes of the other sign pairing.
jcal_hinge_point_t jcal_hinge_flipped(const jcal_hinge_t *self);

/// Cost of the best other minimum.
float jcal_hinge_cost_of_rival(const jcal_hinge_t *self);

#endif /* JCAL_HINGE_SEARCH_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A look at the sums: heading, how far the axes want to be elsewhere, evidence for the pairing. Private.
#ifndef JCAL_REMEMBER_LOOK_H
#define JCAL_REMEMBER_LOOK_H

#include "jointcal/private/remember/state.h"

/// Motion in the open block below which there is nothing to look at, s.
#define JCAL_REMEMBER_BLOCK_MIN_S 0.3f

/// First slice: the best heading.
void jcal_remember_look_heading(jcal_remember_t *self);

/// Second slice: the other pairing with its own best heading.
void jcal_remember_look_pairing(jcal_remember_t *self);

/// Third slice: what the axes want. If `closes`, the open block goes to the past and another begins.
void jcal_remember_look_axes(jcal_remember_t *self, bool closes);

#endif /* JCAL_REMEMBER_LOOK_H */

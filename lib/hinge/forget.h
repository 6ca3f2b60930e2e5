/* SPDX-License-Identifier: MIT */
/// @file
/// Giving up some of what the refined axes' sums know. Private. Equations: hinge/refine.h.
#ifndef JCAL_HINGE_FORGET_H
#define JCAL_HINGE_FORGET_H

#include "jointcal/private/hinge/refine.h"

/// Multiplies all sums by a share: what they rest on counts so much less.
void jcal_hinge_refine_fade(jcal_hinge_refine_t *self, float share);

/// Gives up all but a share of what the sums know of one axis (0, 1); the other one keeps what it owes to itself alone.
void jcal_hinge_refine_forget(jcal_hinge_refine_t *self, unsigned axis, float keep);

/// The same, but what is known of the residuals stays.
void jcal_hinge_refine_forget_axis(jcal_hinge_refine_t *self, unsigned axis, float keep);

#endif /* JCAL_HINGE_FORGET_H */

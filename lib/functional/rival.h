/* SPDX-License-Identifier: MIT */
/// @file
/// The other pairing of signs, solved as well as this one, and what speaks for this one. Private.
///
/// With all headings half a turn on, (j1, -j2) explains orientations and rates nearly as well as (j1, j2) does here, and exactly so for
/// a vertical axis; the joint's centre tells the two apart.
#ifndef JCAL_FUNCTIONAL_RIVAL_H
#define JCAL_FUNCTIONAL_RIVAL_H

#include "jointcal/private/functional/stream.h"

/// Slices of the comparison.
#define JCAL_FUNCTIONAL_RIVAL_SLICES 4u

/// Slice `part`: 0 levers, 1 and 2 axes of the other pairing, 3 compares: evidence and opposite of `verdict`. Uses search.trial.
void jcal_functional_compare(jcal_functional_t *self, unsigned part);

/// The other pairing becomes the estimate.
void jcal_functional_turn_round(jcal_functional_t *self);

#endif /* JCAL_FUNCTIONAL_RIVAL_H */

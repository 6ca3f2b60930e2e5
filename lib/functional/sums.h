/* SPDX-License-Identifier: MIT */
/// @file
/// Ticks of two sensors into sums that hold everything the functional joint is solved from. Private.
///
/// What does not depend on the relative heading is summed once. What does is summed in blocks of 5 s, so that a heading that drifts
/// may be another one in each; a block that is too old to be told apart is merged with the heading that it had.
/// Source: docs/METHOD_PEOPLE.md, section 2.
#ifndef JCAL_FUNCTIONAL_SUMS_H
#define JCAL_FUNCTIONAL_SUMS_H

#include "jointcal/private/functional/point.h"
#include "jointcal/private/functional/sums.h"
#include "jointcal/tick.h"
#include "levers/ticks.h"

#include <stdbool.h>

/// Adds a tick of both sensors, of the same time. Cost: 330 multiply-adds.
void jcal_functional_sums_add(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                              const jcal_tick_weights_t *weights);

/// True if the open block is long enough to be closed.
bool jcal_functional_sums_full(const jcal_functional_sums_t *self);

/// True if the newest block has motion enough to have a heading of its own.
bool jcal_functional_sums_has_heading(const jcal_functional_sums_t *self);

/// Closes the open block and begins another, with the same heading; the block before is merged with the heading it has in `point`.
void jcal_functional_sums_close(jcal_functional_sums_t *self, jcal_functional_point_t *point);

/// All sums count `share` of what they did.
void jcal_functional_sums_fade(jcal_functional_sums_t *self, float share);

/// The other pairing: all merged headings turn by half a turn.
void jcal_functional_sums_reverse(jcal_functional_sums_t *self);

#endif /* JCAL_FUNCTIONAL_SUMS_H */

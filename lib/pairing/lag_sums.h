/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at a few lags, and what they would be between them. Private.
///
/// Node k of JCAL_LAG_NODES stands for a lag of k - JCAL_LAG_SIDE nodes. Each has the same terms F_1(t), with F_2(t + lag), so that what is
/// left is a sum of squares at every node; the terms of sensor 1 are JCAL_LAG_SIDE nodes old when they are summed. A term is put into the
/// sums in two halves, so that no call is long.
#ifndef JCAL_PAIRING_LAG_SUMS_H
#define JCAL_PAIRING_LAG_SUMS_H

#include "jointcal/private/pairing/lag.h"
#include "jointcal/tick.h"

#include <stdbool.h>

/// Keeps a tick of both sensors; forgets the oldest.
void jcal_lag_sums_keep(jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// Puts what is kept into the sums of the first half of the nodes; nothing before enough is kept. Cost: 800 multiply-adds.
void jcal_lag_sums_begin(jcal_lag_t *self);

/// Puts it into those of the other half, if that is still to do. True if it was. Cost: 700 multiply-adds.
bool jcal_lag_sums_finish(jcal_lag_t *self);

/// All sums times `share`.
void jcal_lag_sums_fade(jcal_lag_sums_t *self, float share);

/// The sums of the lever equation (levers/levers.h) at any lag, nodes, within the outer ones: the polynomial through the seven nearest nodes.
/// Everything that depends on the heading is in block 0. Cost: 500 multiply-adds.
void jcal_lag_sums_at(const jcal_lag_sums_t *self, float lag, jcal_lever_sums_t *out);

#endif /* JCAL_PAIRING_LAG_SUMS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at a few lags, and what they would be between them. Private.
///
/// Node k of JCAL_LAG_NODES stands for a lag of k - JCAL_LAG_SIDE nodes. Each has the same terms F_1(t), with F_2(t + lag), so that what is
/// left is a sum of squares at every node; the terms of sensor 1 are JCAL_LAG_SIDE nodes old when they are summed.
#ifndef JCAL_PAIRING_LAG_SUMS_H
#define JCAL_PAIRING_LAG_SUMS_H

#include "jointcal/private/pairing/lag.h"
#include "jointcal/tick.h"

/// Takes in a tick of both sensors; forgets the oldest. Cost: 800 multiply-adds.
void jcal_lag_sums_take(jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// All sums times `share`.
void jcal_lag_sums_fade(jcal_lag_sums_t *self, float share);

/// The sums of the lever equation (levers/levers.h) at any lag, nodes, within the outer ones: the polynomial through all nodes. Everything
/// that depends on the heading is in block 0. Cost: 500 multiply-adds.
void jcal_lag_sums_at(const jcal_lag_sums_t *self, float lag, jcal_lever_sums_t *out);

#endif /* JCAL_PAIRING_LAG_SUMS_H */

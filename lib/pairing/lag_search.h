/* SPDX-License-Identifier: MIT */
/// @file
/// The lag that leaves least, in slices. Private.
///
///     J(lag) = min over r_1, r_2, heading of  sum |F_1(t) [1; -r_1] - Rz(heading) F_2(t + lag) [1; -r_2]|^2
///
/// as a share of both sides. A round is the levers for the heading, then the heading for the levers. At each node two rounds from four
/// headings and one more from the best of them; from the best node parabolas through three lags, two rounds at each.
#ifndef JCAL_PAIRING_LAG_SEARCH_H
#define JCAL_PAIRING_LAG_SEARCH_H

#include "jointcal/private/pairing/lag.h"

#include <stdbool.h>

/// Slices of a search.
#define JCAL_LAG_SEARCH_SLICES 135u

/// One slice of the search; the next call goes on. True if it was the last one: then search.best and search.bend are what was found.
/// Cost: 1000 multiply-adds.
bool jcal_lag_search(jcal_lag_t *self);

/// Share of the squares of both sides that is left at a point.
float jcal_lag_share(const jcal_lag_point_t *point);

/// The least share at a node that is no neighbour of `lag`, nodes.
float jcal_lag_rival(const jcal_lag_search_t *search, float lag);

#endif /* JCAL_PAIRING_LAG_SEARCH_H */

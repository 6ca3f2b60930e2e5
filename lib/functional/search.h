/* SPDX-License-Identifier: MIT */
/// @file
/// Other headings: where the cost has its minima is not known beforehand, so solutions are begun at eight of them. Private.
#ifndef JCAL_FUNCTIONAL_SEARCH_H
#define JCAL_FUNCTIONAL_SEARCH_H

#include "jointcal/private/functional/stream.h"

#include <stdbool.h>

/// Slices of one trial.
#define JCAL_FUNCTIONAL_TRIAL_SLICES 9u

/// Trials before the first judgement: eight headings, with the axes that are known least.
#define JCAL_FUNCTIONAL_FIRST_TRIALS 8u

/// All trials: the same with the axes that are known second least. They take turns as long as headings may be begun anew.
#define JCAL_FUNCTIONAL_TRIALS 16u

/// Slices of a round.
#define JCAL_FUNCTIONAL_ROUND_SLICES 3u

/// Slice `part` of a round that improves `point`: 0 levers, 1 axes, 2 the headings of both blocks. Cost: at most 600 multiply-adds.
void jcal_functional_round(const jcal_functional_sums_t *sums, jcal_functional_point_t *point, unsigned part);

/// Slice `part` of a trial: 0 begins it, the others are rounds, the last one, of axes, compares. True if the trial became the estimate.
bool jcal_functional_try(jcal_functional_search_t *self, const jcal_functional_sums_t *sums,
                         jcal_functional_point_t *estimate, unsigned part);

#endif /* JCAL_FUNCTIONAL_SEARCH_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A sample and how much it counts. Private. Method: docs/METHOD.md section 2.
#ifndef JCAL_HINGE_WEIGH_H
#define JCAL_HINGE_WEIGH_H

#include "hinge/block.h"
#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/moments.h"
#include "jointcal/private/hinge/weigh.h"

/// Weighs a pair that stands for `dt_s`.
jcal_hinge_sample_t jcal_hinge_weigh(jcal_hinge_weigh_t *self, const jcal_hinge_config_t *cfg, const jcal_pair_t *pair,
                                     float dt_s);

/// Counts a sample in the sums that limit or gate all others.
void jcal_hinge_count(jcal_hinge_amount_t *self, const jcal_hinge_sample_t *sample);

#endif /* JCAL_HINGE_WEIGH_H */

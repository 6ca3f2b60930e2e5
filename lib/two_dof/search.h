/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum of a 2-DoF joint and looks for others, one bounded slice at a time. Private.
#ifndef JCAL_TWO_DOF_SEARCH_H
#define JCAL_TWO_DOF_SEARCH_H

#include "jointcal/private/two_dof/moments.h"
#include "jointcal/private/two_dof/prior.h"
#include "jointcal/private/two_dof/search.h"
#include "jointcal/two_dof_config.h"

/// What is searched: the cost, and where the joint stands.
typedef struct {
    const jcal_two_dof_moments_t *moments;
    const jcal_two_dof_prior_t *prior;
    const jcal_orientation_pair_t *pose;  ///< The orientations last taken.
    jcal_constraint_t constraint;
    float moving_s;  ///< Time in the moments, rest left out; positive.
    float excess;    ///< The moments' cost is divided by this, so that it can be compared with the prior.
} jcal_two_dof_landscape_t;

/// What a slice came to.
typedef enum {
    JCAL_TWO_DOF_HALF_DONE,  ///< The same once more.
    JCAL_TWO_DOF_DONE,
    JCAL_TWO_DOF_ESTIMATE  ///< Done, and there is another estimate than before, not merely a better place of the same minimum.
} jcal_two_dof_found_t;

/// Half a Gauss-Newton step of the estimate. When it is done `lin` is that of the moments at the estimate, without the prior.
jcal_two_dof_found_t jcal_two_dof_track(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape);

/// Cost of the rival by now.
void jcal_two_dof_compare(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape);

/// A new start of the probe, or half a step of it.
jcal_two_dof_found_t jcal_two_dof_probe(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape);

#endif /* JCAL_TWO_DOF_SEARCH_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// What forgotten samples said of the axes. Private.
///
/// The heading offset drifts, so samples are forgotten; what they said of the axes is kept as a quadratic in the offset
/// o = T_anchor' j from an anchor, the heading offset eliminated. o and its slope T_anchor' T(j) are exact at any distance; that the
/// form is quadratic holds near the anchor, which is the estimate at the time of the last fading.
#ifndef JCAL_TWO_DOF_PRIOR_H
#define JCAL_TWO_DOF_PRIOR_H

#include "jointcal/private/two_dof/moments.h"
#include "jointcal/private/two_dof/prior.h"
#include "two_dof/point.h"

/// all <- lin + the prior's cost, gradient and matrix at `point`; `all` may be `lin`.
void jcal_two_dof_prior_apply(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point,
                              const jcal_two_dof_lin_t *lin, jcal_two_dof_lin_t *all);

/// Cost alone.
float jcal_two_dof_prior_cost(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point);

/// Takes over `share` of what the sums say at `point`, where `lin` is theirs without the prior; the anchor moves there.
void jcal_two_dof_prior_take(jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point,
                             const jcal_two_dof_lin_t *lin, float share);

#endif /* JCAL_TWO_DOF_PRIOR_H */

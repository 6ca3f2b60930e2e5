/* SPDX-License-Identifier: MIT */
/// @file
/// What the sums say of the joint itself: how it bends, and how purely about one axis. Private.
#ifndef JCAL_FUNCTIONAL_DESCRIBE_H
#define JCAL_FUNCTIONAL_DESCRIBE_H

#include "functional/axes.h"
#include "jointcal/private/functional/stream.h"

/// share and bend_rad of the verdict, from X of both kinds of residuals at the estimate. Cost: about 120 multiply-adds.
void jcal_functional_describe(jcal_functional_t *self, const jcal_functional_cross_t *x);

/// stiffness of the verdict: eigenvalues of a 3 x 3. Cost: about 200 multiply-adds.
void jcal_functional_stiffness(jcal_functional_t *self);

#endif /* JCAL_FUNCTIONAL_DESCRIBE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// 95 % bounds of the two axes. Private. Method: docs/METHOD.md section 5.
#ifndef JCAL_HINGE_BOUNDS_H
#define JCAL_HINGE_BOUNDS_H

#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/moments.h"
#include "jointcal/private/hinge/refine.h"

#include <stdbool.h>

/// What a judgement rests on.
typedef struct {
    float bound1_rad;  ///< 95 % bound of axis 1; JCAL_BOUND_UNKNOWN_RAD if its direction is open.
    float bound2_rad;
    /// How much more the gradient scatters than independent residuals of the assumed size would make it.
    float inflation;
} jcal_hinge_bounds_t;

/// Bounds of the refined axes. False if there is not enough data for a statement.
bool jcal_hinge_bounds(const jcal_hinge_refine_t *refine, const jcal_hinge_moments_t *moments,
                       const jcal_hinge_config_t *cfg, jcal_hinge_bounds_t *out);

#endif /* JCAL_HINGE_BOUNDS_H */

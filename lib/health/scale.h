/* SPDX-License-Identifier: MIT */
/// @file
/// How fast gravity turns against the sensor, beside what its rates say. Private.
///
/// With R the orientation by the rates, low-passes of R a with time constants of 2 and 10 s, fast and slow, are both gravity, up to what the
/// velocity leaves. Seen from the sensor, f <- R_k' f + q (a - R_k' f). If the true rates are s w + b, both change by J (s - 1, b), where
///
///     d/ds f <- (1 - q) (R_k' d/ds f - p x f),   d/db f <- (1 - q) (R_k' d/db f + h [f]x)
///
/// and e = fast - slow must vanish: weighted least squares for s and b. What is left of e, one reading of three for each 2 s, says how
/// well s is known.
#ifndef JCAL_HEALTH_SCALE_H
#define JCAL_HEALTH_SCALE_H

#include "jointcal/private/health/state.h"

/// What the sums tell.
typedef struct {
    float scale;      ///< 1 if nothing is known.
    float deviation;  ///< Standard deviation of it; 1 if nothing is known.
} jcal_health_scale_found_t;

/// Both low-passes begin anew; sums stay.
void jcal_health_scale_break(jcal_health_scale_t *self);

/// True if the scale may be judged with this block: who says then whether it may be taken off has to know.
bool jcal_health_scale_is_due(const jcal_health_scale_t *self, const jcal_health_block_t *block);

/// Takes in a full block; a scale that is far off may be taken off, if it is due. Cost: about 600 multiply-adds.
void jcal_health_scale_add(jcal_health_scale_t *self, const jcal_health_block_t *block, bool may_take);

/// What rates are multiplied by.
static inline float jcal_health_scale_taken(const jcal_health_scale_t *self)
{
    return (self->taken > 0.0f) ? self->taken : 1.0f;
}

/// Solves. Cost: about 100 multiply-adds.
jcal_health_scale_found_t jcal_health_scale_solve(const jcal_health_scale_t *self);

#endif /* JCAL_HEALTH_SCALE_H */

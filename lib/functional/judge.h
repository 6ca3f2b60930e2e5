/* SPDX-License-Identifier: MIT */
/// @file
/// Readiness of the functional joint: what stands between the estimate and `ready`, the worst first. Private.
#ifndef JCAL_FUNCTIONAL_JUDGE_H
#define JCAL_FUNCTIONAL_JUDGE_H

#include "jointcal/private/functional/stream.h"
#include "math/scalar.h"

#include <float.h>

/// Status, reason, weak and hint of the verdict.
void jcal_functional_judge(jcal_functional_t *self);

/// True if an error of the angle and a bound of the axes are small enough for angles; `slack` more than 1 once ready.
bool jcal_functional_is_for_flexion(float flexion_rad, float bound_rad, const jcal_functional_config_t *cfg,
                                    float slack);

/// Logarithm of the odds that the pairing of signs needs.
#define JCAL_FUNCTIONAL_EVIDENCE_MIN 7.0f

/// Evidence of all kinds of residuals together.
static inline float jcal_functional_evidence(const jcal_functional_verdict_t *verdict)
{
    return verdict->evidence[0] + verdict->evidence[1] + verdict->evidence[2];
}

/// Mean square that is left of the centre's motion, (m/s)^2.
static inline float jcal_functional_left(const jcal_functional_t *self)
{
    return self->point.lack / jcal_max(self->sums.motion_s, FLT_MIN);
}

#endif /* JCAL_FUNCTIONAL_JUDGE_H */

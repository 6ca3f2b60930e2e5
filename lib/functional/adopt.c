/* SPDX-License-Identifier: MIT */
/// @file
/// A calibration that is known from elsewhere is handed over. See functional.h.
#include "functional/judge.h"
#include "functional/track.h"
#include "joint/hysteresis.h"
#include "joint/sign.h"
#include "jointcal/functional.h"
#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <stddef.h>

bool jcal_functional_sleeps(const jcal_functional_t *self)
{
    return (self != NULL) && self->asleep;
}

jcal_status_t jcal_functional_usual(const jcal_functional_t *self, float usual[3])
{
    if ((self == NULL) || (usual == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (unsigned f = 0u; f < JCAL_FAMILIES; ++f) {
        usual[f] = self->point.size[f];
    }
    return JCAL_OK;
}

/// What the sums would have led to.
static void take_known(jcal_functional_t *self, const jcal_functional_known_t *known)
{
    jcal_functional_point_t *const point = &self->point;
    point->j1 = known->axis1;
    point->j2 = known->axis2;
    point->r1 = known->joint_to_sensor1_m;
    point->r2 = known->joint_to_sensor2_m;
    for (unsigned f = 0u; f < JCAL_FAMILIES; ++f) {
        point->size[f] = known->usual[f];
        point->weight[f] = 1.0f / known->usual[f];
    }
    self->sums.motion_s = 1.0f; /* what weights are a share of */
    self->search.has_estimate = true;
    self->verdict.bound1_rad = known->uncertainty1_rad;
    self->verdict.bound2_rad = known->uncertainty2_rad;
    self->verdict.flexion_rad = known->flexion_uncertainty_rad;
    self->verdict.is_one_axis = true;
    self->verdict.status = (uint8_t)JCAL_READY;
    self->verdict.reason = (uint8_t)JCAL_REASON_NONE;
    self->verdict.hint = (uint8_t)JCAL_HINT_NONE;
    self->verdict.weak = (uint8_t)JCAL_WEAK_NONE;
    jcal_functional_track_begin(self);
    jcal_sign_keep(&self->kept_sign[0], point->j1, self->cfg.axis1_toward);
    jcal_sign_keep(&self->kept_sign[1], point->j2, jcal_vec3(0.0f, 0.0f, 0.0f));
}

jcal_status_t jcal_functional_adopt(jcal_functional_t *self, const jcal_functional_known_t *known)
{
    if ((self == NULL) || (known == NULL) ||
        !(jcal_min(jcal_min(known->usual[0], known->usual[1]), known->usual[2]) > 0.0f)) {
        return JCAL_ERR_ARG;
    }
    const float bound = jcal_max(known->uncertainty1_rad, known->uncertainty2_rad);
    /* It was ready before, and stays so a little beyond the limits, as in judge.c. */
    const bool for_axes = bound <= self->cfg.max_bound_rad;
    if (!for_axes &&
        !jcal_functional_is_for_flexion(known->flexion_uncertainty_rad, bound, &self->cfg, JCAL_HYSTERESIS)) {
        return JCAL_REJECTED;
    }
    const jcal_tick_pair_t ticks = self->ticks;
    (void)jcal_functional_reset(self);
    self->ticks = ticks;
    take_known(self, known);
    self->verdict.for_axes = for_axes;
    self->verdict.for_flexion =
        jcal_functional_is_for_flexion(known->flexion_uncertainty_rad, bound, &self->cfg, JCAL_HYSTERESIS);
    self->asleep = true;
    self->adopted = true;
    return JCAL_OK;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Readings into blocks of a tenth of a second: the turn over each, and the mean specific force, as it stands and turned back. Private.
///
/// A reading is the mean over the time before it. With p the rotation vector since the block began and h that to the reading's middle:
///
///     h = p + w dt / 2 + p x w dt / 4,   sum of a + h x a + h x (h x a) / 2,   p <- p + w dt + p x w dt / 2
///
/// to second order. Without the turn within a block the scale came out 2 % too large at 0.1 s, 0.8 % at 0.05 s.
#ifndef JCAL_HEALTH_BLOCK_H
#define JCAL_HEALTH_BLOCK_H

#include "jointcal/private/health/state.h"
#include "jointcal/vec3.h"

/// Length of a block, s; the last reading may take it somewhat further.
#define JCAL_HEALTH_BLOCK_S 0.099f

/// Takes in a reading that came dt_s after the last one, its rates times `scale`; true if the block is full.
static inline bool jcal_health_block_add(jcal_health_block_t *self, const jcal_imu_t *imu, float dt_s, float scale)
{
    const jcal_vec3_t turn = jcal_vec3_scale(imu->gyr_rad_s, scale * dt_s);
    const jcal_vec3_t half_cone = jcal_vec3_scale(jcal_vec3_cross(self->angle, turn), 0.25f);
    const jcal_vec3_t middle = jcal_vec3_add(jcal_vec3_add(self->angle, jcal_vec3_scale(turn, 0.5f)), half_cone);
    const jcal_vec3_t first = jcal_vec3_cross(middle, imu->acc_m_s2);
    const jcal_vec3_t second = jcal_vec3_cross(middle, first);
    self->turn = jcal_vec3_add(self->turn, turn);
    self->acc_sum = jcal_vec3_add(self->acc_sum, imu->acc_m_s2);
    self->back_sum = jcal_vec3_add(self->back_sum,
                                   jcal_vec3_add(jcal_vec3_add(imu->acc_m_s2, first), jcal_vec3_scale(second, 0.5f)));
    self->angle = jcal_vec3_add(jcal_vec3_add(self->angle, turn), jcal_vec3_scale(half_cone, 2.0f));
    self->count += 1.0f;
    self->length_s += dt_s;
    return self->length_s >= JCAL_HEALTH_BLOCK_S;
}

#endif /* JCAL_HEALTH_BLOCK_H */

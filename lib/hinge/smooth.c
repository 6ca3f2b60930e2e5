/* SPDX-License-Identifier: MIT */
/// @file
/// A low-pass of the rates. See hinge/smooth.h.
#include "hinge/smooth.h"

#include "jointcal/vec3.h"

/// Time constant of each of the two low-passes, s.
#define TIME_S 0.0205f

void jcal_hinge_smooth_begin(jcal_hinge_smooth_t *self, const jcal_pair_t *pair)
{
    self->half[0] = pair->imu1.gyr_rad_s;
    self->half[1] = pair->imu2.gyr_rad_s;
    self->whole[0] = self->half[0];
    self->whole[1] = self->half[1];
}

/// from + share (to - from).
static jcal_vec3_t between(jcal_vec3_t from, jcal_vec3_t to, float share)
{
    return jcal_vec3_add(from, jcal_vec3_scale(jcal_vec3_sub(to, from), share));
}

jcal_pair_t jcal_hinge_smooth(jcal_hinge_smooth_t *self, const jcal_pair_t *pair, float dt_s)
{
    const float x = dt_s / TIME_S;
    const float share = 1.0f - (1.0f / (1.0f + (x * (1.0f + (0.5f * x))))); /* 1 - exp(-x) to 0.06 */
    jcal_pair_t out = *pair;
    self->half[0] = between(self->half[0], pair->imu1.gyr_rad_s, share);
    self->half[1] = between(self->half[1], pair->imu2.gyr_rad_s, share);
    self->whole[0] = between(self->whole[0], self->half[0], share);
    self->whole[1] = between(self->whole[1], self->half[1], share);
    out.imu1.gyr_rad_s = self->whole[0];
    out.imu2.gyr_rad_s = self->whole[1];
    return out;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the ball joint. See ball/sums.h.
#include "ball/sums.h"

#include "jointcal/vec3.h"
#include "levers/levers.h"
#include "math/eig3.h"
#include "math/scalar.h"

#include <float.h>
#include <stddef.h>

/// Length of a block, s; and the motion that one needs before it may be closed, s: with less its heading means nothing.
#define BLOCK_S 5.0f
#define BLOCK_MOTION_S 0.4f

void jcal_ball_sums_add(jcal_ball_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                        const jcal_tick_weights_t *weights)
{
    self->motion_s += weights->motion_s;
    self->block_motion_s[0] += weights->motion_s;
    self->block_time_s += tick1->dt_s;
    jcal_levers_add(&self->levers, tick1, tick2, weights->motion_s);
    const jcal_vec3_t a = jcal_vec3_scale(tick1->gyr, weights->spin);
    const jcal_vec3_t b = tick2->gyr;
    const float products[9] = {a.x * b.x, a.x * b.y, a.x * b.z, a.y * b.x, a.y * b.y,
                               a.y * b.z, a.z * b.x, a.z * b.y, a.z * b.z};
    for (size_t i = 0u; i < 9u; ++i) {
        self->along[i] += products[i];
    }
    self->energy1 += jcal_vec3_dot(a, tick1->gyr);
    self->energy2 += weights->spin * jcal_vec3_dot(b, b);
}

bool jcal_ball_sums_full(const jcal_ball_sums_t *self)
{
    return (self->block_time_s >= BLOCK_S) && (self->block_motion_s[0] >= BLOCK_MOTION_S);
}

void jcal_ball_sums_close(jcal_ball_sums_t *self, jcal_plane_t heading)
{
    jcal_levers_close(&self->levers, heading);
    self->block_motion_s[1] = self->block_motion_s[0];
    self->block_motion_s[0] = 0.0f;
    self->block_time_s = 0.0f;
}

void jcal_ball_sums_fade(jcal_ball_sums_t *self, float share)
{
    float *const all = (float *)self; /* nothing but floats */
    const float time_s = self->block_time_s;
    for (size_t i = 0u; i < (sizeof *self / sizeof *all); ++i) {
        all[i] *= share;
    }
    self->block_time_s = time_s;
}

float jcal_ball_sums_stiffness(const jcal_ball_sums_t *self)
{
    const float left = self->energy1 + self->energy2 - (2.0f * jcal_eig3_alignment(self->along));
    return left / jcal_max(jcal_min(self->energy1, self->energy2), FLT_MIN);
}

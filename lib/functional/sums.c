/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the functional joint. See functional/sums.h.
#include "functional/sums.h"

#include "functional/model.h"
#include "imu/turn.h"
#include "jointcal/vec3.h"
#include "levers/levers.h"
#include "levers/products.h"
#include "math/clear.h"

#include <stddef.h>

/// Length of a block, s; and the motion that one needs before it may be closed, s: with less its heading means nothing.
#define BLOCK_S 5.0f
#define BLOCK_MOTION_S 0.4f

/// sum (3 x 3) <- sum + a b'.
static void add_outer(float *sum, jcal_vec3_t a, jcal_vec3_t b)
{
    sum[0] += a.x * b.x;
    sum[1] += a.x * b.y;
    sum[2] += a.x * b.z;
    sum[3] += a.y * b.x;
    sum[4] += a.y * b.y;
    sum[5] += a.y * b.z;
    sum[6] += a.z * b.x;
    sum[7] += a.z * b.y;
    sum[8] += a.z * b.z;
}

/// sum (6, packed) <- sum + weight M' M, M (3 x 3).
static void add_square(float *sum, float weight, const float *m)
{
    const jcal_vec3_t a = jcal_column(m, 0u);
    const jcal_vec3_t b = jcal_column(m, 1u);
    const jcal_vec3_t c = jcal_column(m, 2u);
    sum[0] += weight * jcal_vec3_dot(a, a);
    sum[1] += weight * jcal_vec3_dot(b, a);
    sum[2] += weight * jcal_vec3_dot(b, b);
    sum[3] += weight * jcal_vec3_dot(c, a);
    sum[4] += weight * jcal_vec3_dot(c, b);
    sum[5] += weight * jcal_vec3_dot(c, c);
}

static void add_turns(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    const jcal_products_t to = {self->turn_up, self->block[0].turn_re, self->block[0].turn_im};
    const jcal_vec3_t b0 = jcal_column(tick2->turn, 0u);
    const jcal_vec3_t b1 = jcal_column(tick2->turn, 1u);
    const jcal_vec3_t b2 = jcal_column(tick2->turn, 2u);
    for (size_t i = 0u; i < 3u; ++i) {
        const jcal_vec3_t a = jcal_vec3_scale(jcal_column(tick1->turn, i), weight);
        jcal_products_add(&to, 3u * i, a, b0);
        jcal_products_add(&to, (3u * i) + 1u, a, b1);
        jcal_products_add(&to, (3u * i) + 2u, a, b2);
    }
}

/// sum (9 x 9) <- sum + weight a b', a and b (9).
static void add_outer9(float *sum, float weight, const float *a, const float *b)
{
    const jcal_vec3_t b0 = {b[0], b[1], b[2]};
    const jcal_vec3_t b1 = {b[3], b[4], b[5]};
    const jcal_vec3_t b2 = {b[6], b[7], b[8]};
    for (size_t i = 0u; i < 9u; ++i) {
        const float s = weight * a[i];
        float *const row = &sum[9u * i];
        row[0] += s * b0.x;
        row[1] += s * b0.y;
        row[2] += s * b0.z;
        row[3] += s * b1.x;
        row[4] += s * b1.y;
        row[5] += s * b1.z;
        row[6] += s * b2.x;
        row[7] += s * b2.y;
        row[8] += s * b2.z;
    }
}

static void add_rates(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    add_square(self->rate1, weight, tick1->rate);
    add_square(self->rate2nd, weight, tick2->rate);
    add_outer(self->along, jcal_vec3_scale(tick1->gyr, weight), tick2->gyr);
    const jcal_vec3_t up1 = {weight * tick1->rate[6], weight * tick1->rate[7], weight * tick1->rate[8]};
    const jcal_vec3_t up2 = {tick2->rate[6], tick2->rate[7], tick2->rate[8]};
    add_outer(self->rate_up, up1, up2);
    add_outer9(self->block[0].rate, weight, tick1->rate, tick2->rate);
}

void jcal_functional_sums_add(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                              const jcal_tick_weights_t *weights)
{
    self->motion_s += weights->motion_s;
    self->rate2 += weights->spin * weights->rate2;
    self->block[0].motion_s += weights->motion_s;
    self->block[0].time_s += tick1->dt_s;
    add_turns(self, tick1, tick2, weights->motion_s);
    add_rates(self, tick1, tick2, weights->spin);
    jcal_levers_add(&self->levers, tick1, tick2, weights->motion_s);
}

bool jcal_functional_sums_full(const jcal_functional_sums_t *self)
{
    return (self->block[0].time_s >= BLOCK_S) && (self->block[0].motion_s >= BLOCK_MOTION_S);
}

bool jcal_functional_sums_has_heading(const jcal_functional_sums_t *self)
{
    return self->block[0].motion_s >= BLOCK_MOTION_S;
}

void jcal_functional_sums_close(jcal_functional_sums_t *self, jcal_functional_point_t *point)
{
    jcal_functional_block_t *const old = &self->block[1];
    if (old->motion_s > 0.0f) {
        const jcal_plane_t heading = point->heading[1];
        jcal_products_turned(self->old_turn, old->turn_re, old->turn_im, heading, 9u);
        jcal_functional_level_rates(self->old_rate, old->rate, heading);
        jcal_functional_free_rates(self->rate_free, old->rate, point->turn[1]);
    }
    jcal_levers_close(&self->levers, point->heading[1]); /* of a block without motion nothing is merged */
    jcal_copy(old, &self->block[0], sizeof *old);
    jcal_clear(&self->block[0], sizeof self->block[0]);
    point->heading[1] = point->heading[0];
    for (size_t i = 0u; i < 9u; ++i) {
        point->turn[1][i] = point->turn[0][i];
    }
}

void jcal_functional_sums_fade(jcal_functional_sums_t *self, float share)
{
    float *const all = (float *)self; /* nothing but floats */
    const float time_s = self->block[0].time_s;
    for (size_t i = 0u; i < (sizeof *self / sizeof *all); ++i) {
        all[i] *= share;
    }
    self->block[0].time_s = time_s;
}

void jcal_functional_sums_reverse(jcal_functional_sums_t *self)
{
    for (size_t i = 0u; i < 9u; ++i) {
        self->old_turn[i] = -self->old_turn[i];
        self->old_rate[i] = -self->old_rate[i];
    }
    jcal_functional_old_rate_up(self, self->rate_free); /* without relative turns: they belonged to the other pairing */
    for (size_t i = 0u; i < 9u; ++i) {
        self->rate_free[i] += self->old_rate[i];
    }
    for (size_t i = 0u; i < 16u; ++i) {
        self->levers.old[i] = -self->levers.old[i];
    }
}

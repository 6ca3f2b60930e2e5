/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the functional joint. See functional/sums.h.
#include "functional/sums.h"

#include "functional/model.h"
#include "jointcal/vec3.h"
#include "math/clear.h"

#include <stddef.h>

/// Length of a block, s; and the motion that one needs before it may be closed, s: with less its heading means nothing.
#define BLOCK_S 5.0f
#define BLOCK_MOTION_S 0.4f

/// Column k of a matrix (3 x 3).
static inline jcal_vec3_t column(const float *m, size_t k)
{
    const jcal_vec3_t out = {m[k], m[k + 3u], m[k + 6u]};
    return out;
}

/// One product of columns: its vertical part, and the complex one of its horizontal parts, (x1 - i y1)(x2 + i y2).
typedef struct {
    float *up, *re, *im;
} products_t;

static inline void add_product(const products_t *to, size_t at, jcal_vec3_t a, jcal_vec3_t b)
{
    to->up[at] += a.z * b.z;
    to->re[at] += (a.x * b.x) + (a.y * b.y);
    to->im[at] += (a.x * b.y) - (a.y * b.x);
}

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
    const jcal_vec3_t a = column(m, 0u);
    const jcal_vec3_t b = column(m, 1u);
    const jcal_vec3_t c = column(m, 2u);
    sum[0] += weight * jcal_vec3_dot(a, a);
    sum[1] += weight * jcal_vec3_dot(b, a);
    sum[2] += weight * jcal_vec3_dot(b, b);
    sum[3] += weight * jcal_vec3_dot(c, a);
    sum[4] += weight * jcal_vec3_dot(c, b);
    sum[5] += weight * jcal_vec3_dot(c, c);
}

/// sum (10, packed) <- sum + weight [U B]' [U B].
static void add_lever(float *sum, float weight, const jcal_tick_t *tick)
{
    const jcal_vec3_t u = tick->velocity;
    const jcal_vec3_t a = column(tick->lever, 0u);
    const jcal_vec3_t b = column(tick->lever, 1u);
    const jcal_vec3_t c = column(tick->lever, 2u);
    sum[0] += weight * jcal_vec3_dot(u, u);
    sum[1] += weight * jcal_vec3_dot(a, u);
    sum[2] += weight * jcal_vec3_dot(a, a);
    sum[3] += weight * jcal_vec3_dot(b, u);
    sum[4] += weight * jcal_vec3_dot(b, a);
    sum[5] += weight * jcal_vec3_dot(b, b);
    sum[6] += weight * jcal_vec3_dot(c, u);
    sum[7] += weight * jcal_vec3_dot(c, a);
    sum[8] += weight * jcal_vec3_dot(c, b);
    sum[9] += weight * jcal_vec3_dot(c, c);
}

static void add_levers(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    add_lever(self->lever1, weight, tick1);
    add_lever(self->lever2, weight, tick2);
    const products_t to = {self->lever_up, self->block[0].lever_re, self->block[0].lever_im};
    const jcal_vec3_t b0 = tick2->velocity;
    const jcal_vec3_t b1 = column(tick2->lever, 0u);
    const jcal_vec3_t b2 = column(tick2->lever, 1u);
    const jcal_vec3_t b3 = column(tick2->lever, 2u);
    for (size_t i = 0u; i < 4u; ++i) {
        const jcal_vec3_t a = jcal_vec3_scale((i == 0u) ? tick1->velocity : column(tick1->lever, i - 1u), weight);
        add_product(&to, 4u * i, a, b0);
        add_product(&to, (4u * i) + 1u, a, b1);
        add_product(&to, (4u * i) + 2u, a, b2);
        add_product(&to, (4u * i) + 3u, a, b3);
    }
}

static void add_turns(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    const products_t to = {self->turn_up, self->block[0].turn_re, self->block[0].turn_im};
    const jcal_vec3_t b0 = column(tick2->turn, 0u);
    const jcal_vec3_t b1 = column(tick2->turn, 1u);
    const jcal_vec3_t b2 = column(tick2->turn, 2u);
    for (size_t i = 0u; i < 3u; ++i) {
        const jcal_vec3_t a = jcal_vec3_scale(column(tick1->turn, i), weight);
        add_product(&to, 3u * i, a, b0);
        add_product(&to, (3u * i) + 1u, a, b1);
        add_product(&to, (3u * i) + 2u, a, b2);
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
                              const jcal_functional_weights_t *weights)
{
    self->motion_s += weights->motion_s;
    self->rate2 += weights->spin * weights->rate2;
    self->block[0].motion_s += weights->motion_s;
    self->block[0].time_s += tick1->dt_s;
    add_turns(self, tick1, tick2, weights->motion_s);
    add_rates(self, tick1, tick2, weights->spin);
    add_levers(self, tick1, tick2, weights->motion_s);
}

bool jcal_functional_sums_full(const jcal_functional_sums_t *self)
{
    return (self->block[0].time_s >= BLOCK_S) && (self->block[0].motion_s >= BLOCK_MOTION_S);
}

void jcal_functional_sums_close(jcal_functional_sums_t *self, jcal_functional_point_t *point)
{
    jcal_functional_block_t *const old = &self->block[1];
    if (old->motion_s > 0.0f) {
        const jcal_plane_t heading = point->heading[1];
        jcal_functional_turned(self->old_turn, old->turn_re, old->turn_im, heading, 9u);
        jcal_functional_turned(self->old_lever, old->lever_re, old->lever_im, heading, 16u);
        jcal_functional_level_rates(self->old_rate, old->rate, heading);
        jcal_functional_free_rates(self->rate_free, old->rate, point->turn[1]);
    }
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
        self->old_lever[i] = -self->old_lever[i];
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the functional joint. See functional/sums.h.
#include "functional/sums.h"

#include "functional/model.h"
#include "math/clear.h"
#include "math/sym.h"

#include <stddef.h>

/// Length of a block, s; and the motion that one needs before it may be closed, s: with less its heading means nothing.
#define BLOCK_S 5.0f
#define BLOCK_MOTION_S 0.4f

/// sum (n) <- sum + weight v, v (n).
static void add_scaled(float *sum, float weight, const float *v, size_t n)
{
    for (size_t i = 0u; i < n; ++i) {
        sum[i] += weight * v[i];
    }
}

/// sum (3 x 3) <- sum + weight a b', a and b (3).
static void add_outer3(float *sum, float weight, const float *a, const float *b)
{
    for (size_t i = 0u; i < 3u; ++i) {
        const float s = weight * a[i];
        sum[3u * i] += s * b[0];
        sum[(3u * i) + 1u] += s * b[1];
        sum[(3u * i) + 2u] += s * b[2];
    }
}

/// re, im (n x n) <- themselves + weight (x1 - i y1)(x2 + i y2)', all four (n).
static void add_horizontal(float *re, float *im, float weight, const float *const rows[4], size_t n)
{
    for (size_t i = 0u; i < n; ++i) {
        const float x1 = weight * rows[0][i];
        const float y1 = weight * rows[1][i];
        for (size_t k = 0u; k < n; ++k) {
            re[(n * i) + k] += (x1 * rows[2][k]) + (y1 * rows[3][k]);
            im[(n * i) + k] += (x1 * rows[3][k]) - (y1 * rows[2][k]);
        }
    }
}

/// Rows of [U B]: f (3 x 4).
static void lever_rows(const jcal_tick_t *tick, float f[12])
{
    const float velocity[3] = {tick->velocity.x, tick->velocity.y, tick->velocity.z};
    for (size_t a = 0u; a < 3u; ++a) {
        f[4u * a] = velocity[a];
        f[(4u * a) + 1u] = tick->lever[3u * a];
        f[(4u * a) + 2u] = tick->lever[(3u * a) + 1u];
        f[(4u * a) + 3u] = tick->lever[(3u * a) + 2u];
    }
}

static void add_levers(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    float f1[12];
    float f2[12];
    lever_rows(tick1, f1);
    lever_rows(tick2, f2);
    for (size_t a = 0u; a < 3u; ++a) {
        jcal_sym_rank1(self->lever1, 4u, &f1[4u * a], weight);
        jcal_sym_rank1(self->lever2, 4u, &f2[4u * a], weight);
    }
    for (size_t i = 0u; i < 4u; ++i) {
        add_scaled(&self->lever_up[4u * i], weight * f1[8u + i], &f2[8], 4u);
    }
    const float *const rows[4] = {f1, &f1[4], f2, &f2[4]};
    add_horizontal(self->block[0].lever_re, self->block[0].lever_im, weight, rows, 4u);
}

static void add_turns(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    add_outer3(self->turn_up, weight, &tick1->turn[6], &tick2->turn[6]);
    const float *const rows[4] = {tick1->turn, &tick1->turn[3], tick2->turn, &tick2->turn[3]};
    add_horizontal(self->block[0].turn_re, self->block[0].turn_im, weight, rows, 3u);
}

static void add_rates(jcal_functional_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    for (size_t a = 0u; a < 3u; ++a) {
        jcal_sym_rank1(self->rate1, 3u, &tick1->rate[3u * a], weight);
        jcal_sym_rank1(self->rate2nd, 3u, &tick2->rate[3u * a], weight);
    }
    const float rate1[3] = {tick1->gyr.x, tick1->gyr.y, tick1->gyr.z};
    const float rate2[3] = {tick2->gyr.x, tick2->gyr.y, tick2->gyr.z};
    add_outer3(self->along, weight, rate1, rate2);
    add_outer3(self->rate_up, weight, &tick1->rate[6], &tick2->rate[6]);
    for (size_t i = 0u; i < 9u; ++i) {
        add_scaled(&self->block[0].rate[9u * i], weight * tick1->rate[i], tick2->rate, 9u);
    }
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
    *old = self->block[0];
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

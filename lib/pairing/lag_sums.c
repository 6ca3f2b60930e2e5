/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at a few lags. See pairing/lag_sums.h.
#include "pairing/lag_sums.h"

#include "imu/turn.h"
#include "jointcal/vec3.h"
#include "levers/products.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <stddef.h>

/// Sums are halved when they hold this much motion, s.
#define MOTION_MAX_S 30.0f
/// Nodes of the first half of a term.
#define FIRST_HALF ((JCAL_LAG_NODES + 1u) / 2u)
/// Nodes that a polynomial goes through, and those on each side of the middle one.
#define NEAR_NODES 7u
#define NEAR_SIDE 3

static jcal_lag_columns_t columns_of(const jcal_tick_t *tick)
{
    const jcal_lag_columns_t out = {
        {tick->velocity, jcal_column(tick->lever, 0u), jcal_column(tick->lever, 1u), jcal_column(tick->lever, 2u)}};
    return out;
}

/// past (count) <- past without its oldest, with the newest.
static void keep(jcal_lag_columns_t *past, size_t count, const jcal_tick_t *tick)
{
    for (size_t k = 1u; k < count; ++k) {
        past[k - 1u] = past[k];
    }
    past[count - 1u] = columns_of(tick);
}

/// sum (10, packed) <- sum + F' F.
static void add_own(float *sum, const jcal_lag_columns_t *f)
{
    size_t at = 0u;
    for (size_t i = 0u; i < 4u; ++i) {
        for (size_t k = 0u; k <= i; ++k) {
            sum[at] += jcal_vec3_dot(f->column[i], f->column[k]);
            ++at;
        }
    }
}

static void add_node(jcal_lag_node_t *node, const jcal_lag_columns_t *f1, const jcal_lag_columns_t *f2)
{
    const jcal_products_t to = {node->up, node->across.re, node->across.im};
    add_own(node->own2, f2);
    for (size_t i = 0u; i < 4u; ++i) {
        for (size_t k = 0u; k < 4u; ++k) {
            jcal_products_add(&to, (4u * i) + k, f1->column[i], f2->column[k]);
        }
    }
}

void jcal_lag_sums_keep(jcal_lag_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    keep(self->past1, JCAL_LAG_SIDE + 1u, tick1);
    keep(self->past2, JCAL_LAG_NODES, tick2);
    if (self->filled < JCAL_LAG_NODES) {
        self->filled = (uint8_t)(self->filled + 1u);
    }
}

void jcal_lag_sums_begin(jcal_lag_t *self)
{
    if (self->filled < JCAL_LAG_NODES) {
        return;
    }
    jcal_lag_sums_t *const sums = &self->sums;
    add_own(sums->own1, &self->past1[0]);
    for (size_t k = 0u; k < FIRST_HALF; ++k) {
        add_node(&sums->node[k], &self->past1[0], &self->past2[k]);
    }
    sums->count += 1.0f;
    self->half_done = true;
}

bool jcal_lag_sums_finish(jcal_lag_t *self)
{
    if (!self->half_done) {
        return false;
    }
    jcal_lag_sums_t *const sums = &self->sums;
    for (size_t k = FIRST_HALF; k < JCAL_LAG_NODES; ++k) {
        add_node(&sums->node[k], &self->past1[0], &self->past2[k]);
    }
    self->half_done = false;
    if (sums->motion_s > MOTION_MAX_S) {
        jcal_lag_sums_fade(sums, 0.5f);
    }
    return true;
}

void jcal_lag_sums_fade(jcal_lag_sums_t *self, float share)
{
    float *const all = (float *)self; /* nothing but floats */
    for (size_t i = 0u; i < (sizeof *self / sizeof *all); ++i) {
        all[i] *= share;
    }
}

/// The first of the seven nodes that are nearest to a lag.
static size_t first_near(float lag)
{
    const float within = jcal_max(jcal_min(lag, (float)JCAL_LAG_SIDE), -(float)JCAL_LAG_SIDE);
    const int nearest = (int)(within + (float)JCAL_LAG_SIDE + 0.5f);
    const int last_first = JCAL_LAG_NODES - (int)NEAR_NODES;
    const int first = nearest - NEAR_SIDE;
    return (size_t)((first < 0) ? 0 : ((first > last_first) ? last_first : first));
}

/// The weight of a node in the polynomial through seven nodes from `first` on, as Lagrange wrote it: prod (lag - other) / (own - other).
static float weight_of(size_t node, size_t first, float lag)
{
    float weight = 1.0f;
    for (size_t k = first; k < (first + NEAR_NODES); ++k) {
        if (k != node) {
            const float distance = (float)((int)node - (int)k);
            weight *= (lag - (float)((int)k - JCAL_LAG_SIDE)) / distance;
        }
    }
    return weight;
}

/// to (count) <- to + weight from.
static void add_scaled(float *to, const float *from, float weight, size_t count)
{
    for (size_t i = 0u; i < count; ++i) {
        to[i] += weight * from[i];
    }
}

void jcal_lag_sums_at(const jcal_lag_sums_t *self, float lag, jcal_lever_sums_t *out)
{
    jcal_clear(out, sizeof *out);
    jcal_copy(out->own1, self->own1, sizeof out->own1);
    const size_t first = first_near(lag);
    for (size_t k = first; k < (first + NEAR_NODES); ++k) {
        const float weight = weight_of(k, first, lag);
        const jcal_lag_node_t *const node = &self->node[k];
        if (weight == 0.0f) {
            continue; /* at another node */
        }
        add_scaled(out->own2, node->own2, weight, 10u);
        add_scaled(out->up, node->up, weight, 16u);
        add_scaled(out->block[0].re, node->across.re, weight, 16u);
        add_scaled(out->block[0].im, node->across.im, weight, 16u);
    }
}

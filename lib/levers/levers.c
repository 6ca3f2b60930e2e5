/* SPDX-License-Identifier: MIT */
/// @file
/// Where the joint's centre is, as both sensors see it. See levers/levers.h.
#include "levers/levers.h"

#include "imu/turn.h"
#include "jointcal/vec3.h"
#include "levers/products.h"
#include "math/chol_small.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>

/// sum (10, packed) <- sum + weight [U B]' [U B].
static void add_lever(float *sum, float weight, const jcal_tick_t *tick)
{
    const jcal_vec3_t u = tick->velocity;
    const jcal_vec3_t a = jcal_column(tick->lever, 0u);
    const jcal_vec3_t b = jcal_column(tick->lever, 1u);
    const jcal_vec3_t c = jcal_column(tick->lever, 2u);
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

void jcal_levers_add(jcal_lever_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight)
{
    add_lever(self->own1, weight, tick1);
    add_lever(self->own2, weight, tick2);
    const jcal_products_t to = {self->up, self->block[0].re, self->block[0].im};
    const jcal_vec3_t b0 = tick2->velocity;
    const jcal_vec3_t b1 = jcal_column(tick2->lever, 0u);
    const jcal_vec3_t b2 = jcal_column(tick2->lever, 1u);
    const jcal_vec3_t b3 = jcal_column(tick2->lever, 2u);
    for (size_t i = 0u; i < 4u; ++i) {
        const jcal_vec3_t a = jcal_vec3_scale((i == 0u) ? tick1->velocity : jcal_column(tick1->lever, i - 1u), weight);
        jcal_products_add(&to, 4u * i, a, b0);
        jcal_products_add(&to, (4u * i) + 1u, a, b1);
        jcal_products_add(&to, (4u * i) + 2u, a, b2);
        jcal_products_add(&to, (4u * i) + 3u, a, b3);
    }
}

void jcal_levers_close(jcal_lever_sums_t *self, jcal_plane_t heading)
{
    jcal_products_turned(self->old, self->block[1].re, self->block[1].im, heading, 16u);
    jcal_copy(&self->block[1], &self->block[0], sizeof self->block[1]);
    jcal_clear(&self->block[0], sizeof self->block[0]);
}

void jcal_levers_cross(const jcal_lever_sums_t *self, const jcal_plane_t *heading, float *x)
{
    for (size_t i = 0u; i < 16u; ++i) {
        x[i] = self->up[i] + self->old[i];
    }
    for (size_t b = 0u; b < JCAL_LEVER_BLOCKS; ++b) {
        jcal_products_turned(x, self->block[b].re, self->block[b].im, heading[b], 16u);
    }
}

void jcal_levers_normal(const jcal_lever_sums_t *self, const float *x, float *h, float *g)
{
    const float *const s1 = self->own1;
    const float *const s2 = self->own2;
    g[0] = s1[1] - x[4];
    g[1] = s1[3] - x[8];
    g[2] = s1[6] - x[12];
    g[3] = s2[1] - x[1];
    g[4] = s2[3] - x[2];
    g[5] = s2[6] - x[3];
    h[0] = s1[2]; /* S1 but for its first row */
    h[1] = s1[4];
    h[2] = s1[5];
    h[3] = s1[7];
    h[4] = s1[8];
    h[5] = s1[9];
    h[6] = -x[5]; /* a column of X, a row of S2 */
    h[7] = -x[9];
    h[8] = -x[13];
    h[9] = s2[2];
    h[10] = -x[6];
    h[11] = -x[10];
    h[12] = -x[14];
    h[13] = s2[4];
    h[14] = s2[5];
    h[15] = -x[7];
    h[16] = -x[11];
    h[17] = -x[15];
    h[18] = s2[7];
    h[19] = s2[8];
    h[20] = s2[9];
}

/// x' S x of [1; -r], S (4 x 4, packed).
static float left_of(const float *s, const float *r)
{
    const jcal_vec3_t v = {-r[0], -r[1], -r[2]};
    const float below = (s[1] * v.x) + ((s[3] + (s[4] * v.x)) * v.y) + ((s[6] + (s[7] * v.x) + (s[8] * v.y)) * v.z);
    const float diagonal = s[0] + (s[2] * v.x * v.x) + (s[5] * v.y * v.y) + (s[9] * v.z * v.z);
    return diagonal + (2.0f * below);
}

/// row [1; v].
static inline float row_times(const float *row, jcal_vec3_t v)
{
    return row[0] + (row[1] * v.x) + (row[2] * v.y) + (row[3] * v.z);
}

/// [1; -r1]' X [1; -r2].
static float product_of(const float *x, const float *r1, const float *r2)
{
    const jcal_vec3_t v = {-r2[0], -r2[1], -r2[2]};
    return row_times(x, v) - (r1[0] * row_times(&x[4], v)) - (r1[1] * row_times(&x[8], v)) -
           (r1[2] * row_times(&x[12], v));
}

jcal_levers_t jcal_levers_solve(const jcal_lever_sums_t *self, const float *x, float ridge)
{
    float h[JCAL_SYM_SIZE(JCAL_LEVER_UNKNOWNS)];
    float r[JCAL_LEVER_UNKNOWNS];
    jcal_levers_normal(self, x, h, r);
    const float trace = h[0] + h[2] + h[5] + h[9] + h[14] + h[20];
    const float added = (ridge / (float)JCAL_LEVER_UNKNOWNS * trace) + FLT_MIN;
    for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
        h[jcal_sym_at(i, i)] += added;
    }
    if (jcal_chol6_factor(h)) {
        jcal_chol6_solve(h, r);
    } else {
        for (size_t i = 0u; i < JCAL_LEVER_UNKNOWNS; ++i) {
            r[i] = 0.0f;
        }
    }
    const float own = left_of(self->own1, r) + left_of(self->own2, &r[3]);
    const jcal_levers_t out = {
        {r[0], r[1], r[2]}, {r[3], r[4], r[5]}, jcal_max(own - (2.0f * product_of(x, r, &r[3])), 0.0f), own};
    return out;
}

/// [1; -r1]' M [1; -r2], M (4 x 4).
static float between4(const float *m, jcal_vec3_t r1, jcal_vec3_t r2)
{
    float row[4];
    for (size_t i = 0u; i < 4u; ++i) {
        const float *const at = &m[4u * i];
        row[i] = at[0] - ((at[1] * r2.x) + (at[2] * r2.y) + (at[3] * r2.z));
    }
    return row[0] - ((row[1] * r1.x) + (row[2] * r1.y) + (row[3] * r1.z));
}

jcal_plane_t jcal_levers_pull(const jcal_lever_sums_t *self, size_t b, jcal_vec3_t r1, jcal_vec3_t r2)
{
    const jcal_plane_t out = {between4(self->block[b].re, r1, r2), between4(self->block[b].im, r1, r2)};
    return out;
}

jcal_vec3_t jcal_levers_velocity(const jcal_tick_t *tick, jcal_vec3_t r)
{
    return jcal_vec3_sub(tick->velocity, jcal_turn_times(tick->lever, r));
}

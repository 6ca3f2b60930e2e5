/* SPDX-License-Identifier: MIT */
/// @file
/// The sums seen from a solution. See functional/model.h.
#include "functional/model.h"

#include "levers/products.h"
#include "math/scalar.h"
#include "math/sym.h"

/// Less motion than this, s, is none.
#define MOTION_MIN_S 1e-6f

/// Row of spin1's element (a, i) and column of spin2's element (b, k) in the products of rates.
static size_t rate_at(size_t a, size_t i, size_t b, size_t k)
{
    return (9u * ((3u * a) + i)) + (3u * b) + k;
}

void jcal_functional_level_rates(float *out, const float *rate, jcal_plane_t heading)
{
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t k = 0u; k < 3u; ++k) {
            const float re = rate[rate_at(0u, i, 0u, k)] + rate[rate_at(1u, i, 1u, k)];
            const float im = rate[rate_at(0u, i, 1u, k)] - rate[rate_at(1u, i, 0u, k)];
            out[(3u * i) + k] += (heading.re * re) - (heading.im * im);
        }
    }
}

/// sum + sum over b of d[b] row[b][.], row (3 x 3).
static inline jcal_vec3_t free_row(jcal_vec3_t sum, const float *row, jcal_vec3_t d)
{
    const jcal_vec3_t out = {sum.x + ((d.x * row[0]) + (d.y * row[3]) + (d.z * row[6])),
                             sum.y + ((d.x * row[1]) + (d.y * row[4]) + (d.z * row[7])),
                             sum.z + ((d.x * row[2]) + (d.y * row[5]) + (d.z * row[8]))};
    return out;
}

void jcal_functional_free_rates(float *out, const float *rate, const float *turn)
{
    const jcal_vec3_t x = {turn[0], turn[1], turn[2]};
    const jcal_vec3_t y = {turn[3], turn[4], turn[5]};
    const jcal_vec3_t z = {turn[6], turn[7], turn[8]};
    for (size_t i = 0u; i < 3u; ++i) {
        float *const to = &out[3u * i];
        const jcal_vec3_t was = {to[0], to[1], to[2]};
        const jcal_vec3_t so_far = free_row(free_row(was, &rate[9u * i], x), &rate[27u + (9u * i)], y);
        const jcal_vec3_t all = free_row(so_far, &rate[54u + (9u * i)], z);
        to[0] = all.x;
        to[1] = all.y;
        to[2] = all.z;
    }
}

void jcal_functional_old_rate_up(const jcal_functional_sums_t *sums, float *out)
{
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t k = 0u; k < 3u; ++k) {
            const size_t at = rate_at(2u, i, 2u, k);
            out[(3u * i) + k] = sums->rate_up[(3u * i) + k] - sums->block[0].rate[at] - sums->block[1].rate[at];
        }
    }
}

/// x (n) <- a + b.
static void sum_of(float *x, const float *a, const float *b, size_t n)
{
    for (size_t i = 0u; i < n; ++i) {
        x[i] = a[i] + b[i];
    }
}

void jcal_functional_cross_turn(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, float *x)
{
    sum_of(x, sums->turn_up, sums->old_turn, 9u);
    for (size_t b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
        jcal_products_turned(x, sums->block[b].turn_re, sums->block[b].turn_im, point->heading[b], 9u);
    }
}

void jcal_functional_cross_rate(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, float *x)
{
    for (size_t i = 0u; i < 9u; ++i) {
        x[i] = sums->rate_free[i];
    }
    for (size_t b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
        jcal_functional_free_rates(x, sums->block[b].rate, point->turn[b]);
    }
}

void jcal_functional_cross_level(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, float *x)
{
    sum_of(x, sums->rate_up, sums->old_rate, 9u);
    for (size_t b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
        jcal_functional_level_rates(x, sums->block[b].rate, point->heading[b]);
    }
}

void jcal_functional_about_z(jcal_plane_t heading, float *out)
{
    const float turn[9] = {heading.re, -heading.im, 0.0f, heading.im, heading.re, 0.0f, 0.0f, 0.0f, 1.0f};
    for (size_t i = 0u; i < 9u; ++i) {
        out[i] = turn[i];
    }
}

float jcal_functional_between(const float *m, jcal_vec3_t a, jcal_vec3_t b)
{
    return (a.x * ((m[0] * b.x) + (m[1] * b.y) + (m[2] * b.z))) + (a.y * ((m[3] * b.x) + (m[4] * b.y) + (m[5] * b.z))) +
           (a.z * ((m[6] * b.x) + (m[7] * b.y) + (m[8] * b.z)));
}

jcal_vec3_t jcal_functional_times_left(const float *m, jcal_vec3_t a)
{
    const jcal_vec3_t out = {(m[0] * a.x) + (m[3] * a.y) + (m[6] * a.z), (m[1] * a.x) + (m[4] * a.y) + (m[7] * a.z),
                             (m[2] * a.x) + (m[5] * a.y) + (m[8] * a.z)};
    return out;
}

jcal_vec3_t jcal_functional_times_packed(const float *s, jcal_vec3_t v)
{
    const jcal_vec3_t out = {(s[0] * v.x) + (s[1] * v.y) + (s[3] * v.z), (s[1] * v.x) + (s[2] * v.y) + (s[4] * v.z),
                             (s[3] * v.x) + (s[4] * v.y) + (s[5] * v.z)};
    return out;
}

void jcal_functional_times_transposed(const float *a, const float *b, float *out)
{
    const jcal_vec3_t x = {b[0], b[1], b[2]};
    const jcal_vec3_t y = {b[3], b[4], b[5]};
    const jcal_vec3_t z = {b[6], b[7], b[8]};
    for (size_t i = 0u; i < 3u; ++i) {
        const jcal_vec3_t d = {a[i], a[3u + i], a[6u + i]};
        out[3u * i] = (d.x * x.x) + (d.y * y.x) + (d.z * z.x);
        out[(3u * i) + 1u] = (d.x * x.y) + (d.y * y.y) + (d.z * z.y);
        out[(3u * i) + 2u] = (d.x * x.z) + (d.y * y.z) + (d.z * z.z);
    }
}

void jcal_functional_left_rates(const float *rate, jcal_vec3_t j1, float scale, float *out)
{
    const jcal_vec3_t s = {scale * j1.x, scale * j1.y, scale * j1.z};
    for (size_t a = 0u; a < 3u; ++a) {
        const float *const r = &rate[27u * a];
        float *const to = &out[9u * a];
        for (size_t k = 0u; k < 9u; ++k) {
            to[k] = (s.x * r[k]) + (s.y * r[k + 9u]) + (s.z * r[k + 18u]);
        }
    }
}

void jcal_functional_right_rates(const float *left, jcal_vec3_t j2, float *out)
{
    for (size_t i = 0u; i < 9u; ++i) {
        const float *const at = &left[3u * i];
        out[i] = (at[0] * j2.x) + (at[1] * j2.y) + (at[2] * j2.z);
    }
}

void jcal_functional_between_rates(const float *rate, jcal_vec3_t j1, jcal_vec3_t j2, float scale, float *out)
{
    const jcal_vec3_t s = {scale * j1.x, scale * j1.y, scale * j1.z};
    for (size_t a = 0u; a < 3u; ++a) {
        const float *r = &rate[27u * a];
        for (size_t b = 0u; b < 3u; ++b) {
            const float x = (s.x * r[0]) + (s.y * r[9]) + (s.z * r[18]);
            const float y = (s.x * r[1]) + (s.y * r[10]) + (s.z * r[19]);
            const float z = (s.x * r[2]) + (s.y * r[11]) + (s.z * r[20]);
            out[(3u * a) + b] = (x * j2.x) + (y * j2.y) + (z * j2.z);
            r = &r[3];
        }
    }
}

float jcal_functional_turn_size(const jcal_functional_sums_t *sums, const float *x, jcal_vec3_t j1, jcal_vec3_t j2)
{
    return 1.0f - (jcal_functional_between(x, j1, j2) / jcal_max(sums->motion_s, MOTION_MIN_S));
}

/// j' M j, M (3 x 3, packed).
static float squared(const float *m, jcal_vec3_t j)
{
    return (m[0] * j.x * j.x) + (m[2] * j.y * j.y) + (m[5] * j.z * j.z) +
           (2.0f * ((m[1] * j.x * j.y) + (m[3] * j.x * j.z) + (m[4] * j.y * j.z)));
}

float jcal_functional_rate_size(const jcal_functional_sums_t *sums, const float *x, jcal_vec3_t j1, jcal_vec3_t j2)
{
    const float own = squared(sums->rate1, j1) + squared(sums->rate2nd, j2);
    const float left = own - (2.0f * jcal_functional_between(x, j1, j2));
    return 0.5f * left / jcal_max(sums->rate2, MOTION_MIN_S);
}

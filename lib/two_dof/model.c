/* SPDX-License-Identifier: MIT */
/// @file
/// Features, moments and the cost of the 2-DoF joint. Equations: two_dof/model.h.
#include "two_dof/model.h"

#include "math/scalar.h"
#include "math/sym.h"

#include <stddef.h>

#define PAIRS 9u

/// |n|^2 is never taken for less: parallel axes have no common normal.
#define NORMAL2_MIN 1e-3f

/* row (3) <- row + s v (3) */
static inline void add3(float *row, float s, const float *v)
{
    row[0] += s * v[0];
    row[1] += s * v[1];
    row[2] += s * v[2];
}

static inline const float *row_of(const float *m, size_t row, size_t column)
{
    return &m[JCAL_SYM_SIZE(row) + column];
}

/// Moments contracted with u on both sides, and with u on one and du / d(delta) on the other.
typedef struct {
    float uu[PAIRS][PAIRS];  ///< Symmetric.
    float ud[PAIRS];         ///< Row a: sum over b of u . block(a, b) du times A_b.
    float dd;                ///< Sum over a, b of A_a A_b du . block(a, b) du.
} contracted_t;

static inline float dot9(const float *a, const float *b)
{
    return (a[0] * b[0]) + (a[1] * b[1]) + (a[2] * b[2]) + (a[3] * b[3]) + (a[4] * b[4]) + (a[5] * b[5]) +
           (a[6] * b[6]) + (a[7] * b[7]) + (a[8] * b[8]);
}

/* u = (c, s, 1) and du = (-s, c, 0); r0 to r2 are rows of the moments. */
static void contract(const float *m, jcal_plane_t u, const float *pairs, contracted_t *out)
{
    const float c = u.re;
    const float s = u.im;
    float sum_dd = 0.0f;
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *r0 = row_of(m, 3u * a, 0u);
        const float *r1 = row_of(m, (3u * a) + 1u, 0u);
        const float *r2 = row_of(m, (3u * a) + 2u, 0u);
        const float pair = pairs[a];
        float on_ud = 0.0f; /* times the pairs */
        float on_dd = 0.0f;
        for (size_t b = 0u; b < a; ++b) {
            const float u0 = (r0[0] * c) + (r0[1] * s) + r0[2]; /* block u */
            const float u1 = (r1[0] * c) + (r1[1] * s) + r1[2];
            const float u2 = (r2[0] * c) + (r2[1] * s) + r2[2];
            const float d0 = (r0[1] * c) - (r0[0] * s); /* block du */
            const float d1 = (r1[1] * c) - (r1[0] * s);
            const float d2 = (r2[1] * c) - (r2[0] * s);
            const float uu = (u0 * c) + (u1 * s) + u2;
            out->uu[a][b] = uu;
            out->uu[b][a] = uu;
            on_ud += ((d0 * c) + (d1 * s) + d2) * pairs[b];
            on_dd += ((d1 * c) - (d0 * s)) * pairs[b];
            out->ud[b] += ((u1 * c) - (u0 * s)) * pair;
            r0 += 3;
            r1 += 3;
            r2 += 3;
        }
        const float u0 = (r0[0] * c) + (r1[0] * s) + r2[0]; /* the block on the diagonal: its lower triangle is there */
        const float u1 = (r1[0] * c) + (r1[1] * s) + r2[1];
        const float u2 = (r2[0] * c) + (r2[1] * s) + r2[2];
        const float d0 = (r1[0] * c) - (r0[0] * s);
        const float d1 = (r1[1] * c) - (r1[0] * s);
        out->uu[a][a] = (u0 * c) + (u1 * s) + u2;
        out->ud[a] = on_ud + (((u1 * c) - (u0 * s)) * pair);
        sum_dd += pair * ((2.0f * on_dd) + (((d1 * c) - (d0 * s)) * pair));
    }
    out->dd = sum_dd;
}

/* out (9) <- a_i b_k */
static void outer(jcal_vec3_t a, jcal_vec3_t b, float *out)
{
    const float x[3] = {a.x, a.y, a.z};
    for (size_t i = 0u; i < 3u; ++i) {
        out[3u * i] = x[i] * b.x;
        out[(3u * i) + 1u] = x[i] * b.y;
        out[(3u * i) + 2u] = x[i] * b.z;
    }
}

float jcal_two_dof_value(const float *features, const jcal_two_dof_point_t *point)
{
    float pairs[PAIRS];
    float value = 0.0f;
    outer(point->j1, point->j2, pairs);
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *const f = &features[3u * a];
        value += pairs[a] * ((f[0] * point->heading.re) + (f[1] * point->heading.im) + f[2]);
    }
    return value;
}

/// j1_i j2_k and its derivatives by the four tilts.
typedef struct {
    float pairs[PAIRS];
    float slope[4][PAIRS];
} pairs_t;

static void pairs_of(const jcal_two_dof_point_t *point, pairs_t *out)
{
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    outer(point->j1, point->j2, out->pairs);
    outer(t1.u, point->j2, out->slope[0]);
    outer(t1.v, point->j2, out->slope[1]);
    outer(point->j1, t2.u, out->slope[2]);
    outer(point->j1, t2.v, out->slope[3]);
}

/* out (9) <- uu v, v (9) */
static void times9(const contracted_t *sums, const float *v, float *out)
{
    const float v0 = v[0], v1 = v[1], v2 = v[2], v3 = v[3], v4 = v[4], v5 = v[5], v6 = v[6], v7 = v[7], v8 = v[8];
    const float *row = sums->uu[0];
    for (size_t a = 0u; a < PAIRS; ++a) {
        out[a] = (row[0] * v0) + (row[1] * v1) + (row[2] * v2) + (row[3] * v3) + (row[4] * v4) + (row[5] * v5) +
                 (row[6] * v6) + (row[7] * v7) + (row[8] * v8);
        row += PAIRS;
    }
}

static void form_of(const float *m, jcal_plane_t heading, const pairs_t *p, jcal_two_dof_lin_t *lin)
{
    contracted_t sums;
    contract(m, heading, p->pairs, &sums);
    float on[PAIRS];
    times9(&sums, p->pairs, on);
    lin->cost = dot9(on, p->pairs);
    lin->gradient[4] = dot9(sums.ud, p->pairs);
    lin->matrix[14] = sums.dd;
    float *row = lin->matrix;
    for (size_t i = 0u; i < 4u; ++i) {
        lin->gradient[i] = dot9(on, p->slope[i]);
        lin->matrix[10u + i] = dot9(sums.ud, p->slope[i]);
    }
    for (size_t i = 0u; i < 4u; ++i) {
        times9(&sums, p->slope[i], on);
        for (size_t k = 0u; k <= i; ++k) {
            *row = dot9(on, p->slope[k]);
            ++row;
        }
    }
}

void jcal_two_dof_form(const float *m, const jcal_two_dof_point_t *point, jcal_two_dof_lin_t *lin)
{
    pairs_t pairs;
    pairs_of(point, &pairs);
    form_of(m, point->heading, &pairs, lin);
}

/* sum (m_a u) A_a and its derivatives by the five unknowns */
static float mean_of(const float *mean, jcal_plane_t heading, const pairs_t *p, float *slope)
{
    float on_u[PAIRS];
    float on_d[PAIRS];
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *const m = &mean[3u * a];
        on_u[a] = (m[0] * heading.re) + (m[1] * heading.im) + m[2];
        on_d[a] = (m[1] * heading.re) - (m[0] * heading.im);
    }
    for (size_t i = 0u; i < 4u; ++i) {
        slope[i] = dot9(on_u, p->slope[i]);
    }
    slope[4] = dot9(on_d, p->pairs);
    return dot9(on_u, p->pairs);
}

void jcal_two_dof_combine(const jcal_two_dof_moments_t *moments, jcal_constraint_t constraint,
                          const jcal_two_dof_point_t *point, jcal_two_dof_lin_t *lin, float *parts)
{
    jcal_two_dof_lin_t form;
    pairs_t pairs;
    float slope[JCAL_TWO_DOF_UNKNOWNS];
    pairs_of(point, &pairs);
    form_of(moments->orientation, point->heading, &pairs, &form);
    const float sum = mean_of(moments->mean, point->heading, &pairs, slope);
    const float per_weight = (moments->weight > 0.0f) ? (1.0f / moments->weight) : 0.0f;
    const float normal2 = jcal_max(1.0f - (form.cost * per_weight), NORMAL2_MIN);
    const float rotation = (constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0f : (1.0f / normal2);
    const float bend = rotation * (lin->cost / normal2) * per_weight; /* weight of the gradient of normal2 */
    const float orientation = (constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0f : 1.0f;
    const float part1 = rotation * lin->cost;
    const float part2 = jcal_max(form.cost - (sum * sum * per_weight), 0.0f);
    const float *from = form.matrix;
    float *to = lin->matrix;
    for (size_t i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        const float mean = slope[i] * per_weight;
        lin->gradient[i] = (rotation * lin->gradient[i]) + (bend * form.gradient[i]) +
                           (orientation * (form.gradient[i] - (sum * mean)));
        for (size_t k = 0u; k <= i; ++k) {
            *to = (rotation * *to) + (orientation * (*from - (slope[k] * mean)));
            ++to;
            ++from;
        }
    }
    lin->cost = part1 + (orientation * part2);
    if (parts != NULL) {
        parts[0] = part1;
        parts[1] = part2;
    }
}

/* The moments contracted with the pairs on both sides: a 3 x 3 form in u, packed. */
static void form_in_u(const float *m, const float *pairs, float *out)
{
    float o00 = 0.0f, o10 = 0.0f, o11 = 0.0f, o20 = 0.0f, o21 = 0.0f, o22 = 0.0f;
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *const r0 = row_of(m, 3u * a, 0u);
        const float *const r1 = row_of(m, (3u * a) + 1u, 0u);
        const float *const r2 = row_of(m, (3u * a) + 2u, 0u);
        for (size_t b = 0u; b < a; ++b) {
            const size_t q = 3u * b;
            const float weight = pairs[a] * pairs[b];
            const float twice = weight + weight;
            o00 += twice * r0[q];
            o11 += twice * r1[q + 1u];
            o22 += twice * r2[q + 2u];
            o10 += weight * (r1[q] + r0[q + 1u]);
            o20 += weight * (r2[q] + r0[q + 2u]);
            o21 += weight * (r2[q + 1u] + r1[q + 2u]);
        }
        const size_t q = 3u * a;
        const float weight = pairs[a] * pairs[a];
        o00 += weight * r0[q];
        o10 += weight * r1[q];
        o11 += weight * r1[q + 1u];
        o20 += weight * r2[q];
        o21 += weight * r2[q + 1u];
        o22 += weight * r2[q + 2u];
    }
    out[0] = o00;
    out[1] = o10;
    out[2] = o11;
    out[3] = o20;
    out[4] = o21;
    out[5] = o22;
}

void jcal_two_dof_costs(const jcal_two_dof_moments_t *moments, jcal_constraint_t constraint,
                        const jcal_two_dof_point_t *point, jcal_two_dof_guess_t *guesses, unsigned count)
{
    float pairs[PAIRS];
    float f[JCAL_SYM_SIZE(3u)];
    float g[JCAL_SYM_SIZE(3u)];
    float mean[3] = {0.0f, 0.0f, 0.0f};
    outer(point->j1, point->j2, pairs);
    form_in_u(moments->rotation, pairs, f);
    form_in_u(moments->orientation, pairs, g);
    for (size_t a = 0u; a < PAIRS; ++a) {
        add3(mean, pairs[a], &moments->mean[3u * a]);
    }
    const float per_weight = (moments->weight > 0.0f) ? (1.0f / moments->weight) : 0.0f;
    for (unsigned i = 0u; i < count; ++i) {
        const float u[3] = {guesses[i].heading.re, guesses[i].heading.im, 1.0f};
        const float sum = (mean[0] * u[0]) + (mean[1] * u[1]) + mean[2];
        const float square = jcal_sym_quadratic(g, 3u, u);
        const float normal2 = jcal_max(1.0f - (square * per_weight), NORMAL2_MIN);
        const float part1 = jcal_sym_quadratic(f, 3u, u) / normal2;
        const float part2 = square - (sum * sum * per_weight);
        guesses[i].cost = ((constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0f : part1) +
                          ((constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0f : part2);
    }
}

float jcal_two_dof_mean(const jcal_two_dof_moments_t *moments, const jcal_two_dof_point_t *point)
{
    const float sum = jcal_two_dof_value(moments->mean, point);
    return (moments->weight > 0.0f) ? (sum / moments->weight) : 0.0f;
}

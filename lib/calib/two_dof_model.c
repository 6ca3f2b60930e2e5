/* SPDX-License-Identifier: MIT */
/// @file
/// Features, moments and the cost of the 2-DoF joint. Equations: two_dof_model.h.
#include "calib/two_dof_model.h"

#include "jointcal/quat.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <stddef.h>

#define PAIRS 9u

/// |n|^2 is never taken for less: parallel axes have no common normal.
#define NORMAL2_MIN 1e-3f

/// Columns of the rotation matrix of q.
typedef struct {
    jcal_vec3_t column[3];
} rotation_t;

static rotation_t rotation_of(jcal_quat_t q)
{
    const rotation_t r = {{jcal_quat_rotate(q, jcal_vec3(1.0f, 0.0f, 0.0f)),
                           jcal_quat_rotate(q, jcal_vec3(0.0f, 1.0f, 0.0f)),
                           jcal_quat_rotate(q, jcal_vec3(0.0f, 0.0f, 1.0f))}};
    return r;
}

/* a . D_m b for m = 0, 1, 2, with D_0 = diag(1, 1, 0), D_1 = z x, D_2 = diag(0, 0, 1). */
static void dot_turned(jcal_vec3_t a, jcal_vec3_t b, float *out)
{
    out[0] = (a.x * b.x) + (a.y * b.y);
    out[1] = (a.y * b.x) - (a.x * b.y);
    out[2] = a.z * b.z;
}

void jcal_two_dof_rotation_features(const jcal_two_dof_sample_t *sample, float *f)
{
    const rotation_t r1 = rotation_of(sample->q1);
    const rotation_t r2 = rotation_of(sample->q2);
    for (size_t i = 0u; i < 3u; ++i) {
        /* w1 . (a x D b) = (w1 x a) . D b, and w2 . (D' a x b) = -(w2 x b) . D' a = -a . D (w2 x b). */
        const jcal_vec3_t turned1 = jcal_vec3_cross(sample->w1, r1.column[i]);
        for (size_t k = 0u; k < 3u; ++k) {
            const jcal_vec3_t turned2 = jcal_vec3_cross(sample->w2, r2.column[k]);
            float first[3];
            float second[3];
            dot_turned(turned1, r2.column[k], first);
            dot_turned(r1.column[i], turned2, second);
            float *const out = &f[((i * 3u) + k) * 3u];
            out[0] = first[0] + second[0];
            out[1] = first[1] + second[1];
            out[2] = first[2] + second[2];
        }
    }
}

void jcal_two_dof_orientation_features(const jcal_two_dof_sample_t *sample, float *g)
{
    const rotation_t r1 = rotation_of(sample->q1);
    const rotation_t r2 = rotation_of(sample->q2);
    for (size_t i = 0u; i < 3u; ++i) {
        for (size_t k = 0u; k < 3u; ++k) {
            dot_turned(r1.column[i], r2.column[k], &g[((i * 3u) + k) * 3u]);
        }
    }
}

/* row (3) <- row + s v (3) */
static inline void add3(float *row, float s, const float *v)
{
    row[0] += s * v[0];
    row[1] += s * v[1];
    row[2] += s * v[2];
}

void jcal_two_dof_add(float *m, const float *v, float weight)
{
    float *row = m;
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *const va = &v[3u * a];
        const float s0 = weight * va[0];
        const float s1 = weight * va[1];
        const float s2 = weight * va[2];
        float *const row1 = row + (3u * a) + 1u;
        float *const row2 = row1 + (3u * a) + 2u;
        for (size_t b = 0u; b < (3u * a); b += 3u) {
            add3(&row[b], s0, &v[b]);
            add3(&row1[b], s1, &v[b]);
            add3(&row2[b], s2, &v[b]);
        }
        const size_t d = 3u * a;
        row[d] += s0 * va[0];
        row1[d] += s1 * va[0];
        row1[d + 1u] += s1 * va[1];
        add3(&row2[d], s2, va);
        row = row2 + d + 3u;
    }
}

/// A 3 x 3 block of the moments, that of the pairs a and b.
typedef struct {
    float at[3][3];
} block_t;

static inline const float *row_of(const float *m, size_t row, size_t column)
{
    return &m[JCAL_SYM_SIZE(row) + column];
}

static block_t block_below(const float *m, size_t a, size_t b)
{
    block_t out;
    for (size_t p = 0u; p < 3u; ++p) {
        const float *const row = row_of(m, (3u * a) + p, 3u * b);
        out.at[p][0] = row[0];
        out.at[p][1] = row[1];
        out.at[p][2] = row[2];
    }
    return out;
}

static block_t block_diagonal(const float *m, size_t a)
{
    const float *const r0 = row_of(m, 3u * a, 3u * a);
    const float *const r1 = row_of(m, (3u * a) + 1u, 3u * a);
    const float *const r2 = row_of(m, (3u * a) + 2u, 3u * a);
    const block_t out = {{{r0[0], r1[0], r2[0]}, {r1[0], r1[1], r2[1]}, {r2[0], r2[1], r2[2]}}};
    return out;
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

/* Adds one block; c, s are u's, so that u = (c, s, 1) and du = (-s, c, 0). */
static void contract_block(const block_t *block, jcal_plane_t u, size_t a, size_t b, const float *pairs,
                           contracted_t *out)
{
    float on_u[3]; /* block u */
    float on_d[3]; /* block du */
    for (size_t p = 0u; p < 3u; ++p) {
        const float *const row = block->at[p];
        on_u[p] = (row[0] * u.re) + (row[1] * u.im) + row[2];
        on_d[p] = (row[1] * u.re) - (row[0] * u.im);
    }
    const float uu = (on_u[0] * u.re) + (on_u[1] * u.im) + on_u[2];
    const float ud = (on_d[0] * u.re) + (on_d[1] * u.im) + on_d[2]; /* du on the side of b */
    const float du = (on_u[1] * u.re) - (on_u[0] * u.im);           /* du on the side of a */
    const float dd = (on_d[1] * u.re) - (on_d[0] * u.im);
    out->uu[a][b] = uu;
    out->ud[a] += ud * pairs[b];
    if (a == b) {
        out->dd += dd * pairs[a] * pairs[a];
    } else {
        out->uu[b][a] = uu;
        out->ud[b] += du * pairs[a];
        out->dd += 2.0f * dd * pairs[a] * pairs[b];
    }
}

static void contract(const float *m, jcal_plane_t u, const float *pairs, contracted_t *out)
{
    out->dd = 0.0f;
    for (size_t a = 0u; a < PAIRS; ++a) {
        out->ud[a] = 0.0f;
    }
    for (size_t a = 0u; a < PAIRS; ++a) {
        for (size_t b = 0u; b < a; ++b) {
            const block_t block = block_below(m, a, b);
            contract_block(&block, u, a, b, pairs, out);
        }
        const block_t block = block_diagonal(m, a);
        contract_block(&block, u, a, a, pairs, out);
    }
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

static pairs_t pairs_of(const jcal_two_dof_point_t *point)
{
    pairs_t out;
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    outer(point->j1, point->j2, out.pairs);
    outer(t1.u, point->j2, out.slope[0]);
    outer(t1.v, point->j2, out.slope[1]);
    outer(point->j1, t2.u, out.slope[2]);
    outer(point->j1, t2.v, out.slope[3]);
    return out;
}

void jcal_two_dof_form(const float *m, const jcal_two_dof_point_t *point, jcal_two_dof_lin_t *lin)
{
    const pairs_t p = pairs_of(point);
    contracted_t sums;
    contract(m, point->heading, p.pairs, &sums);
    float on[PAIRS]; /* uu times a vector of pairs */
    for (size_t a = 0u; a < PAIRS; ++a) {
        on[a] = dot9(sums.uu[a], p.pairs);
    }
    lin->cost = dot9(on, p.pairs);
    lin->gradient[4] = dot9(sums.ud, p.pairs);
    lin->matrix[jcal_sym_at(4u, 4u)] = sums.dd;
    for (size_t i = 0u; i < 4u; ++i) {
        lin->gradient[i] = dot9(on, p.slope[i]);
        lin->matrix[jcal_sym_at(4u, i)] = dot9(sums.ud, p.slope[i]);
    }
    for (size_t i = 0u; i < 4u; ++i) {
        for (size_t a = 0u; a < PAIRS; ++a) {
            on[a] = dot9(sums.uu[a], p.slope[i]);
        }
        for (size_t k = 0u; k <= i; ++k) {
            lin->matrix[jcal_sym_at(i, k)] = dot9(on, p.slope[k]);
        }
    }
}

/* sum (m_a u) A_a and its derivatives by the five unknowns */
static float mean_of(const float *mean, const jcal_two_dof_point_t *point, float *slope)
{
    const pairs_t p = pairs_of(point);
    float on_u[PAIRS];
    float on_d[PAIRS];
    for (size_t a = 0u; a < PAIRS; ++a) {
        const float *const m = &mean[3u * a];
        on_u[a] = (m[0] * point->heading.re) + (m[1] * point->heading.im) + m[2];
        on_d[a] = (m[1] * point->heading.re) - (m[0] * point->heading.im);
    }
    for (size_t i = 0u; i < 4u; ++i) {
        slope[i] = dot9(on_u, p.slope[i]);
    }
    slope[4] = dot9(on_d, p.pairs);
    return dot9(on_u, p.pairs);
}

void jcal_two_dof_combine(const jcal_two_dof_moments_t *moments, jcal_constraint_t constraint,
                          const jcal_two_dof_point_t *point, jcal_two_dof_lin_t *lin, float *parts)
{
    jcal_two_dof_lin_t form;
    jcal_two_dof_form(moments->orientation, point, &form);
    float slope[JCAL_TWO_DOF_UNKNOWNS];
    const float sum = mean_of(moments->mean, point, slope);
    const float per_weight = (moments->weight > 0.0f) ? (1.0f / moments->weight) : 0.0f;
    const float normal2 = jcal_max(1.0f - (form.cost * per_weight), NORMAL2_MIN);
    const float rotation = (constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0f : (1.0f / normal2);
    const float bend = rotation * (lin->cost / normal2) * per_weight; /* weight of the gradient of normal2 */
    const float orientation = (constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0f : 1.0f;
    const float part1 = rotation * lin->cost;
    const float part2 = jcal_max(form.cost - (sum * sum * per_weight), 0.0f);
    for (size_t i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        lin->gradient[i] = (rotation * lin->gradient[i]) + (bend * form.gradient[i]) +
                           (orientation * (form.gradient[i] - (sum * slope[i] * per_weight)));
        for (size_t k = 0u; k <= i; ++k) {
            const size_t at = jcal_sym_at(i, k);
            lin->matrix[at] =
                (rotation * lin->matrix[at]) + (orientation * (form.matrix[at] - (slope[i] * slope[k] * per_weight)));
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
    jcal_sym_zero(out, 3u);
    for (size_t a = 0u; a < PAIRS; ++a) {
        float sum[3][3] = {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}};
        for (size_t b = 0u; b < a; ++b) {
            for (size_t p = 0u; p < 3u; ++p) {
                add3(sum[p], 2.0f * pairs[b], row_of(m, (3u * a) + p, 3u * b));
            }
        }
        const block_t own = block_diagonal(m, a);
        for (size_t p = 0u; p < 3u; ++p) {
            add3(sum[p], pairs[a], own.at[p]);
        }
        for (size_t p = 0u; p < 3u; ++p) {
            for (size_t q = 0u; q <= p; ++q) {
                out[jcal_sym_at(p, q)] += 0.5f * pairs[a] * (sum[p][q] + sum[q][p]);
            }
        }
    }
}

void jcal_two_dof_costs(const jcal_two_dof_moments_t *moments, jcal_constraint_t constraint,
                        const jcal_two_dof_point_t *point, const jcal_plane_t *headings, unsigned count, float *costs)
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
        const float u[3] = {headings[i].re, headings[i].im, 1.0f};
        const float sum = (mean[0] * u[0]) + (mean[1] * u[1]) + mean[2];
        const float square = jcal_sym_quadratic(g, 3u, u);
        const float normal2 = jcal_max(1.0f - (square * per_weight), NORMAL2_MIN);
        const float part1 = jcal_sym_quadratic(f, 3u, u) / normal2;
        const float part2 = square - (sum * sum * per_weight);
        costs[i] = ((constraint == JCAL_CONSTRAINT_ORIENTATION) ? 0.0f : part1) +
                   ((constraint == JCAL_CONSTRAINT_ROTATION) ? 0.0f : part2);
    }
}

/* (x, y) turned */
static inline void turn2(float *x, float *y, jcal_plane_t turn)
{
    const float a = *x;
    const float b = *y;
    *x = (turn.re * a) - (turn.im * b);
    *y = (turn.im * a) + (turn.re * b);
}

/* m <- U m U', U turning the first two of each three. */
static void turn_form(float *m, jcal_plane_t turn)
{
    for (size_t a = 0u; a < PAIRS; ++a) {
        float *const row0 = &m[JCAL_SYM_SIZE(3u * a)];
        float *const row1 = &m[JCAL_SYM_SIZE((3u * a) + 1u)];
        float *const row2 = &m[JCAL_SYM_SIZE((3u * a) + 2u)];
        for (size_t b = 0u; b < a; ++b) {
            for (size_t q = 3u * b; q < ((3u * b) + 3u); ++q) {
                turn2(&row0[q], &row1[q], turn);
            }
            turn2(&row0[3u * b], &row0[(3u * b) + 1u], turn);
            turn2(&row1[3u * b], &row1[(3u * b) + 1u], turn);
            turn2(&row2[3u * b], &row2[(3u * b) + 1u], turn);
        }
        const size_t d = 3u * a;
        float lower[2] = {row0[d], row1[d]};      /* first column of the diagonal block ... */
        float upper[2] = {row1[d], row1[d + 1u]}; /* ... and second */
        turn2(&lower[0], &lower[1], turn);
        turn2(&upper[0], &upper[1], turn);
        turn2(&lower[0], &upper[0], turn);
        turn2(&lower[1], &upper[1], turn);
        row0[d] = lower[0];
        row1[d] = lower[1];
        row1[d + 1u] = upper[1];
        turn2(&row2[d], &row2[d + 1u], turn);
    }
}

void jcal_two_dof_turn(jcal_two_dof_moments_t *moments, jcal_plane_t turn)
{
    turn_form(moments->rotation, turn);
    turn_form(moments->orientation, turn);
    for (size_t a = 0u; a < PAIRS; ++a) {
        turn2(&moments->mean[3u * a], &moments->mean[(3u * a) + 1u], turn);
    }
}

void jcal_two_dof_fade(jcal_two_dof_moments_t *moments, float share)
{
    jcal_sym_scale(moments->rotation, JCAL_TWO_DOF_FEATURES, share);
    jcal_sym_scale(moments->orientation, JCAL_TWO_DOF_FEATURES, share);
    for (size_t i = 0u; i < JCAL_TWO_DOF_FEATURES; ++i) {
        moments->mean[i] *= share;
    }
    moments->weight *= share;
}

float jcal_two_dof_mean(const jcal_two_dof_moments_t *moments, const jcal_two_dof_point_t *point)
{
    float slope[JCAL_TWO_DOF_UNKNOWNS];
    const float sum = mean_of(moments->mean, point, slope);
    return (moments->weight > 0.0f) ? (sum / moments->weight) : 0.0f;
}

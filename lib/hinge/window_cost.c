/* SPDX-License-Identifier: MIT */
/// @file
/// Sums over selected samples for [OLS20] (23), (30)-(41).
#include "hinge/window_cost.h"

#include "hinge/window_residual.h"

enum { UNKNOWNS = 4, ROW = 6 };

static void sum_gyr(const jcal_row_t *rows, size_t count, const jcal_hinge_frame_t frames[2], jcal_hinge_kind_t *out)
{
    for (size_t k = 0u; k < count; ++k) {
        float jac[UNKNOWNS];
        const float e = jcal_hinge_gyr_residual(frames, rows[k].v, jac);
        out->sum += e;
        out->square += e * e;
        for (size_t i = 0u; i < UNKNOWNS; ++i) {
            out->gradient[i] += jac[i] * e;
        }
        jcal_sym_rank1(out->matrix, UNKNOWNS, jac, 1.0f);
    }
    out->n += count;
}

/* T (6 x 4): tangent coordinates of both axes to (j1, j2) in R^6. */
static void lift_matrix(const jcal_hinge_frame_t frames[2], float t[ROW * UNKNOWNS])
{
    for (size_t i = 0u; i < (ROW * UNKNOWNS); ++i) {
        t[i] = 0.0f;
    }
    for (size_t s = 0u; s < 2u; ++s) {
        const jcal_tangent_t *const b = &frames[s].t;
        const float u[3] = {b->u.x, b->u.y, b->u.z};
        const float v[3] = {b->v.x, b->v.y, b->v.z};
        for (size_t i = 0u; i < 3u; ++i) {
            t[(((3u * s) + i) * UNKNOWNS) + (2u * s)] = u[i];
            t[(((3u * s) + i) * UNKNOWNS) + (2u * s) + 1u] = v[i];
        }
    }
}

/* e_a is linear in (j1, j2), so its matrix needs only A^T A; gradient and square are summed from the rows, where
   small residuals of large accelerations keep their digits. */
static void sum_acc(const jcal_hinge_rows_t *rows, const jcal_hinge_axes_t *axes, const jcal_hinge_frame_t frames[2],
                    jcal_hinge_kind_t *out)
{
    float ambient[ROW] = {0.0f}; /* A^T e */
    for (size_t k = 0u; k < rows->n_acc; ++k) {
        const float *const a = rows->acc[k].v;
        const float e = jcal_hinge_acc_residual(axes->j, a);
        out->sum += e;
        out->square += e * e;
        for (size_t i = 0u; i < ROW; ++i) {
            ambient[i] += a[i] * e;
        }
    }
    float t[ROW * UNKNOWNS]; /* 6 x 4 */
    lift_matrix(frames, t);
    for (size_t i = 0u; i < UNKNOWNS; ++i) {
        for (size_t r = 0u; r < ROW; ++r) {
            out->gradient[i] += t[(r * UNKNOWNS) + i] * ambient[r];
        }
    }
    jcal_sym_congruence(rows->ata, ROW, t, UNKNOWNS, out->matrix);
    out->n = rows->n_acc;
}

void jcal_hinge_cost_sums(const jcal_hinge_rows_t *rows, const jcal_hinge_axes_t *axes, jcal_hinge_sums_t *out)
{
    const jcal_hinge_frame_t frames[2] = {jcal_hinge_frame(axes->j[0]), jcal_hinge_frame(axes->j[1])};
    *out = (jcal_hinge_sums_t){0};
    sum_gyr(rows->gyr[0], rows->n_gyr[0], frames, &out->gyr);
    sum_gyr(rows->gyr[1], rows->n_gyr[1], frames, &out->gyr);
    sum_acc(rows, axes, frames, &out->acc);
    /* (70): w_w^2 = w0, w_a^2 = 1 / w0 */
    const float weight_acc = 1.0f / rows->w0;
    out->cost = (rows->w0 * out->gyr.square) + (weight_acc * out->acc.square);
    for (size_t i = 0u; i < UNKNOWNS; ++i) {
        out->gradient[i] = (rows->w0 * out->gyr.gradient[i]) + (weight_acc * out->acc.gradient[i]);
    }
    for (size_t k = 0u; k < JCAL_SYM_SIZE(UNKNOWNS); ++k) {
        out->matrix[k] = (rows->w0 * out->gyr.matrix[k]) + (weight_acc * out->acc.matrix[k]);
    }
}

/* sum (e_w' - e_w) (e_w' + e_w) over one piece of the gyroscope rows. */
static float change_gyr(const jcal_row_t *rows, size_t count, const jcal_hinge_move_t moves[2])
{
    float sum = 0.0f;
    for (size_t k = 0u; k < count; ++k) {
        const float *const w = rows[k].v;
        float before[2];
        const float change1 = jcal_hinge_rate_change(&moves[0], jcal_vec3(w[0], w[1], w[2]), &before[0]);
        const float change2 = jcal_hinge_rate_change(&moves[1], jcal_vec3(w[3], w[4], w[5]), &before[1]);
        const float change = change1 - change2;
        sum += change * ((2.0f * (before[0] - before[1])) + change);
    }
    return sum;
}

/* sum (e_a' - e_a) (e_a' + e_a). */
static float change_acc(const jcal_row_t *rows, size_t count, const jcal_hinge_move_t moves[2])
{
    const jcal_vec3_t less[2] = {moves[0].less, moves[1].less};
    const jcal_vec3_t plus[2] = {moves[0].plus, moves[1].plus};
    float sum = 0.0f;
    for (size_t k = 0u; k < count; ++k) {
        sum += jcal_hinge_acc_residual(less, rows[k].v) * jcal_hinge_acc_residual(plus, rows[k].v);
    }
    return sum;
}

float jcal_hinge_cost_change(const jcal_hinge_rows_t *rows, const jcal_hinge_axes_t *from, const jcal_hinge_axes_t *to)
{
    const jcal_hinge_move_t moves[2] = {jcal_hinge_move(from->j[0], to->j[0]), jcal_hinge_move(from->j[1], to->j[1])};
    const float gyr = change_gyr(rows->gyr[0], rows->n_gyr[0], moves) + change_gyr(rows->gyr[1], rows->n_gyr[1], moves);
    const float acc = change_acc(rows->acc, rows->n_acc, moves);
    return 0.5f * ((rows->w0 * gyr) + (acc / rows->w0));
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Residuals of a 2-DoF joint over rows. Equations: two_dof/window_cost.h.
#include "two_dof/window_cost.h"

#include "joint/watch.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "two_dof/residual.h"
#include "two_dof/starts.h"

#include <float.h>
#include <math.h>

/// |n|^2 is never taken for less: parallel axes have no common normal.
#define NORMAL2_MIN 1e-6f

unsigned jcal_two_dof_window_unknowns(jcal_constraint_t constraint)
{
    return (constraint == JCAL_CONSTRAINT_ORIENTATION) ? JCAL_TWO_DOF_WINDOW_UNKNOWNS : JCAL_TWO_DOF_UNKNOWNS;
}

/* z x v */
static jcal_vec3_t z_cross(jcal_vec3_t v)
{
    return jcal_vec3(-v.y, v.x, 0.0f);
}

/* slope (4) <- T1' R1' by_a, T2' R2' D' by_b */
static void to_tangents(const jcal_two_dof_row_t *row, const jcal_two_dof_point_t *point, jcal_vec3_t by_a,
                        jcal_vec3_t by_b, float *slope)
{
    const jcal_plane_t back = {point->heading.re, -point->heading.im};
    const jcal_tangent_t t1 = jcal_sphere_tangent(point->j1);
    const jcal_tangent_t t2 = jcal_sphere_tangent(point->j2);
    const jcal_vec3_t by_j1 = jcal_quat_rotate(jcal_quat_conj(row->q1), by_a);
    const jcal_vec3_t by_j2 = jcal_quat_rotate(jcal_quat_conj(row->q2), jcal_two_dof_about_z(by_b, back));
    slope[0] = jcal_vec3_dot(by_j1, t1.u);
    slope[1] = jcal_vec3_dot(by_j1, t1.v);
    slope[2] = jcal_vec3_dot(by_j2, t2.u);
    slope[3] = jcal_vec3_dot(by_j2, t2.v);
}

void jcal_two_dof_window_residual(const jcal_two_dof_row_t *row, jcal_constraint_t constraint,
                                  const jcal_two_dof_point_t *point, float sine, jcal_two_dof_residual_t *out)
{
    const jcal_vec3_t a = jcal_quat_rotate(row->q1, point->j1);
    const jcal_vec3_t b = jcal_two_dof_about_z(jcal_quat_rotate(row->q2, point->j2), point->heading);
    out->product = jcal_vec3_dot(a, b);
    if (constraint == JCAL_CONSTRAINT_ORIENTATION) {
        out->e = out->product - sine;
        to_tangents(row, point, b, a, out->slope);
        out->slope[4] = jcal_vec3_dot(a, z_cross(b));
        out->slope[5] = -1.0f;
        return;
    }
    const jcal_vec3_t w2 = jcal_two_dof_about_z(row->w2, point->heading);
    const jcal_vec3_t w = jcal_vec3_sub(row->w1, w2);
    const jcal_vec3_t n = jcal_vec3_cross(a, b);
    const float per_length = 1.0f / sqrtf(jcal_max(jcal_vec3_dot(n, n), NORMAL2_MIN));
    const jcal_vec3_t unit = jcal_vec3_scale(n, per_length);
    out->e = jcal_vec3_dot(w, unit);
    const jcal_vec3_t by_n = jcal_vec3_scale(jcal_vec3_sub(w, jcal_vec3_scale(unit, out->e)), per_length);
    const jcal_vec3_t by_b = jcal_vec3_cross(by_n, a);
    to_tangents(row, point, jcal_vec3_cross(b, by_n), by_b, out->slope);
    out->slope[4] = jcal_vec3_dot(by_b, z_cross(b)) - jcal_vec3_dot(unit, z_cross(w2));
    out->slope[5] = 0.0f;
}

/// Variance of a residual by the config and for how many rows it lasts; rest lasts for all. `time_s` <- the row's time of motion.
static float variance_of(const jcal_two_dof_rows_t *rows, const jcal_two_dof_row_t *row, float *time_s, float *lasts)
{
    const jcal_two_dof_config_t *const cfg = rows->cfg;
    const float rate2 = jcal_vec3_dot(row->w1, row->w1) + jcal_vec3_dot(row->w2, row->w2);
    const bool turn = cfg->constraint == JCAL_CONSTRAINT_ROTATION;
    const float lasts_s = turn ? JCAL_TWO_DOF_RATE_TIME_S : JCAL_TWO_DOF_ANGLE_TIME_S;
    *time_s = row->dt_s * jcal_watch_motion(rate2);
    *lasts = jcal_max(jcal_min(lasts_s / (*time_s + FLT_MIN), (float)rows->count), 1.0f);
    return turn ? ((cfg->rate_noise_rad_s * cfg->rate_noise_rad_s) + (cfg->rate_error * cfg->rate_error * rate2))
                : (cfg->angle_noise_rad * cfg->angle_noise_rad);
}

void jcal_two_dof_window_sum(const jcal_two_dof_rows_t *rows, const jcal_two_dof_point_t *point, float sine,
                             jcal_two_dof_window_sums_t *out)
{
    const jcal_constraint_t constraint = rows->cfg->constraint;
    const unsigned n = jcal_two_dof_window_unknowns(constraint);
    const bool turn = constraint == JCAL_CONSTRAINT_ROTATION;
    const float per_lasts_s = 1.0f / (turn ? JCAL_TWO_DOF_RATE_TIME_S : JCAL_TWO_DOF_ANGLE_TIME_S);
    jcal_clear(out, sizeof *out);
    for (size_t k = 0u; k < rows->count; ++k) {
        jcal_two_dof_residual_t r;
        float time_s;
        float lasts;
        jcal_two_dof_window_residual(&rows->rows[k], constraint, point, sine, &r);
        const float variance = variance_of(rows, &rows->rows[k], &time_s, &lasts);
        out->cost += r.e * r.e;
        out->weighted += r.e * r.e * per_lasts_s * time_s / variance;
        out->moving_s += time_s;
        out->sine += r.product;
        for (unsigned i = 0u; i < n; ++i) {
            out->gradient[i] += r.slope[i] * r.e;
        }
        jcal_sym_rank1(out->matrix, n, r.slope, 1.0f);
        jcal_sym_rank1(out->spread, n, r.slope, lasts * variance);
    }
    out->sine /= jcal_max((float)rows->count, 1.0f);
}

void jcal_two_dof_window_costs(const jcal_two_dof_rows_t *rows, const jcal_two_dof_point_t *point, float *costs,
                               float *sines)
{
    const jcal_plane_t *const turns = jcal_two_dof_start_headings();
    const bool turn = rows->cfg->constraint == JCAL_CONSTRAINT_ROTATION;
    const float per_count = 1.0f / jcal_max((float)rows->count, 1.0f);
    for (unsigned i = 0u; i < JCAL_TWO_DOF_HEADINGS; ++i) {
        costs[i] = 0.0f;
        sines[i] = 0.0f;
    }
    for (size_t k = 0u; k < rows->count; ++k) {
        const jcal_two_dof_row_t *const row = &rows->rows[k];
        const jcal_vec3_t a = jcal_quat_rotate(row->q1, point->j1);
        const jcal_vec3_t in2 = jcal_quat_rotate(row->q2, point->j2);
        for (unsigned i = 0u; i < JCAL_TWO_DOF_HEADINGS; ++i) {
            const jcal_vec3_t b = jcal_two_dof_about_z(in2, turns[i]);
            const float product = jcal_vec3_dot(a, b);
            sines[i] += product * per_count;
            if (turn) {
                const jcal_vec3_t w = jcal_vec3_sub(row->w1, jcal_two_dof_about_z(row->w2, turns[i]));
                const float value = jcal_vec3_dot(w, jcal_vec3_cross(a, b));
                costs[i] += value * value / jcal_max(1.0f - (product * product), NORMAL2_MIN);
            } else {
                costs[i] += product * product;
            }
        }
    }
    for (unsigned i = 0u; (i < JCAL_TWO_DOF_HEADINGS) && !turn; ++i) {
        costs[i] -= (float)rows->count * sines[i] * sines[i];
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// What forgotten samples said of the axes. See two_dof/prior.h.
#include "two_dof/prior.h"

#include "math/sym.h"

#include <stddef.h>

#define TILTS 4u

/// The prior never counts as more than this, 1 / rad^2, summed over the four tilts: 0.05 deg each.
#define TRACE_MAX 5e6f

/// Offset of one axis from its anchor in the anchor's tangent basis, and its slope by the tilts at the axis.
typedef struct {
    float offset[2];
    float slope[2][2];
} view_t;

static view_t view_of(jcal_vec3_t anchor, jcal_vec3_t j)
{
    const jcal_tangent_t from = jcal_sphere_tangent(anchor);
    const jcal_tangent_t to = jcal_sphere_tangent(j);
    const float sign = (jcal_vec3_dot(anchor, j) < 0.0f) ? -1.0f : 1.0f;
    const view_t view = {
        {sign * jcal_vec3_dot(from.u, j), sign * jcal_vec3_dot(from.v, j)},
        {{sign * jcal_vec3_dot(from.u, to.u), sign * jcal_vec3_dot(from.u, to.v)},
         {sign * jcal_vec3_dot(from.v, to.u), sign * jcal_vec3_dot(from.v, to.v)}},
    };
    return view;
}

/* out (2) <- S' v */
static void slope_times(const view_t *view, const float *v, float *out)
{
    out[0] = (view->slope[0][0] * v[0]) + (view->slope[1][0] * v[1]);
    out[1] = (view->slope[0][1] * v[0]) + (view->slope[1][1] * v[1]);
}

/* out (2 x 2) <- S_i' block S_k, the block of the packed 4 x 4 matrix m of axes i and k */
static void turn_block(const float *m, const view_t views[2], size_t i, size_t k, float out[2][2])
{
    float on[2][2]; /* rows of the block times the right slope */
    for (size_t a = 0u; a < 2u; ++a) {
        const size_t row = (2u * i) + a;
        const float block[2] = {m[jcal_sym_at(row, 2u * k)], m[jcal_sym_at(row, (2u * k) + 1u)]};
        slope_times(&views[k], block, on[a]);
    }
    for (size_t b = 0u; b < 2u; ++b) {
        const float v[2] = {on[0][b], on[1][b]};
        float column[2];
        slope_times(&views[i], v, column);
        out[0][b] = column[0];
        out[1][b] = column[1];
    }
}

/* Cost, and half the gradient (4) in the tilts at the place of the views. */
static float slope_of(const jcal_two_dof_prior_t *prior, const view_t views[2], float *gradient)
{
    const float offset[TILTS] = {views[0].offset[0], views[0].offset[1], views[1].offset[0], views[1].offset[1]};
    float on[TILTS];
    float cost = 0.0f;
    jcal_sym_times(prior->matrix, TILTS, offset, on);
    for (size_t i = 0u; i < TILTS; ++i) {
        cost += offset[i] * (on[i] + (2.0f * prior->gradient[i]));
        on[i] += prior->gradient[i];
    }
    slope_times(&views[0], &on[0], &gradient[0]);
    slope_times(&views[1], &on[2], &gradient[2]);
    return cost;
}

/* Cost, half gradient (4) and matrix (4 x 4, packed) in the tilts at `point`. */
static float view_prior(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point, float *gradient,
                        float *matrix)
{
    const view_t views[2] = {view_of(prior->j1, point->j1), view_of(prior->j2, point->j2)};
    float first[2][2];
    float cross[2][2];
    float second[2][2];
    turn_block(prior->matrix, views, 0u, 0u, first);
    turn_block(prior->matrix, views, 1u, 0u, cross);
    turn_block(prior->matrix, views, 1u, 1u, second);
    const float packed[JCAL_SYM_SIZE(TILTS)] = {first[0][0],  first[1][0], first[1][1], cross[0][0],  cross[0][1],
                                                second[0][0], cross[1][0], cross[1][1], second[1][0], second[1][1]};
    for (size_t i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        matrix[i] = packed[i];
    }
    return slope_of(prior, views, gradient);
}

void jcal_two_dof_prior_apply(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point,
                              const jcal_two_dof_lin_t *lin, jcal_two_dof_lin_t *all)
{
    float gradient[TILTS];
    float matrix[JCAL_SYM_SIZE(TILTS)];
    all->cost = lin->cost + view_prior(prior, point, gradient, matrix);
    for (size_t i = 0u; i < TILTS; ++i) {
        all->gradient[i] = lin->gradient[i] + gradient[i];
    }
    all->gradient[TILTS] = lin->gradient[TILTS];
    for (size_t i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        all->matrix[i] = lin->matrix[i] + matrix[i];
    }
    for (size_t i = JCAL_SYM_SIZE(TILTS); i < JCAL_SYM_SIZE(JCAL_TWO_DOF_UNKNOWNS); ++i) {
        all->matrix[i] = lin->matrix[i];
    }
}

float jcal_two_dof_prior_cost(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point)
{
    const view_t views[2] = {view_of(prior->j1, point->j1), view_of(prior->j2, point->j2)};
    float gradient[TILTS];
    return slope_of(prior, views, gradient);
}

void jcal_two_dof_prior_take(jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point,
                             const jcal_two_dof_lin_t *lin, float share)
{
    jcal_two_dof_prior_t next;
    (void)view_prior(prior, point, next.gradient, next.matrix);
    const float *const heading = &lin->matrix[jcal_sym_at(TILTS, 0u)];
    const float own = heading[TILTS];
    const float per_own = (own > 0.0f) ? (1.0f / own) : 0.0f;
    float trace = 0.0f;
    for (size_t i = 0u; i < TILTS; ++i) {
        next.gradient[i] += share * (lin->gradient[i] - (heading[i] * lin->gradient[TILTS] * per_own));
        for (size_t k = 0u; k <= i; ++k) {
            const size_t at = jcal_sym_at(i, k);
            next.matrix[at] += share * (lin->matrix[at] - (heading[i] * heading[k] * per_own));
        }
        trace += next.matrix[jcal_sym_at(i, i)];
    }
    const float keep = (trace > TRACE_MAX) ? (TRACE_MAX / trace) : 1.0f;
    for (size_t i = 0u; i < TILTS; ++i) {
        prior->gradient[i] = keep * next.gradient[i];
    }
    for (size_t i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        prior->matrix[i] = keep * next.matrix[i];
    }
    prior->j1 = point->j1;
    prior->j2 = point->j2;
}

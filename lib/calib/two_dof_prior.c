/* SPDX-License-Identifier: MIT */
/// @file
/// What forgotten samples said of the axes. See two_dof_prior.h.
#include "calib/two_dof_prior.h"

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

/* Offsets (4) and slopes (4 x 4, row-major, two blocks). */
static void look(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point, float *offset, float *slope)
{
    const view_t view1 = view_of(prior->j1, point->j1);
    const view_t view2 = view_of(prior->j2, point->j2);
    for (size_t i = 0u; i < (TILTS * TILTS); ++i) {
        slope[i] = 0.0f;
    }
    for (size_t i = 0u; i < 2u; ++i) {
        offset[i] = view1.offset[i];
        offset[i + 2u] = view2.offset[i];
        for (size_t k = 0u; k < 2u; ++k) {
            slope[(i * TILTS) + k] = view1.slope[i][k];
            slope[((i + 2u) * TILTS) + k + 2u] = view2.slope[i][k];
        }
    }
}

/* Cost, half gradient (4) and matrix (4 x 4, packed) in the tilts at `point`. */
static float view_prior(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point, float *gradient,
                        float *matrix)
{
    float offset[TILTS];
    float slope[TILTS * TILTS];
    float on[TILTS];
    look(prior, point, offset, slope);
    jcal_sym_times(prior->matrix, TILTS, offset, on);
    float cost = 0.0f;
    for (size_t i = 0u; i < TILTS; ++i) {
        cost += offset[i] * (on[i] + (2.0f * prior->gradient[i]));
        on[i] += prior->gradient[i];
    }
    for (size_t k = 0u; k < TILTS; ++k) {
        gradient[k] = 0.0f;
        for (size_t i = 0u; i < TILTS; ++i) {
            gradient[k] += slope[(i * TILTS) + k] * on[i];
        }
    }
    jcal_sym_congruence(prior->matrix, TILTS, slope, TILTS, matrix);
    return cost;
}

void jcal_two_dof_prior_apply(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point,
                              jcal_two_dof_lin_t *lin)
{
    float gradient[TILTS];
    float matrix[JCAL_SYM_SIZE(TILTS)];
    lin->cost += view_prior(prior, point, gradient, matrix);
    for (size_t i = 0u; i < TILTS; ++i) {
        lin->gradient[i] += gradient[i];
    }
    for (size_t i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        lin->matrix[i] += matrix[i];
    }
}

float jcal_two_dof_prior_cost(const jcal_two_dof_prior_t *prior, const jcal_two_dof_point_t *point)
{
    float gradient[TILTS];
    float matrix[JCAL_SYM_SIZE(TILTS)];
    return view_prior(prior, point, gradient, matrix);
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

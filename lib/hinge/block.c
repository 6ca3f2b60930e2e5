/* SPDX-License-Identifier: MIT */
/// @file
/// One block of the refined axes. See hinge/block.h.
#include "hinge/block.h"

#include "hinge/point.h"
#include "jointcal/vec3.h"
#include "math/plane.h"
#include "math/sym.h"

#include <math.h>

#define COLUMNS JCAL_HINGE_BLOCK_COLUMNS

void jcal_hinge_block_begin(jcal_hinge_block_t *block)
{
    *block = (jcal_hinge_block_t){0};
    block->turn_other.re = 1.0f;
}

static jcal_hinge_view_t look(const jcal_hinge_axis_t *axis, jcal_vec3_t w, const float bias[2], float bias_unit)
{
    const jcal_hinge_view_t view = {{jcal_vec3_dot(w, axis->u) - (bias_unit * bias[0]),
                                     jcal_vec3_dot(w, jcal_hinge_v(axis)) - (bias_unit * bias[1])},
                                    jcal_vec3_dot(w, axis->j)};
    return view;
}

/// Carries the phases and the paths on from the previous sample, by the trapezoidal rule.
static void carry_on(jcal_hinge_refine_t *self, const jcal_hinge_view_t *view1, const jcal_hinge_view_t *view2,
                     float dt_s)
{
    jcal_hinge_block_t *const block = &self->block;
    const float half = 0.5f * dt_s;
    const float turn1 = half * (view1->along + self->last1.along);
    const float turn2 = half * (view2->along + self->last2.along);
    self->phase = jcal_plane_times(self->phase, jcal_plane_turn(turn1 - turn2));
    if (block->time_s > 0.0f) {
        block->turn_other = jcal_plane_times(block->turn_other, jcal_plane_turn(turn1 + turn2));
        block->path1 = jcal_plane_add(jcal_plane_add(block->path1, half, view1->across), half, self->last1.across);
        block->path2 = jcal_plane_add(jcal_plane_add(block->path2, half, view2->across), half, self->last2.across);
    }
}

/// Adds residual and derivatives of one sample. `seen` is z1 as sensor 2 should see it.
///
/// dr/dd1 = -c l1 (1, i) + i seen Re(conj(path1) (1, i)),  dr/dd2 = l2 (1, i) - i seen Re(conj(path2) (1, i)),
/// dr/db1 = -c (1, i),  dr/db2 = (1, i),  dr/dphase = i seen,  c = p exp(-i theta).
static void add_residual(jcal_hinge_refine_t *self, jcal_plane_t seen, float bias_unit, float weight)
{
    jcal_hinge_block_t *const block = &self->block;
    const jcal_plane_t r = jcal_plane_add(seen, -1.0f, self->last2.across);
    const jcal_plane_t c1 = {-self->phase.re * self->last1.along, -self->phase.im * self->last1.along};
    const jcal_plane_t b1 = {-self->phase.re * bias_unit, -self->phase.im * bias_unit};
    const jcal_plane_t turn = {-seen.im, seen.re};
    const float l2 = self->last2.along;
    const float re[COLUMNS] = {c1.re + (turn.re * block->path1.re),
                               -c1.im + (turn.re * block->path1.im),
                               l2 - (turn.re * block->path2.re),
                               -(turn.re * block->path2.im),
                               b1.re,
                               -b1.im,
                               bias_unit,
                               0.0f,
                               turn.re};
    const float im[COLUMNS] = {c1.im + (turn.im * block->path1.re),
                               c1.re + (turn.im * block->path1.im),
                               -(turn.im * block->path2.re),
                               l2 - (turn.im * block->path2.im),
                               b1.im,
                               b1.re,
                               0.0f,
                               bias_unit,
                               turn.im};
    jcal_sym_rank1(block->matrix, COLUMNS, re, weight);
    jcal_sym_rank1(block->matrix, COLUMNS, im, weight);
    for (unsigned i = 0u; i < COLUMNS; ++i) {
        block->gradient[i] += weight * ((re[i] * r.re) + (im[i] * r.im));
    }
}

/// Adds the accelerometer's pull on the axes: it has sums of its own, only its scatter is taken from here.
static void add_acc_score(jcal_hinge_block_t *block, const jcal_hinge_point_t *point, float constant_m_s2,
                          const jcal_hinge_sample_t *sample)
{
    const jcal_hinge_axis_t *const axis1 = &point->axis1;
    const jcal_hinge_axis_t *const axis2 = &point->axis2;
    const float residual = jcal_vec3_dot(axis1->j, sample->a1) - jcal_vec3_dot(axis2->j, sample->a2) - constant_m_s2;
    const float pull = sample->acc_weight * residual;
    block->acc_score[0] += pull * jcal_vec3_dot(sample->a1, axis1->u);
    block->acc_score[1] += pull * jcal_vec3_dot(sample->a1, jcal_hinge_v(axis1));
    block->acc_score[2] -= pull * jcal_vec3_dot(sample->a2, axis2->u);
    block->acc_score[3] -= pull * jcal_vec3_dot(sample->a2, jcal_hinge_v(axis2));
}

/// Sums that weigh what the axes' information is worth.
static void add_powers(jcal_hinge_refine_t *self, float weight)
{
    const jcal_hinge_view_t *const view1 = &self->last1;
    const jcal_hinge_view_t *const view2 = &self->last2;
    const float joint = view2->along - view1->along;
    self->block.joint += weight * joint * joint;
    self->along[0] += weight * view1->along * view1->along;
    self->along[1] += weight * view2->along * view2->along;
    self->across += weight * 0.5f * (jcal_plane_norm2(view1->across) + jcal_plane_norm2(view2->across));
}

/// Adds how far the residual is that of a lag. Only lengths are compared, so that the phase has no part in it; the mean of two samples'
/// difference times the step between them, so that noise has none either.
static void add_lag(jcal_hinge_alike_t *alike, const jcal_plane_t before[2], const jcal_plane_t now[2], float weight,
                    float dt_s)
{
    const float length = jcal_plane_norm(now[1]);
    const float length_before = jcal_plane_norm(before[1]);
    const float differ = (jcal_plane_norm(now[0]) + jcal_plane_norm(before[0])) - (length + length_before);
    const float rate = (length - length_before) / dt_s;
    alike->lag += 0.5f * weight * differ * rate;
    alike->change += weight * rate * rate;
}

void jcal_hinge_block_add(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, float constant_m_s2,
                          const jcal_hinge_sample_t *sample)
{
    jcal_hinge_block_t *const block = &self->block;
    const float bias_unit = cfg->gyr_bias_rad_s;
    const float units = sample->dt_s / JCAL_HINGE_UNIT_S;
    const float weight = units / (cfg->gyr_noise_rad_s * cfg->gyr_noise_rad_s);
    const jcal_hinge_view_t view1 = look(&self->point.axis1, sample->w1, &self->bias[0], bias_unit);
    const jcal_hinge_view_t view2 = look(&self->point.axis2, sample->w2, &self->bias[2], bias_unit);
    if (self->has_last) {
        const jcal_plane_t before[2] = {self->last1.across, self->last2.across};
        const jcal_plane_t now[2] = {view1.across, view2.across};
        add_lag(&self->alike, before, now, weight, sample->dt_s);
        carry_on(self, &view1, &view2, sample->dt_s);
    }
    self->last1 = view1;
    self->last2 = view2;
    self->has_last = true;
    const jcal_plane_t seen = jcal_plane_times(self->phase, view1.across);
    const jcal_plane_t seen_other = jcal_plane_times(block->turn_other, view1.across);
    const jcal_plane_t other = {view2.across.re, -view2.across.im}; /* axis 2 turned round turns v round */
    add_residual(self, seen, bias_unit, weight);
    add_acc_score(block, &self->point, constant_m_s2, sample);
    add_powers(self, weight);
    block->match = jcal_plane_add(block->match, weight, jcal_plane_against(seen, view2.across));
    block->match_other = jcal_plane_add(block->match_other, weight, jcal_plane_against(seen_other, other));
    block->power2 += weight * jcal_plane_norm2(view2.across);
    block->time_s += sample->dt_s;
}

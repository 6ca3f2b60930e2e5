/* SPDX-License-Identifier: MIT */
/// @file
/// The precise axes. See hinge/refine.h for the equations.
#include "hinge/refine.h"

#include "hinge/model.h"
#include "hinge/point.h"
#include "hinge/slip.h"
#include "jointcal/vec3.h"
#include "math/chol.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/solve.h"
#include "math/sym.h"

#include <math.h>

#define TILTS JCAL_HINGE_TILTS
#define UNKNOWNS JCAL_HINGE_UNKNOWNS
#define PHASE JCAL_HINGE_BLOCK_PHASE

/// Blocks last a tenth of the time covered, within these limits: soon enough of them at first, later longer than what
/// makes residuals alike. The first one only finds the phase.
#define BLOCK_MIN_S 0.2f
#define BLOCK_MAX_S 0.6f
#define BLOCK_SHARE 0.1f
#define BLOCK_FIRST_S 0.1f

/// A block whose phase is further off than this was linearised at the wrong phase, rad: only its phase is used.
#define PHASE_MAX 0.5f
/// Rate across the axis that says nothing of the phase, in units of the assumed noise power.
#define PHASE_FLOOR 0.5f
/// Share of what was known of the phase that counts in the next block.
#define PHASE_MEMORY 0.7f

/// Pull towards the minimum of the moments, as information: this, and this times the power of the residual over the number
/// of blocks. It holds the axes while there are few blocks, and the bounds allow for it.
#define PULL 10.0f
#define PULL_NOISE 6000.0f
/// The prior of the biases counts this many times the power of the residual, so that the estimate weighs it as the bounds do.
#define BIAS_PRIOR 2.0f
/// Damping of a step beside a unit diagonal: several times what rounding does to a pivot. Information about the unknowns may
/// differ by many powers of ten, and a combination of them may be open; each block brings another step.
#define DAMPING 2e-5f

/// A longer step of an axis than this means that its sums were linearised too far away, rad; it is cut at the second.
#define JUMP_RAD 0.06f
#define JUMP_MAX_RAD 0.15f
/// Where an axis has moved this far from where its sums began, or by this share of the angle at which a tilt makes up for
/// the whole rate across it, they give up half of what they know of it.
#define ANCHOR_RAD 0.05f
#define ANCHOR_REACH 0.5f
#define ANCHOR_SHARE 0.5f

/// An axis is known if the information about it is this many times the pull; cos 11.5 deg: the other one is where it was.
#define KNOWN_MIN 20.0f
#define SAME_COSINE 0.98f

/// What could match must be this many times the residual to count fully for the pairing.
#define SIGN_FLOOR 8.0f
/// Residual power below which nothing is believed, in units of the assumed noise power.
#define NOISE_MIN 0.01f

void jcal_hinge_refine_restart(jcal_hinge_refine_t *self, const jcal_hinge_point_t *point)
{
    const jcal_hinge_point_t at = *point; /* the caller may hand over self->point */
    *self = (jcal_hinge_refine_t){0};
    self->point = at;
    jcal_hinge_point_note(&self->point, self->anchor);
    self->phase.re = 1.0f;
    jcal_hinge_block_begin(&self->block);
}

/// True if the sums say more of an axis than the pull does.
static bool is_known(const jcal_hinge_refine_t *self, unsigned axis)
{
    const float about =
        self->matrix[jcal_sym_at(2u * axis, 2u * axis)] + self->matrix[jcal_sym_at((2u * axis) + 1u, (2u * axis) + 1u)];
    return about > (KNOWN_MIN * jcal_hinge_refine_pull(self));
}

void jcal_hinge_refine_go(jcal_hinge_refine_t *self, const jcal_hinge_point_t *point)
{
    jcal_hinge_axis_t *const axes[2] = {&self->point.axis1, &self->point.axis2};
    const jcal_vec3_t to[2] = {point->axis1.j, point->axis2.j};
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        const unsigned other = 1u - axis;
        const float same = jcal_vec3_dot(axes[other]->j, to[other]);
        if (is_known(self, other) && !is_known(self, axis) && (fabsf(same) > SAME_COSINE)) {
            jcal_hinge_axis_set(axes[axis], jcal_vec3_scale(to[axis], (same < 0.0f) ? -1.0f : 1.0f));
            jcal_hinge_point_note(&self->point, self->anchor);
            return;
        }
    }
    jcal_hinge_refine_restart(self, point);
}

void jcal_hinge_refine_interrupt(jcal_hinge_refine_t *self)
{
    self->has_last = false;
    self->phase_weight = 0.0f;
    jcal_hinge_block_begin(&self->block);
}

float jcal_hinge_refine_blocks(const jcal_hinge_refine_t *self)
{
    const float counted = (self->information * self->information) / jcal_max(self->information2, 1e-20f);
    return jcal_min(counted, 2.0f * self->blocks);
}

float jcal_hinge_refine_blocks_of(const jcal_hinge_refine_t *self, unsigned axis)
{
    return (self->told[axis] * self->told[axis]) / jcal_max(self->told2[axis], 1e-20f);
}

float jcal_hinge_refine_noise(const jcal_hinge_refine_t *self)
{
    return jcal_max(self->cost / jcal_max(2.0f * self->time_s / JCAL_HINGE_UNIT_S, 1e-9f), NOISE_MIN);
}

float jcal_hinge_refine_pull(const jcal_hinge_refine_t *self)
{
    return PULL + (PULL_NOISE * jcal_hinge_refine_noise(self) / jcal_max(self->blocks, 1.0f));
}

/// Tilts' part of a score less what the biases explain of it.
static void less_biases(const jcal_hinge_refine_t *self, const float score[UNKNOWNS], float out[TILTS])
{
    for (unsigned i = 0u; i < TILTS; ++i) {
        out[i] = score[i];
        for (unsigned k = 0u; k < TILTS; ++k) {
            out[i] -= self->gain[i][k] * score[TILTS + k];
        }
    }
}

/// How far the line of `to` lies from the axis, along u and v, for small angles.
static void offset(const jcal_hinge_axis_t *axis, jcal_vec3_t to, float out[2])
{
    const float sign = (jcal_vec3_dot(axis->j, to) < 0.0f) ? -1.0f : 1.0f;
    out[0] = sign * jcal_vec3_dot(to, axis->u);
    out[1] = sign * jcal_vec3_dot(to, jcal_hinge_v(axis));
}

/// Sums that were linearised far from where an axis is now say less of it.
static void give_up_what_is_far(jcal_hinge_refine_t *self, unsigned axis)
{
    const jcal_hinge_axis_t *const now = (axis == 0u) ? &self->point.axis1 : &self->point.axis2;
    float away[2];
    offset(now, jcal_hinge_noted(self->anchor[axis]), away);
    const float reach = ANCHOR_REACH * sqrtf(self->across / jcal_max(self->along[axis], 1e-20f));
    if (jcal_gn_length(away, 2u) > jcal_min(ANCHOR_RAD, reach)) {
        self->anchor[axis] = jcal_hinge_note(now->j);
        jcal_hinge_refine_forget(self, axis, ANCHOR_SHARE);
    }
}

/// Moves axes and biases by d, and all sums along: gradients by matrix d, the block's scores by their share of that.
static void move(jcal_hinge_refine_t *self, const float d[UNKNOWNS])
{
    float shift[UNKNOWNS];
    float each[TILTS];
    jcal_sym_times(self->matrix, UNKNOWNS, d, shift);
    less_biases(self, shift, each);
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        self->gradient[i] += shift[i];
    }
    const float per_information = 1.0f / jcal_max(self->information, 1e-20f);
    for (unsigned i = 0u; i < TILTS; ++i) {
        each[i] *= per_information;
    }
    for (unsigned i = 0u; i < TILTS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            self->scatter[jcal_sym_at(i, k)] +=
                (self->lean[i] * each[k]) + (each[i] * self->lean[k]) + (self->information2 * each[i] * each[k]);
        }
    }
    for (unsigned i = 0u; i < TILTS; ++i) {
        self->lean[i] += self->information2 * each[i];
        self->bias[i] += d[TILTS + i];
    }
    jcal_hinge_slip_move(&self->slip, d);
    jcal_hinge_point_move(&self->point, d);
    give_up_what_is_far(self, 0u);
    give_up_what_is_far(self, 1u);
}

/// gain <- H_tb H_bb^-1 from the whole matrix. False if that is singular.
static bool find_gain(jcal_hinge_refine_t *self, const float matrix[36])
{
    float biases[10];
    for (unsigned i = 0u; i < TILTS; ++i) {
        for (unsigned k = 0u; k <= i; ++k) {
            biases[jcal_sym_at(i, k)] = matrix[jcal_sym_at(TILTS + i, TILTS + k)];
        }
    }
    float scale[TILTS];
    if (!jcal_chol_factor_damped(biases, TILTS, DAMPING, scale)) {
        return false;
    }
    for (unsigned i = 0u; i < TILTS; ++i) {
        for (unsigned k = 0u; k < TILTS; ++k) {
            self->gain[i][k] = matrix[jcal_sym_at(TILTS + k, i)];
        }
        jcal_chol_solve_scaled(biases, TILTS, scale, self->gain[i]);
    }
    return true;
}

/// d <- the step to the minimum of these sums, the accelerometer part, the prior of the biases and the pull.
static bool find_step(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_coarse_t *coarse,
                      float d[UNKNOWNS])
{
    jcal_hinge_lin_t acc;
    jcal_hinge_linearise_acc(&coarse->moments, cfg, &self->point, &acc);
    float matrix[36];
    float away[TILTS];
    const float pull = jcal_hinge_refine_pull(self);
    const float prior = BIAS_PRIOR * jcal_hinge_refine_noise(self);
    offset(&self->point.axis1, coarse->point.axis1.j, &away[0]);
    offset(&self->point.axis2, coarse->point.axis2.j, &away[2]);
    for (unsigned i = 0u; i < JCAL_SYM_SIZE(UNKNOWNS); ++i) {
        matrix[i] = self->matrix[i] + ((i < JCAL_SYM_SIZE(TILTS)) ? acc.matrix[i] : 0.0f);
    }
    for (unsigned i = 0u; i < TILTS; ++i) {
        matrix[jcal_sym_at(i, i)] += pull;
        matrix[jcal_sym_at(TILTS + i, TILTS + i)] += prior;
        d[i] = (pull * away[i]) - (self->gradient[i] + acc.gradient[i]);
        d[TILTS + i] = -(self->gradient[TILTS + i] + (prior * self->bias[i]));
    }
    float scale[UNKNOWNS];
    if (!find_gain(self, matrix) || !jcal_chol_factor_damped(matrix, UNKNOWNS, DAMPING, scale)) {
        return false;
    }
    jcal_chol_solve_scaled(matrix, UNKNOWNS, scale, d);
    return true;
}

/// Goes to where the sums have their minimum; an axis that is far from it begins anew on the way there.
static void follow(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_coarse_t *coarse)
{
    float d[UNKNOWNS];
    if (!find_step(self, cfg, coarse, d)) {
        return;
    }
    bool jumps[2];
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        float *const of_axis = &d[2u * axis];
        const float length = jcal_gn_length(of_axis, 2u);
        jumps[axis] = length > JUMP_RAD;
        const float shorten = (length > JUMP_MAX_RAD) ? (JUMP_MAX_RAD / length) : 1.0f;
        of_axis[0] *= shorten;
        of_axis[1] *= shorten;
    }
    move(self, d);
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        if (jumps[axis] && is_known(self, axis)) {
            jcal_hinge_refine_forget(self, axis, 0.0f);
        }
    }
    if (!jcal_hinge_same_lines(&coarse->point, &self->point)) {
        jcal_hinge_refine_go(self, &coarse->point);
    }
}

/// Puts the phase right for the blocks that follow; `sure`: this block's sums were linearised near enough to it.
static void correct_phase(jcal_hinge_refine_t *self, bool sure)
{
    jcal_plane_t both = self->block.match;
    both.re += self->phase_weight;
    self->phase = jcal_plane_direction(jcal_plane_times(self->phase, jcal_plane_direction(both)));
    self->phase_weight = sure ? (PHASE_MEMORY * jcal_plane_norm(both)) : 0.0f;
}

/// Adds the block's sums with its phase eliminated; `reach` is the information about the phase.
static void add_block(jcal_hinge_refine_t *self, float reach)
{
    const jcal_hinge_block_t *const block = &self->block;
    const float *const of_phase = &block->matrix[JCAL_SYM_SIZE(PHASE)];
    float score[UNKNOWNS];
    float told[2] = {0.0f, 0.0f};
    for (unsigned i = 0u; i < UNKNOWNS; ++i) {
        const float share = of_phase[i] / reach;
        for (unsigned k = 0u; k <= i; ++k) {
            const float sum = block->matrix[jcal_sym_at(i, k)] - (share * of_phase[k]);
            self->matrix[jcal_sym_at(i, k)] += sum;
            if (i < TILTS) {
                self->slip.matrix[jcal_sym_at(i, k)] += sum;
                told[i / 2u] += (i == k) ? sum : 0.0f;
            }
        }
        score[i] = block->gradient[i] - (share * block->gradient[PHASE]);
        self->gradient[i] += score[i];
    }
    const float trace = told[0] + told[1];
    float tilts[TILTS];
    less_biases(self, score, tilts);
    for (unsigned i = 0u; i < TILTS; ++i) {
        self->slip.gradient[i] += tilts[i]; /* of the rates alone, like its matrix */
        tilts[i] += block->acc_score[i];
        self->lean[i] += trace * tilts[i];
    }
    jcal_sym_rank1(self->scatter, TILTS, tilts, 1.0f);
    self->slip.time_s += block->time_s;
    self->information += trace;
    self->information2 += trace * trace;
    for (unsigned axis = 0u; axis < 2u; ++axis) {
        self->told[axis] += told[axis];
        self->told2[axis] += told[axis] * told[axis];
    }
    self->blocks += 1.0f;
    self->joint += block->joint;
    self->time_s += block->time_s;
}

static void close_block(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_coarse_t *coarse)
{
    const jcal_hinge_block_t *const block = &self->block;
    const float units = block->time_s / JCAL_HINGE_UNIT_S;
    const float power1 = block->matrix[jcal_sym_at(PHASE, PHASE)];
    const float reach = power1 + (PHASE_FLOOR * units);
    const float strength = jcal_plane_norm(block->match);
    const float off = (block->match.re < 0.0f) ? strength : fabsf(block->match.im);
    const bool sure = off <= (PHASE_MAX * reach);
    if (sure) {
        const float power = power1 + block->power2;
        const float cost = jcal_max(power - (2.0f * strength), 0.0f);
        const float cost_other = jcal_max(power - (2.0f * jcal_plane_norm(block->match_other)), 0.0f);
        jcal_hinge_slip_fade(&self->slip, block->time_s);
        add_block(self, reach);
        self->cost += cost;
        self->alike.scale += 0.5f * (power1 - block->power2);
        self->slip.cost += cost;
        const float least = SIGN_FLOOR * jcal_hinge_refine_noise(self) * units;
        const float share = block->time_s / (power + least);
        self->same += share * cost;
        self->other += share * cost_other;
        self->sign_time_s += share * power;
    }
    correct_phase(self, sure);
    jcal_hinge_block_begin(&self->block);
    if (sure) {
        follow(self, cfg, coarse);
    } else if (!(self->blocks > 0.0f)) { /* nothing lost: the moments may know better by now */
        self->point = coarse->point;
    } else if (!jcal_hinge_same_lines(&coarse->point, &self->point)) {
        jcal_hinge_refine_go(self, &coarse->point); /* no block would ever be sure here */
    } else {
        /* the phase has been found again */
    }
}

bool jcal_hinge_refine_add(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_coarse_t *coarse,
                           const jcal_hinge_sample_t *sample)
{
    jcal_hinge_block_add(self, cfg, coarse->acc_constant_m_s2, sample);
    const float share_s = jcal_min(BLOCK_MAX_S, jcal_max(BLOCK_MIN_S, BLOCK_SHARE * self->time_s));
    const float length_s = (self->phase_weight > 0.0f) ? share_s : BLOCK_FIRST_S;
    const bool full = self->block.time_s >= (length_s - (0.5f * sample->dt_s));
    if (full) {
        close_block(self, cfg, coarse);
    }
    return full;
}

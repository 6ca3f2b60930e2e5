/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at the estimate of the joint centre. See center_sums.h.
#include "calib/center_sums.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <math.h>
#include <stddef.h>
#include <string.h>

#define N JCAL_CENTER_UNKNOWNS

/// Standard deviation of each component of r before any data, m.
#define REACH_M 1.0f
/// Standard deviation of a bias that is not estimated, m/s^2.
#define NO_BIAS 1e-4f

void jcal_center_sums_begin(jcal_center_sums_t *self, const jcal_center_place_t *place)
{
    (void)memset(self, 0, sizeof *self);
    self->point.place = *place;
    self->anchor = *place;
}

float jcal_center_variance(const jcal_center_config_t *cfg, const jcal_center_residual_t *residual)
{
    return (cfg->acc_noise_m_s2 * cfg->acc_noise_m_s2) + (cfg->turn_error * cfg->turn_error * residual->turn2);
}

/// Closes the block.
static void close_block(jcal_center_sums_t *self)
{
    jcal_sym_rank1(self->scatter, N, self->block, 1.0f);
    (void)memset(self->block, 0, sizeof self->block);
    self->block_s = 0.0f;
    self->blocks += 1.0f;
}

void jcal_center_sums_add(jcal_center_sums_t *self, const jcal_center_config_t *cfg,
                          const jcal_center_residual_t *residual, const jcal_kinematic_t *sample)
{
    const float dt_s = sample->dt_s;
    const float variance = jcal_center_variance(cfg, residual);
    const float readings = dt_s / JCAL_CENTER_READING_S;
    float weight = readings / variance;
    if (cfg->method == JCAL_CENTER_SA) {
        /* the sum of |e| has, where it is, the gradient of e^2 weighed by 1 / |e| */
        const float usual = sqrtf(variance);
        weight *= usual / jcal_max(usual, fabsf(residual->e));
    }
    jcal_sym_rank1(self->matrix, N, residual->row, weight);
    const float pull = weight * residual->e;
    for (size_t i = 0u; i < N; ++i) {
        const float g = pull * residual->row[i];
        self->gradient[i] += g;
        self->block[i] += g;
    }
    self->cost += pull * residual->e;
    self->effect += weight * residual->e_apart * residual->e_apart;
    self->noise += readings;
    self->time_s += dt_s;
    self->turn1 += dt_s * jcal_body_rate2(&sample->body1);
    self->turn2 += dt_s * jcal_body_rate2(&sample->body2);
    self->block_s += dt_s;
    if (self->block_s >= JCAL_CENTER_BLOCK_S) {
        close_block(self);
    }
}

void jcal_center_prior(const jcal_center_config_t *cfg, float *prior)
{
    const float bias = jcal_max(cfg->acc_bias_m_s2, NO_BIAS);
    for (size_t i = 0u; i < N; ++i) {
        prior[i] = (i < 6u) ? (1.0f / (REACH_M * REACH_M)) : (1.0f / (bias * bias));
    }
}

/// The unknowns as an array (12).
static void unknowns(const jcal_center_point_t *point, float *x)
{
    const jcal_vec3_t parts[4] = {point->place.r1, point->place.r2, point->b1, point->b2};
    for (size_t i = 0u; i < 4u; ++i) {
        x[3u * i] = parts[i].x;
        x[(3u * i) + 1u] = parts[i].y;
        x[(3u * i) + 2u] = parts[i].z;
    }
}

void jcal_center_sums_gradient(const jcal_center_sums_t *self, const float *prior, float *gradient)
{
    float x[N];
    unknowns(&self->point, x);
    for (size_t i = 0u; i < N; ++i) {
        gradient[i] = self->gradient[i] + (prior[i] * x[i]);
    }
}

static jcal_vec3_t moved(jcal_vec3_t v, const float *d)
{
    return jcal_vec3(v.x + d[0], v.y + d[1], v.z + d[2]);
}

void jcal_center_sums_move(jcal_center_sums_t *self, const float *d)
{
    float on[N]; /* H d: what each gradient changes by, in all */
    jcal_sym_times(self->matrix, N, d, on);
    const float per_block = (self->blocks > 0.0f) ? (1.0f / self->blocks) : 0.0f;
    const float open = (self->time_s > 0.0f) ? (self->block_s / self->time_s) : 0.0f;
    float closed[N]; /* sum of the gradients s of the closed blocks ... */
    float by[N];     /* ... and what it changes by */
    for (size_t i = 0u; i < N; ++i) {
        self->cost += d[i] * ((2.0f * self->gradient[i]) + on[i]);
        closed[i] = self->gradient[i] - self->block[i];
        by[i] = (1.0f - open) * on[i];
    }
    self->cost = jcal_max(self->cost, 0.0f);
    size_t k = 0u;
    for (size_t i = 0u; i < N; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            /* blocks taken to be alike: the sum of (s + by / n) (s + by / n)' */
            self->scatter[k] += per_block * ((closed[i] * by[j]) + (by[i] * closed[j]) + (by[i] * by[j]));
            ++k;
        }
    }
    for (size_t i = 0u; i < N; ++i) {
        self->gradient[i] += on[i];
        self->block[i] += open * on[i];
    }
    self->point.place.r1 = moved(self->point.place.r1, &d[0]);
    self->point.place.r2 = moved(self->point.place.r2, &d[3]);
    self->point.b1 = moved(self->point.b1, &d[6]);
    self->point.b2 = moved(self->point.b2, &d[9]);
}

void jcal_center_sums_halve(jcal_center_sums_t *self)
{
    jcal_sym_scale(self->matrix, N, 0.5f);
    jcal_sym_scale(self->scatter, N, 0.5f);
    for (size_t i = 0u; i < N; ++i) {
        self->gradient[i] *= 0.5f;
    }
    self->blocks *= 0.5f;
    self->cost *= 0.5f;
    self->effect *= 0.5f;
    self->noise *= 0.5f;
    self->time_s *= 0.5f;
    self->turn1 *= 0.5f;
    self->turn2 *= 0.5f;
}

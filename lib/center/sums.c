/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at the estimate of the joint centre. See center/sums.h.
#include "center/sums.h"

#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

#define N JCAL_CENTER_UNKNOWNS

/// Standard deviation of each component of r before any data, m.
#define REACH_M 0.3f
/// Standard deviation of a bias that is not estimated, m/s^2.
#define NO_BIAS 1e-4f
/// Standard deviation of a heading of which nothing is known, rad.
#define NO_HEADING_RAD 3.0f
/// A step that changes the cost by this many times its variance is more than what blocks can be moved by.
#define LARGE_STEP 50.0f
/// Samples after which what sensors' noise left in a residual is forgotten: the derivative's taps meet no more.
#define LAG 4u
/// Time of a reading without smoothing, s.
#define READING_S 0.1f

void jcal_center_sums_begin(jcal_center_sums_t *self, const jcal_center_place_t *place)
{
    jcal_clear(self, sizeof *self);
    self->point.place = *place;
    self->point.heading.re = 1.0f;
    self->anchor = *place;
}

void jcal_center_sums_begin_oriented(jcal_center_sums_t *self, const jcal_center_place_t *place, jcal_plane_t heading)
{
    jcal_center_sums_begin(self, place);
    self->point.heading = jcal_plane_direction(heading);
    self->point.is_oriented = true;
}

float jcal_center_reading_s(const jcal_center_config_t *cfg)
{
    return jcal_max(READING_S, 0.5f * cfg->kinematics.smoothing_s);
}

float jcal_center_variance(const jcal_center_config_t *cfg, const jcal_center_residual_t *residual)
{
    return (cfg->acc_noise_m_s2 * cfg->acc_noise_m_s2) + (cfg->turn_error * cfg->turn_error * residual->turn2);
}

void jcal_center_sums_add(jcal_center_sums_t *self, const jcal_center_config_t *cfg,
                          const jcal_center_residual_t *residual, float dt_s)
{
    const float variance = jcal_center_variance(cfg, residual);
    const float readings = dt_s / jcal_center_reading_s(cfg);
    float *const recent = self->recent[residual->part];
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
    self->weight += weight;
    self->raw += pull * residual->e;
    self->lagged += pull * recent[0];
    for (size_t i = 0u; i + 1u < LAG; ++i) {
        recent[i] = recent[i + 1u];
    }
    recent[LAG - 1u] = residual->e;
}

void jcal_center_sums_advance(jcal_center_sums_t *self, const jcal_kinematic_t *sample)
{
    const float dt_s = sample->dt_s;
    self->time_s += dt_s;
    self->turn1 += dt_s * sample->body1.rate2;
    self->turn2 += dt_s * sample->body2.rate2;
    self->block_s += dt_s;
}

bool jcal_center_sums_close(jcal_center_sums_t *self)
{
    if (self->block_s < JCAL_CENTER_BLOCK_S) {
        return false;
    }
    jcal_sym_rank1(self->scatter, N, self->block, 1.0f);
    for (size_t i = 0u; i < N; ++i) {
        self->closed[i] += self->block[i];
        self->block[i] = 0.0f;
    }
    self->block_s = 0.0f;
    self->blocks += 1.0f;
    return true;
}

/// The square of a residual over what is usual, no more than `most`.
static float ratio(const jcal_center_config_t *cfg, const jcal_center_residual_t *residual, float most)
{
    return jcal_min(residual->e * residual->e / jcal_center_variance(cfg, residual), most);
}

float jcal_center_sums_take(jcal_center_sums_t *self, const jcal_center_config_t *cfg, const jcal_kinematic_t *sample,
                            float most)
{
    jcal_center_residual_t residual;
    float square = 0.0f;
    if (self->point.is_oriented) {
        for (unsigned part = 0u; part < JCAL_CENTER_PARTS; ++part) {
            jcal_center_residual_oriented(sample, &self->point, part, &residual);
            square += ratio(cfg, &residual, most) / (float)JCAL_CENTER_PARTS;
            jcal_center_sums_add(self, cfg, &residual, sample->dt_s);
        }
    } else if (jcal_center_residual(sample, &self->point, &residual)) {
        square = ratio(cfg, &residual, most);
        jcal_center_sums_add(self, cfg, &residual, sample->dt_s);
    } else {
        return -1.0f;
    }
    jcal_center_sums_advance(self, sample);
    return square;
}

float jcal_center_excess(const jcal_center_sums_t *self)
{
    return jcal_max(self->cost / jcal_max(self->noise, FLT_MIN), 1.0f);
}

void jcal_center_prior(const jcal_center_sums_t *self, const jcal_center_config_t *cfg, float *prior)
{
    const bool is_oriented = cfg->method == JCAL_CENTER_LS;
    const float bias = is_oriented ? NO_BIAS : jcal_max(cfg->acc_bias_m_s2, NO_BIAS);
    const float excess = jcal_center_excess(self);
    for (size_t i = 0u; i < N; ++i) {
        prior[i] = excess / ((i < 6u) ? (REACH_M * REACH_M) : (bias * bias));
    }
    if (is_oriented) {
        prior[6] = excess / (NO_HEADING_RAD * NO_HEADING_RAD);
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

/// Moves the scatter's blocks, taken to be alike: by `on`, their share of what the whole gradient changes by.
static void move_blocks(jcal_center_sums_t *self, const float *on)
{
    const float share = self->blocks * JCAL_CENTER_BLOCK_S / jcal_max(self->time_s, JCAL_CENTER_BLOCK_S);
    const float each = share * share / self->blocks;
    const float mixed = share / self->blocks;
    size_t k = 0u;
    for (size_t i = 0u; i < N; ++i) {
        for (size_t j = 0u; j <= i; ++j) {
            /* the sum of (s + share on / n) (s + share on / n)', with sum of s = closed */
            self->scatter[k] +=
                (mixed * ((self->closed[i] * on[j]) + (on[i] * self->closed[j]))) + (each * on[i] * on[j]);
            ++k;
        }
    }
    for (size_t i = 0u; i < N; ++i) {
        self->closed[i] += share * on[i];
    }
}

/// Begins the scatter anew: its blocks do not fit the estimate any more.
static void begin_blocks(jcal_center_sums_t *self)
{
    jcal_clear(self->scatter, sizeof self->scatter);
    jcal_clear(self->closed, sizeof self->closed);
    jcal_clear(self->block, sizeof self->block);
    self->block_s = 0.0f;
    self->blocks = 0.0f;
}

void jcal_center_sums_move(jcal_center_sums_t *self, const float *d)
{
    float on[N]; /* H d: what the gradient changes by */
    jcal_sym_times(self->matrix, N, d, on);
    float gain = 0.0f; /* d' H d */
    for (size_t i = 0u; i < N; ++i) {
        self->cost += 2.0f * d[i] * self->gradient[i];
        gain += d[i] * on[i];
    }
    self->cost = jcal_max(self->cost + gain, 0.0f);
    if ((gain * self->noise) > (LARGE_STEP * jcal_max(self->cost, self->noise))) {
        begin_blocks(self);
    } else if (self->blocks > 0.0f) {
        move_blocks(self, on);
    } else {
        /* nothing to move */
    }
    const float open = self->block_s / jcal_max(self->time_s, FLT_MIN);
    for (size_t i = 0u; i < N; ++i) {
        self->gradient[i] += on[i];
        self->block[i] += open * on[i];
    }
    self->point.place.r1 = moved(self->point.place.r1, &d[0]);
    self->point.place.r2 = moved(self->point.place.r2, &d[3]);
    if (self->point.is_oriented) {
        self->point.heading = jcal_plane_direction(jcal_plane_times(self->point.heading, jcal_plane_turn(d[6])));
    } else {
        self->point.b1 = moved(self->point.b1, &d[6]);
        self->point.b2 = moved(self->point.b2, &d[9]);
    }
}

void jcal_center_sums_halve(jcal_center_sums_t *self)
{
    jcal_sym_scale(self->matrix, N, 0.5f);
    jcal_sym_scale(self->scatter, N, 0.5f);
    for (size_t i = 0u; i < N; ++i) {
        self->gradient[i] *= 0.5f;
        self->closed[i] *= 0.5f;
    }
    self->blocks *= 0.5f;
    self->cost *= 0.5f;
    self->effect *= 0.5f;
    self->noise *= 0.5f;
    self->weight *= 0.5f;
    self->raw *= 0.5f;
    self->lagged *= 0.5f;
    self->time_s *= 0.5f;
    self->turn1 *= 0.5f;
    self->turn2 *= 0.5f;
}

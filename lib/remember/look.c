/* SPDX-License-Identifier: MIT */
/// @file
/// A look at the sums of a remembered calibration. See remember/look.h; docs/METHOD_HUB.md, section 4.
#include "remember/look.h"

#include "math/chol_small.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "math/sym.h"
#include "remember/sums.h"

#include <math.h>
#include <stddef.h>

#define KINDS JCAL_REMEMBER_KINDS
#define TILTS 4u

/// Headings that are tried, and the turn from one to the next.
#define HEADINGS 24u
#define NEXT_RE 0.96592583f
#define NEXT_IM 0.25881905f
/// Newton steps for the heading, and the longest one, rad.
#define STEPS 3u
#define STEP_MAX_RAD 0.2f

/// Damping: share of the diagonal that is added to it.
#define TIES 0.005f
/// What is added to the diagonal besides, so that a block without rates can be solved.
#define RIDGE 1e-6f

/// How long a residual of each kind lasts, s: with 5 s of motion, of which a share of 0.16 never averages out, 4, 0.3 and 1 s more.
static const float LONG_S[KINDS] = {4.8f, 1.1f, 1.8f};
/// Least mean squares per direction: 4 deg, 1 % of the rate, 14 mm/s.
static const float LEAST[KINDS] = {4.8739e-3f, 1e-4f, 1.96e-4f};

/// How far kept levers may be off, m: what that leaves of the centre's motion is not held against them.
#define RIGID_LEVER_M 0.015f
#define FUNCTIONAL_LEVER_M 0.03f

/// Noise of the centre's velocity, squared, (m/s)^2, likewise.
#define SPEED_NOISE2 6e-4f

/// True if residuals of a kind count.
static bool counts(const jcal_remember_t *self, size_t kind)
{
    return (kind == JCAL_REMEMBER_LEVER) ? self->has_levers : self->has_axes;
}

static float score_of(const jcal_remember_t *self, jcal_plane_t heading, float pairing)
{
    const float half = 0.5f / self->block.motion_s;
    float cost[KINDS];
    float score = 0.0f;
    jcal_remember_costs(&self->block, heading, pairing, cost);
    for (size_t kind = 0u; kind < KINDS; ++kind) {
        if (counts(self, kind)) {
            const float ratio = jcal_max(half * cost[kind], LEAST[kind]) / LEAST[kind];
            score += (self->block.motion_s / LONG_S[kind]) * jcal_ln(ratio);
        }
    }
    return score;
}

/// The best score of all headings that are tried; `best` becomes its heading.
static float search(const jcal_remember_t *self, float pairing, jcal_plane_t *best)
{
    const jcal_plane_t next = {NEXT_RE, NEXT_IM};
    jcal_plane_t heading = {1.0f, 0.0f};
    float least = score_of(self, heading, pairing);
    *best = heading;
    for (unsigned i = 1u; i < HEADINGS; ++i) {
        heading = jcal_plane_times(heading, next);
        const float score = score_of(self, heading, pairing);
        if (score < least) {
            least = score;
            *best = heading;
        }
    }
    return least;
}

void jcal_remember_look_heading(jcal_remember_t *self)
{
    self->score = search(self, 1.0f, &self->heading);
}

void jcal_remember_look_pairing(jcal_remember_t *self)
{
    jcal_plane_t other;
    self->evidence = self->past.evidence + (0.5f * (search(self, -1.0f, &other) - self->score));
}

/// Weights of the kinds from their sums of squares over `motion_s`.
static void weigh(const jcal_remember_t *self, const float cost[KINDS], float motion_s, float weight[KINDS])
{
    for (size_t kind = 0u; kind < KINDS; ++kind) {
        const float size = jcal_max(cost[kind] / (2.0f * motion_s), LEAST[kind]);
        weight[kind] = counts(self, kind) ? (1.0f / (size * LONG_S[kind])) : 0.0f;
    }
}

static jcal_plane_t settle(const jcal_remember_t *self, jcal_plane_t heading)
{
    float cost[KINDS];
    float weight[KINDS];
    float slope[2];
    for (unsigned i = 0u; i < STEPS; ++i) {
        jcal_remember_costs(&self->block, heading, 1.0f, cost);
        weigh(self, cost, self->block.motion_s, weight);
        jcal_remember_slope(&self->block, heading, weight, slope);
        if (slope[1] > 0.0f) {
            const float step = jcal_max(-STEP_MAX_RAD, jcal_min(slope[0] / slope[1], STEP_MAX_RAD));
            heading = jcal_plane_times(heading, jcal_plane_turn(-step));
        }
    }
    return heading;
}

/// Root of the larger eigenvalue of (a b; b c).
static float widest(float a, float b, float c)
{
    const float half = 0.5f * (a - c);
    return sqrtf((0.5f * (a + c)) + sqrtf((half * half) + (b * b)));
}

/// How far the tilts want to go, and how well that is known; a right angle where it is not.
static void solve(jcal_remember_t *self, const jcal_remember_system_t *system)
{
    float factor[JCAL_SYM_SIZE(TILTS)];
    float d[TILTS];
    float inverse[TILTS][TILTS] = {{0.0f}};
    for (size_t i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        factor[i] = system->matrix[i] + self->past.matrix[i];
    }
    for (size_t i = 0u; i < TILTS; ++i) {
        factor[jcal_sym_at(i, i)] += (TIES * factor[jcal_sym_at(i, i)]) + RIDGE;
        d[i] = -(system->gradient[i] + self->past.gradient[i]);
        inverse[i][i] = 1.0f;
    }
    if (!jcal_chol4_factor(factor)) {
        self->off1_rad = 0.0f;
        self->off2_rad = 0.0f;
        self->sigma1_rad = JCAL_BOUND_UNKNOWN_RAD;
        self->sigma2_rad = JCAL_BOUND_UNKNOWN_RAD;
        return;
    }
    jcal_chol4_solve(factor, d);
    for (size_t i = 0u; i < TILTS; ++i) {
        jcal_chol4_solve(factor, inverse[i]);
    }
    self->off1_rad = sqrtf((d[0] * d[0]) + (d[1] * d[1]));
    self->off2_rad = sqrtf((d[2] * d[2]) + (d[3] * d[3]));
    self->sigma1_rad = widest(inverse[0][0], inverse[0][1], inverse[1][1]);
    self->sigma2_rad = widest(inverse[2][2], inverse[2][3], inverse[3][3]);
}

/// Variance of the angle of bending in the block, rad^2 s. The columns across the axis are turned against each other by that angle.
static float bend2_of(const jcal_remember_sums_t *block, jcal_plane_t heading)
{
    const jcal_plane_t mean = jcal_remember_bend(block, heading);
    return jcal_max(2.0f * (block->motion_s - jcal_plane_norm(mean)), 0.0f);
}

/// The open block becomes part of the past.
static void close(jcal_remember_t *self, const jcal_remember_system_t *system, const float cost[KINDS], float bend2)
{
    jcal_remember_past_t *const past = &self->past;
    for (size_t i = 0u; i < JCAL_SYM_SIZE(TILTS); ++i) {
        past->matrix[i] += system->matrix[i];
    }
    for (size_t i = 0u; i < TILTS; ++i) {
        past->gradient[i] += system->gradient[i];
    }
    for (size_t kind = 0u; kind < KINDS; ++kind) {
        past->cost[kind] = cost[kind];
    }
    past->gain += self->block.gain;
    past->power += self->block.power;
    past->motion_s += self->block.motion_s;
    past->bend2 += bend2;
    past->evidence = self->evidence;
    self->block = (jcal_remember_sums_t){0};
}

void jcal_remember_look_axes(jcal_remember_t *self, bool closes)
{
    const jcal_remember_sums_t *const block = &self->block;
    const jcal_plane_t heading = settle(self, self->heading);
    const float motion_s = self->past.motion_s + block->motion_s;
    const float power = self->past.power + block->power;
    float cost[KINDS];
    float weight[KINDS];
    jcal_remember_system_t system;
    const float bend2 = bend2_of(block, heading);
    jcal_remember_costs(block, heading, 1.0f, cost);
    for (size_t kind = 0u; kind < KINDS; ++kind) {
        cost[kind] += self->past.cost[kind];
    }
    weigh(self, cost, motion_s, weight);
    jcal_remember_system(block, heading, weight, &system);
    if (self->has_axes) {
        solve(self, &system);
    }
    const float lever = (self->kept.model == JCAL_MODEL_RIGID) ? RIGID_LEVER_M : FUNCTIONAL_LEVER_M;
    const float spare = lever * lever * (1.0f / 3.0f) * (self->past.gain + block->gain);
    const float noise = SPEED_NOISE2 * motion_s;
    self->lack = (power > 0.0f) ? (jcal_max(cost[JCAL_REMEMBER_LEVER] - spare - noise, 0.0f) / power) : 0.0f;
    self->speed_m_s = sqrtf(power / motion_s);
    self->bend_rad = sqrtf((self->past.bend2 + bend2) / motion_s);
    self->motion_s = motion_s;
    if (closes) {
        close(self, &system, cost, bend2);
    }
}

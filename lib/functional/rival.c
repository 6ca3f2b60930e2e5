/* SPDX-License-Identifier: MIT */
/// @file
/// The other pairing of signs. See functional/rival.h.
#include "functional/rival.h"

#include "functional/axes.h"
#include "functional/headings.h"
#include "functional/levers.h"
#include "functional/model.h"
#include "functional/sums.h"
#include "jointcal/vec3.h"
#include "levers/levers.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <float.h>

/// X of all headings turned by half a turn: vertical rows stay, the others change their sign.
static void half_turned(float *x, const float *up, size_t n)
{
    for (size_t i = 0u; i < n; ++i) {
        x[i] = (2.0f * up[i]) - x[i];
    }
}

/// X of the turn and rate residuals of the other pairing.
static void cross_other(const jcal_functional_t *self, jcal_functional_cross_t *x)
{
    jcal_functional_cross_turn(&self->sums, &self->point, x->turn);
    jcal_functional_cross_level(&self->sums, &self->point, x->rate);
    half_turned(x->turn, self->sums.turn_up, 9u);
    half_turned(x->rate, self->sums.rate_up, 9u);
}

static void begin(jcal_functional_t *self)
{
    jcal_functional_point_t *const other = &self->search.trial;
    jcal_copy(other, &self->point, sizeof *other);
    other->j2 = jcal_vec3_scale(other->j2, -1.0f);
    float x[16];
    jcal_levers_cross(&self->sums.levers, self->point.heading, x);
    half_turned(x, self->sums.levers.up, 16u);
    jcal_functional_levers(&self->sums, x, other);
}

static void step(jcal_functional_t *self)
{
    jcal_functional_point_t *const other = &self->search.trial;
    jcal_functional_cross_t x;
    jcal_functional_quadric_t h;
    cross_other(self, &x);
    jcal_functional_measure(&self->sums, &x, other);
    jcal_functional_quadric(&self->sums, &x, other, &h);
    jcal_functional_step_axes(&h, &other->j1, &other->j2);
    jcal_functional_measure(&self->sums, &x, other);
}

static void compare(jcal_functional_t *self)
{
    const jcal_functional_point_t *const other = &self->search.trial;
    jcal_functional_point_t level; /* the estimate without relative turns, as its rival is */
    jcal_copy(&level, &self->point, sizeof level);
    jcal_functional_cross_t x;
    jcal_functional_cross_turn(&self->sums, &level, x.turn);
    jcal_functional_cross_level(&self->sums, &level, x.rate);
    jcal_functional_measure(&self->sums, &x, &level);
    for (unsigned f = 0u; f < JCAL_FAMILIES; ++f) {
        const float odds = jcal_ln(other->size[f] / jcal_max(level.size[f], FLT_MIN));
        self->verdict.evidence[f] = jcal_functional_rows_per_s[f] * self->sums.motion_s * odds;
    }
    self->verdict.opposite = other->lack / jcal_max(self->sums.motion_s, FLT_MIN);
}

void jcal_functional_compare(jcal_functional_t *self, unsigned part)
{
    if (part == 0u) {
        begin(self);
    } else if (part < (JCAL_FUNCTIONAL_RIVAL_SLICES - 1u)) {
        step(self);
    } else {
        compare(self);
    }
}

void jcal_functional_turn_round(jcal_functional_t *self)
{
    const jcal_plane_t half = {-1.0f, 0.0f};
    self->point.j1 = self->search.trial.j1;
    self->point.j2 = self->search.trial.j2;
    jcal_functional_turn_all(&self->point, half);
    jcal_functional_sums_reverse(&self->sums);
}

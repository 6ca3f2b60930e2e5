/* SPDX-License-Identifier: MIT */
/// @file
/// Other headings. See functional/search.h.
#include "functional/search.h"

#include "functional/axes.h"
#include "functional/headings.h"
#include "functional/levers.h"
#include "functional/model.h"
#include "levers/levers.h"
#include "math/clear.h"
#include "math/plane.h"

/// Headings that are tried, 45 deg apart.
#define HEADINGS 8u

/// Logarithm of the odds that another solution must be ahead by before it is taken.
#define AHEAD 0.5f

/// Sizes that the residuals may have before anything is known: 8 deg, a tenth of the rates, 0.1 m/s.
#define TURN_GUESS 0.02f
#define RATE_GUESS 0.01f
#define LEVER_GUESS 0.01f

void jcal_functional_round(const jcal_functional_sums_t *sums, jcal_functional_point_t *point, unsigned part)
{
    if (part == 0u) {
        float x[16];
        jcal_levers_cross(&sums->levers, point->heading, x);
        jcal_functional_levers(sums, x, point);
    } else if (part == 1u) {
        jcal_functional_cross_t x;
        jcal_functional_quadric_t h;
        jcal_functional_cross(sums, point, &x);
        jcal_functional_measure(sums, &x, point);
        jcal_functional_quadric(sums, &x, point, &h);
        jcal_functional_step_axes(&h, &point->j1, &point->j2);
        jcal_functional_measure(sums, &x, point);
    } else {
        for (size_t b = 0u; b < JCAL_FUNCTIONAL_BLOCKS; ++b) {
            jcal_functional_find_heading(sums, point, b);
        }
    }
}

/// exp(i 45 deg k).
static jcal_plane_t eighth(unsigned k)
{
    static const float cosine[HEADINGS] = {1.0f,  0.70710678f,  0.0f, -0.70710678f,
                                           -1.0f, -0.70710678f, 0.0f, 0.70710678f};
    const jcal_plane_t out = {cosine[k % HEADINGS], cosine[(k + 6u) % HEADINGS]};
    return out;
}

/// A trial: the headings of the estimate turned, relative turns as they say, and the axes that are known least then.
static void begin(jcal_functional_search_t *self, const jcal_functional_sums_t *sums,
                  const jcal_functional_point_t *estimate)
{
    jcal_functional_point_t *const trial = &self->trial;
    jcal_copy(trial, estimate, sizeof *trial);
    jcal_functional_turn_all(trial, eighth(self->turn));
    trial->weight[JCAL_FAMILY_TURN] = 1.0f / TURN_GUESS;
    trial->weight[JCAL_FAMILY_RATE] = 1.0f / RATE_GUESS;
    trial->weight[JCAL_FAMILY_LEVER] = 1.0f / LEVER_GUESS;
    jcal_functional_cross_t x;
    jcal_functional_quadric_t h;
    jcal_functional_cross(sums, trial, &x);
    jcal_functional_quadric(sums, &x, trial, &h);
    if (!jcal_functional_open_axes(&h, self->turn / HEADINGS, &trial->j1, &trial->j2)) {
        (void)jcal_functional_open_axes(&h, 1u - (self->turn / HEADINGS), &trial->j1, &trial->j2);
    }
}

bool jcal_functional_try(jcal_functional_search_t *self, const jcal_functional_sums_t *sums,
                         jcal_functional_point_t *estimate, unsigned part)
{
    if (part == 0u) {
        begin(self, sums, estimate);
        return false;
    }
    jcal_functional_round(sums, &self->trial, (part - 1u) % JCAL_FUNCTIONAL_ROUND_SLICES);
    if (part < (JCAL_FUNCTIONAL_TRIAL_SLICES - 1u)) {
        return false;
    }
    /* Both energies are per second of motion: the sums may have grown since the estimate's was computed. */
    const float ahead = sums->motion_s * (estimate->energy - self->trial.energy);
    const bool is_better = !self->has_estimate || (ahead > AHEAD);
    if (is_better) {
        jcal_copy(estimate, &self->trial, sizeof *estimate);
        self->has_estimate = true;
    }
    self->turn = (uint8_t)((self->turn + 1u) % JCAL_FUNCTIONAL_TRIALS);
    self->tried = (uint8_t)((self->tried < UINT8_MAX) ? (self->tried + 1u) : UINT8_MAX);
    return is_better;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// The lag that leaves least. See pairing/lag_search.h.
#include "pairing/lag_search.h"

#include "levers/levers.h"
#include "math/plane.h"
#include "math/scalar.h"
#include "pairing/lag_sums.h"

#include <float.h>
#include <math.h>

/// Share of the mean diagonal that keeps levers in directions in which nothing turned at zero. It is more than what a polynomial between
/// nodes is wrong by (0.0005 on a rig's hinge): such a direction would have less than nothing, and the levers no solution.
#define RIDGE 1e-3f
/// Headings that are tried, 90 deg apart, rounds of each, and those with one more round of the best.
#define HEADINGS 4u
#define TRIAL_ROUNDS 2u
#define TRIALS (HEADINGS * TRIAL_ROUNDS)
#define TRIAL_SLICES (TRIALS + 1u)
/// Parabolas, their points, and rounds of each.
#define PASSES 3u
#define POINTS 3u
#define ROUNDS 2u
#define PASS_SLICES (POINTS * ROUNDS)
/// Distance of a parabola's points, and its longest step, nodes.
#define STEP_NODES 0.25f
#define STEP_MAX_NODES 0.5f
/// Nodes that are nearer than this are neighbours.
#define NEIGHBOUR_NODES 1.5f

#define SEARCH_END (JCAL_LAG_NODES * TRIAL_SLICES)

typedef char
    jcal_lag_search_has_so_many_slices[((SEARCH_END + (PASSES * PASS_SLICES)) == JCAL_LAG_SEARCH_SLICES) ? 1 : -1];

float jcal_lag_share(const jcal_lag_point_t *point)
{
    return point->lack / jcal_max(point->own, FLT_MIN);
}

float jcal_lag_rival(const jcal_lag_search_t *search, float lag)
{
    float least = 1.0f;
    for (int k = 0; k < JCAL_LAG_NODES; ++k) {
        if (fabsf((float)(k - JCAL_LAG_SIDE) - lag) > NEIGHBOUR_NODES) {
            least = jcal_min(least, search->least[k]);
        }
    }
    return least;
}

/// Levers for the heading, heading for the levers.
static void round_at(const jcal_lag_sums_t *sums, jcal_lag_point_t *point)
{
    jcal_lever_sums_t at;
    float x[16];
    const jcal_plane_t heading[JCAL_LEVER_BLOCKS] = {point->heading, {1.0f, 0.0f}}; /* block 1 is empty */
    jcal_lag_sums_at(sums, point->lag, &at);
    jcal_levers_cross(&at, heading, x);
    const jcal_levers_t found = jcal_levers_solve(&at, x, RIDGE);
    const jcal_plane_t pull = jcal_levers_pull(&at, 0u, found.r1, found.r2);
    point->lack = found.lack;
    point->own = found.own;
    if (jcal_plane_norm2(pull) > FLT_MIN) {
        const jcal_plane_t against = {pull.re, -pull.im};
        point->heading = jcal_plane_direction(against);
    }
}

/// One round of one of the headings of a node.
static void try_heading(jcal_lag_search_t *search, const jcal_lag_sums_t *sums, unsigned node, unsigned part)
{
    static const jcal_plane_t quarters[HEADINGS] = {{1.0f, 0.0f}, {0.0f, 1.0f}, {-1.0f, 0.0f}, {0.0f, -1.0f}};
    const unsigned number = part / TRIAL_ROUNDS;
    if ((part % TRIAL_ROUNDS) == 0u) {
        search->point.lag = (float)((int)node - JCAL_LAG_SIDE);
        search->point.heading = quarters[number];
    }
    round_at(sums, &search->point);
    const bool is_last = (part % TRIAL_ROUNDS) == (TRIAL_ROUNDS - 1u);
    if (is_last && ((number == 0u) || (jcal_lag_share(&search->point) < jcal_lag_share(&search->trial)))) {
        search->trial = search->point;
    }
}

/// Trials: all headings of a node, then those of the next.
static void try_node(jcal_lag_t *self)
{
    jcal_lag_search_t *const search = &self->search;
    const unsigned node = search->slice / TRIAL_SLICES;
    const unsigned part = search->slice % TRIAL_SLICES;
    if (part < TRIALS) {
        try_heading(search, &self->sums, node, part);
        return;
    }
    round_at(&self->sums, &search->trial);
    search->least[node] = jcal_lag_share(&search->trial);
    if ((node == 0u) || (search->least[node] < jcal_lag_share(&search->best))) {
        search->best = search->trial;
    }
}

static float clamped(float value, float limit)
{
    return jcal_max(jcal_min(value, limit), -limit);
}

/// The middle of the parabola goes to its least.
static void step(jcal_lag_search_t *search)
{
    const float middle = jcal_lag_share(&search->best);
    search->bend = (search->before - (2.0f * middle) + search->after) / (STEP_NODES * STEP_NODES);
    if (search->bend > 0.0f) {
        const float by = 0.5f * (search->before - search->after) / (STEP_NODES * search->bend);
        search->best.lag = clamped(search->best.lag + clamped(by, STEP_MAX_NODES), (float)JCAL_LAG_SIDE);
    }
}

/// The three lags of a parabola: middle, before, after.
static void refine(jcal_lag_search_t *search, const jcal_lag_sums_t *sums)
{
    static const float place[POINTS] = {0.0f, -STEP_NODES, STEP_NODES};
    const unsigned part = (search->slice - SEARCH_END) % PASS_SLICES;
    const unsigned number = part / ROUNDS;
    if ((part % ROUNDS) == 0u) {
        search->point = search->best;
        search->point.lag += place[number];
    }
    round_at(sums, &search->point);
    if ((part % ROUNDS) != (ROUNDS - 1u)) {
        return;
    }
    if (number == 0u) {
        search->best = search->point;
    } else if (number == 1u) {
        search->before = jcal_lag_share(&search->point);
    } else {
        search->after = jcal_lag_share(&search->point);
        step(search);
    }
}

bool jcal_lag_search(jcal_lag_t *self)
{
    jcal_lag_search_t *const search = &self->search;
    if (search->slice < SEARCH_END) {
        try_node(self);
    } else {
        refine(search, &self->sums);
    }
    search->slice = (uint8_t)(search->slice + 1u);
    if (search->slice < JCAL_LAG_SEARCH_SLICES) {
        return false;
    }
    search->slice = 0u;
    return true;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Multi-start search for the axes of a 2-DoF joint, in slices. See two_dof/search.h.
#include "two_dof/search.h"

#include "math/scalar.h"
#include "two_dof/model.h"
#include "two_dof/prior.h"
#include "two_dof/starts.h"
#include "two_dof/step.h"

/// So many starts are tried before the exchanged axes are once more.
#define EXCHANGE_EVERY 1u

/// First half of a linearisation: the rotation-based form.
static void first_half(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape,
                       const jcal_two_dof_point_t *point)
{
    jcal_two_dof_form(landscape->moments->rotation, point, &search->lin);
    search->half = true;
}

/// Second half: the data's cost, in units of what the residuals show, so that it can be compared with the prior.
static void second_half(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape,
                        const jcal_two_dof_point_t *point, float *parts)
{
    jcal_two_dof_lin_t *const lin = &search->lin;
    jcal_two_dof_combine(landscape->moments, landscape->constraint, point, lin, parts);
    const float scale = 1.0f / landscape->excess;
    lin->cost *= scale;
    for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        lin->gradient[i] *= scale;
    }
    jcal_sym_scale(lin->matrix, JCAL_TWO_DOF_UNKNOWNS, scale);
    search->half = false;
}

static void begin(jcal_two_dof_probe_t *probe, const jcal_two_dof_point_t *point)
{
    probe->point = *point;
    probe->from = *point;
    probe->predicted = 0.0f;
    probe->from_cost = 0.0f;
    probe->damping = JCAL_GN_DAMPING_START;
    probe->steps = 0u;
}

/// Makes a step from probe->point, where the cost is `lin`, prior included. Returns its length, rad.
static float make_step(jcal_two_dof_probe_t *probe, jcal_gn_t *gn, const jcal_two_dof_lin_t *lin, float *d)
{
    const jcal_gn_model_t model = {JCAL_TWO_DOF_UNKNOWNS, lin->gradient, lin->matrix};
    probe->from = probe->point;
    return jcal_two_dof_make_step(gn, &model, &probe->point, d, &probe->predicted);
}

/// Judges the probe's last step and makes the next one. Samples came in meanwhile: costs are compared per second of motion.
static float advance(jcal_two_dof_search_t *search, float moving_s)
{
    jcal_two_dof_probe_t *const probe = &search->probe;
    const jcal_two_dof_lin_t *const lin = &search->lin;
    jcal_gn_t gn = {probe->damping};
    const float change = 0.5f * (lin->cost - (probe->from_cost * moving_s));
    if ((probe->steps > 0u) && (probe->predicted < 0.0f)) {
        const bool kept = jcal_gn_judge(&gn, probe->predicted, change);
        if (!kept && (change > (JCAL_TWO_DOF_HARMLESS_SHARE * lin->cost))) {
            probe->damping = gn.damping;
            probe->point = probe->from;
            probe->predicted = 0.0f;
            return JCAL_TWO_DOF_STEP_MAX_RAD;
        }
        probe->damping = kept ? gn.damping : probe->damping;
    }
    gn.damping = probe->damping;
    float d[JCAL_TWO_DOF_UNKNOWNS];
    const float length = make_step(probe, &gn, lin, d);
    probe->damping = gn.damping;
    probe->from_cost = lin->cost / moving_s;
    return length;
}

/// Cost at a place, prior included.
static float cost_at(const jcal_two_dof_landscape_t *landscape, const jcal_two_dof_point_t *point)
{
    jcal_two_dof_guess_t guess = {point->heading, 0.0f};
    jcal_two_dof_costs(landscape->moments, landscape->constraint, point, &guess, 1u);
    return (guess.cost / landscape->excess) + jcal_two_dof_prior_cost(landscape->prior, point);
}

static void begin_probe(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape)
{
    search->probing = true;
    if (search->has_best && (search->since_exchange >= EXCHANGE_EVERY)) {
        search->since_exchange = 0u;
        search->exchanges = (uint8_t)((search->exchanges < UINT8_MAX) ? (search->exchanges + 1u) : UINT8_MAX);
        const jcal_orientation_pair_t *const pose = landscape->pose;
        const jcal_two_dof_point_t other = jcal_two_dof_exchanged(&search->best.point, pose->q1, pose->q2);
        begin(&search->probe, &other);
        return;
    }
    search->since_exchange = (uint8_t)(search->since_exchange + 1u);
    jcal_two_dof_guess_t guesses[JCAL_TWO_DOF_HEADINGS];
    float costs[JCAL_TWO_DOF_HEADINGS];
    for (unsigned i = 0u; i < JCAL_TWO_DOF_HEADINGS; ++i) {
        guesses[i].heading = jcal_two_dof_start_headings()[i];
    }
    jcal_two_dof_point_t point = jcal_two_dof_start(search->start);
    jcal_two_dof_costs(landscape->moments, landscape->constraint, &point, guesses, JCAL_TWO_DOF_HEADINGS);
    for (unsigned i = 0u; i < JCAL_TWO_DOF_HEADINGS; ++i) {
        costs[i] = guesses[i].cost;
    }
    point.heading = guesses[jcal_two_dof_least(costs)].heading;
    begin(&search->probe, &point);
    search->start = jcal_two_dof_start_after(search->start);
}

/// Makes a point the estimate.
static void adopt(jcal_two_dof_search_t *search, const jcal_two_dof_point_t *point, float cost)
{
    begin(&search->best, point);
    search->has_best = true;
    search->exchanges = 0u;
    search->cost = cost;
}

/// Files what a finished probe found: the estimate itself, a better minimum or a rival. Its cost is that of its last linearisation
/// and what its last step promised.
static jcal_two_dof_found_t file_probe(jcal_two_dof_search_t *search)
{
    const jcal_two_dof_point_t *const point = &search->probe.point;
    const float cost = search->lin.cost + (2.0f * search->probe.predicted);
    search->tried = (uint8_t)((search->tried < UINT8_MAX) ? (search->tried + 1u) : UINT8_MAX);
    search->probing = false;
    if (!search->has_best) {
        adopt(search, point, cost);
        return JCAL_TWO_DOF_ESTIMATE;
    }
    const bool better = cost < (search->cost - JCAL_TWO_DOF_BETTER);
    if (jcal_two_dof_is_near(&search->best.point, point, JCAL_TWO_DOF_SAME_COSINE)) {
        if (better) {
            jcal_two_dof_point_t aligned = *point; /* the senses stay: the mean of the sine goes with them */
            aligned.j1 = jcal_two_dof_in_sense_of(point->j1, search->best.point.j1);
            aligned.j2 = jcal_two_dof_in_sense_of(point->j2, search->best.point.j2);
            begin(&search->best, &aligned);
        }
    } else if (better) {
        search->rival = search->best.point;
        search->rival_cost = search->cost;
        search->has_rival = true;
        adopt(search, point, cost);
        return JCAL_TWO_DOF_ESTIMATE;
    } else if (!search->has_rival || (cost < search->rival_cost)) {
        search->rival = *point;
        search->rival_cost = cost;
        search->has_rival = true;
    } else {
        /* neither the best nor the second */
    }
    return JCAL_TWO_DOF_DONE;
}

/// True if the next steps would have to gain several times what the last one promised to come near the estimate's cost.
static bool is_hopeless(const jcal_two_dof_search_t *search)
{
    const float hoped = search->lin.cost + (JCAL_TWO_DOF_HOPE * 2.0f * search->probe.predicted);
    return search->has_best && (search->probe.steps >= JCAL_TWO_DOF_HOPELESS_STEPS) &&
           (hoped > (search->cost + JCAL_TWO_DOF_HOPELESS_GAP));
}

jcal_two_dof_found_t jcal_two_dof_probe(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape)
{
    const jcal_two_dof_point_t *const point = &search->probe.point;
    if (!search->probing) {
        begin_probe(search, landscape);
        return JCAL_TWO_DOF_DONE;
    }
    if (!search->half) {
        first_half(search, landscape, point);
        return JCAL_TWO_DOF_HALF_DONE;
    }
    second_half(search, landscape, point, NULL);
    jcal_two_dof_prior_apply(landscape->prior, point, &search->lin, &search->lin);
    const float length = advance(search, landscape->moving_s);
    search->probe.steps = (uint8_t)(search->probe.steps + 1u);
    const bool joined =
        search->has_best && jcal_two_dof_is_near(&search->best.point, point, JCAL_TWO_DOF_JOINED_COSINE);
    const bool ended = (length < JCAL_TWO_DOF_STEP_MIN_RAD) || (search->probe.steps >= JCAL_TWO_DOF_PROBE_STEPS) ||
                       is_hopeless(search);
    return (ended || joined) ? file_probe(search) : JCAL_TWO_DOF_DONE;
}

jcal_two_dof_found_t jcal_two_dof_track(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape)
{
    if (!search->half) {
        first_half(search, landscape, &search->best.point);
        return JCAL_TWO_DOF_HALF_DONE;
    }
    second_half(search, landscape, &search->best.point, search->parts);
    jcal_two_dof_lin_t all;
    jcal_two_dof_prior_apply(landscape->prior, &search->best.point, &search->lin, &all);
    jcal_gn_t gn = jcal_gn_begin();
    float d[JCAL_TWO_DOF_UNKNOWNS];
    (void)make_step(&search->best, &gn, &all, d);
    float on[JCAL_TWO_DOF_UNKNOWNS];
    jcal_sym_times(search->lin.matrix, JCAL_TWO_DOF_UNKNOWNS, d, on);
    for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        search->lin.gradient[i] += on[i]; /* to first order that at the new place */
    }
    search->cost = all.cost;
    return JCAL_TWO_DOF_DONE;
}

void jcal_two_dof_compare(jcal_two_dof_search_t *search, const jcal_two_dof_landscape_t *landscape)
{
    if (search->has_rival) {
        search->rival_cost = cost_at(landscape, &search->rival);
        search->has_rival = !jcal_two_dof_is_near(&search->best.point, &search->rival, JCAL_TWO_DOF_SAME_COSINE);
    }
}

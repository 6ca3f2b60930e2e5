/* SPDX-License-Identifier: MIT */
/// @file
/// Multi-start search for the axes of a 2-DoF joint, in slices. See two_dof_search.h.
#include "calib/two_dof_search.h"

#include "calib/two_dof_judge.h"
#include "calib/two_dof_model.h"
#include "calib/two_dof_prior.h"
#include "calib/two_dof_stream.h"
#include "jointcal/quat.h"
#include "math/scalar.h"
#include "math/solve.h"

#include <math.h>

/// Lines that starts are made of: the axes of the sensor frame and the diagonals of its cube, each for either sensor.
#define LINES 7u
#define STARTS (LINES * LINES)
/// Order of the starts: neighbours in time differ in both lines. No common factor with STARTS.
#define START_STRIDE 17u
/// Headings that a start chooses from.
#define HEADINGS 8u

/// So many starts are tried before the exchanged axes are once more.
#define EXCHANGE_EVERY 1u

/// A probe ends after so many steps, or when a step is shorter than this, rad.
#define PROBE_STEPS 14u
#define STEP_MIN_RAD 3e-3f
/// After so many steps a probe is given up, if several times the gain that it promises would leave it this far above the estimate.
#define HOPELESS_STEPS 3u
#define HOPE 4.0f
#define HOPELESS_GAP 100.0f
/// Longest step, rad: the model is worth nothing further away.
#define STEP_MAX_RAD 0.5f

/// A step that makes the cost larger by less than this share of it stands: samples that came in meanwhile did it.
#define HARMLESS_SHARE 0.02f

/// Minima closer than this are one, cos 5 deg; a probe that has come as close as this to the estimate has joined it, cos 2 deg.
#define SAME_COSINE 0.9962f
#define JOINED_COSINE 0.9994f

/// A new minimum must be better than the estimate by this much, in units of the cost's standard deviation.
#define BETTER 1.0f

/// Turns of the cycle.
enum { TURN_TRACK = 0, TURN_JUDGE = 1, TURN_FADE = 2, TURN_DRIFT = 3, TURN_RIVAL = 4, TURN_PROBE = 5, TURNS = 9 };

static jcal_vec3_t line_of(unsigned which)
{
    const float s = 0.57735027f;
    switch (which) {
    case 0u:
        return jcal_vec3(1.0f, 0.0f, 0.0f);
    case 1u:
        return jcal_vec3(0.0f, 1.0f, 0.0f);
    case 2u:
        return jcal_vec3(0.0f, 0.0f, 1.0f);
    case 3u:
        return jcal_vec3(s, s, s);
    case 4u:
        return jcal_vec3(-s, s, s);
    case 5u:
        return jcal_vec3(s, -s, s);
    default:
        return jcal_vec3(s, s, -s);
    }
}

static jcal_vec3_t turned_about_z(jcal_vec3_t v, jcal_plane_t turn)
{
    return jcal_vec3((turn.re * v.x) - (turn.im * v.y), (turn.im * v.x) + (turn.re * v.y), v.z);
}

static bool within(const jcal_two_dof_point_t *a, const jcal_two_dof_point_t *b, float cosine)
{
    const float heading = (a->heading.re * b->heading.re) + (a->heading.im * b->heading.im);
    return (fabsf(jcal_vec3_dot(a->j1, b->j1)) > cosine) && (fabsf(jcal_vec3_dot(a->j2, b->j2)) > cosine) &&
           (heading > cosine);
}

/// First half of a linearisation: the rotation-based form.
static void first_half(jcal_two_dof_t *self, const jcal_two_dof_point_t *point)
{
    jcal_two_dof_form(self->moments.rotation, point, &self->search.lin);
    self->search.half = true;
}

/// Second half: the data's cost, in units of what the residuals show, so that it can be compared with the prior.
static void second_half(jcal_two_dof_t *self, const jcal_two_dof_point_t *point, float *parts)
{
    jcal_two_dof_lin_t *const lin = &self->search.lin;
    jcal_two_dof_combine(&self->moments, self->cfg.constraint, point, lin, parts);
    const float scale = 1.0f / self->verdict.excess;
    lin->cost *= scale;
    for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        lin->gradient[i] *= scale;
    }
    jcal_sym_scale(lin->matrix, JCAL_TWO_DOF_UNKNOWNS, scale);
    self->search.half = false;
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
    probe->predicted = 0.0f;
    for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        d[i] = 0.0f;
    }
    if (jcal_gn_step(gn, &model, d, &probe->predicted) != JCAL_OK) {
        return STEP_MAX_RAD;
    }
    const float length = jcal_gn_length(d, JCAL_TWO_DOF_UNKNOWNS);
    if (length > STEP_MAX_RAD) {
        for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
            d[i] *= STEP_MAX_RAD / length;
        }
        probe->predicted = jcal_gn_predict(&model, d);
    }
    jcal_two_dof_point_move(&probe->point, d);
    return length;
}

/// Judges the probe's last step and makes the next one. Samples came in meanwhile: costs are compared per second of motion.
static float advance(jcal_two_dof_t *self)
{
    jcal_two_dof_probe_t *const probe = &self->search.probe;
    const jcal_two_dof_lin_t *const lin = &self->search.lin;
    jcal_gn_t gn = {probe->damping};
    const float change = 0.5f * (lin->cost - (probe->from_cost * self->moving_s));
    if ((probe->steps > 0u) && (probe->predicted < 0.0f)) {
        const bool kept = jcal_gn_judge(&gn, probe->predicted, change);
        if (!kept && (change > (HARMLESS_SHARE * lin->cost))) {
            probe->damping = gn.damping;
            probe->point = probe->from;
            probe->predicted = 0.0f;
            return STEP_MAX_RAD;
        }
        probe->damping = kept ? gn.damping : probe->damping;
    }
    gn.damping = probe->damping;
    float d[JCAL_TWO_DOF_UNKNOWNS];
    const float length = make_step(probe, &gn, lin, d);
    probe->damping = gn.damping;
    probe->from_cost = lin->cost / self->moving_s;
    return length;
}

/// Costs of the estimate and of the rival, prior included, at the same time.
static float cost_at(const jcal_two_dof_t *self, const jcal_two_dof_point_t *point)
{
    jcal_two_dof_guess_t guess = {point->heading, 0.0f};
    jcal_two_dof_costs(&self->moments, self->cfg.constraint, point, &guess, 1u);
    return (guess.cost / self->verdict.excess) + jcal_two_dof_prior_cost(&self->prior, point);
}

/// The estimate with the order of its axes exchanged, as the segments stand now: j1' = R1' D R2 j2, j2' = R2' D' R1 j1.
///
/// While one angle of the joint rests the other axis might as well be fixed to the other segment: the same motion, explained the
/// other way round. Starts all over the sphere find that minimum late.
static jcal_two_dof_point_t exchanged(const jcal_two_dof_t *self)
{
    const jcal_orientation_pair_t *const pair = &self->ring[(self->taken - 1u) % JCAL_TWO_DOF_RING];
    const jcal_two_dof_point_t *const best = &self->best.point;
    const jcal_vec3_t in1 = jcal_quat_rotate(pair->q1, best->j1);
    const jcal_vec3_t in2 = jcal_quat_rotate(pair->q2, best->j2);
    const jcal_plane_t back = {best->heading.re, -best->heading.im};
    const jcal_two_dof_point_t point = {
        jcal_quat_rotate(jcal_quat_conj(pair->q1), turned_about_z(in2, best->heading)),
        jcal_quat_rotate(jcal_quat_conj(pair->q2), turned_about_z(in1, back)),
        best->heading,
    };
    return point;
}

static void begin_probe(jcal_two_dof_t *self)
{
    jcal_two_dof_search_t *const search = &self->search;
    jcal_two_dof_guess_t guesses[HEADINGS] = {{{1.0f, 0.0f}, 0.0f},  {{0.70710678f, 0.70710678f}, 0.0f},
                                              {{0.0f, 1.0f}, 0.0f},  {{-0.70710678f, 0.70710678f}, 0.0f},
                                              {{-1.0f, 0.0f}, 0.0f}, {{-0.70710678f, -0.70710678f}, 0.0f},
                                              {{0.0f, -1.0f}, 0.0f}, {{0.70710678f, -0.70710678f}, 0.0f}};
    if (self->has_best && (search->since_exchange >= EXCHANGE_EVERY)) {
        search->since_exchange = 0u;
        search->exchanges = (uint8_t)((search->exchanges < UINT8_MAX) ? (search->exchanges + 1u) : UINT8_MAX);
        const jcal_two_dof_point_t other = exchanged(self);
        begin(&search->probe, &other);
        search->probing = true;
        return;
    }
    search->since_exchange = (uint8_t)(search->since_exchange + 1u);
    jcal_two_dof_point_t point = {line_of(search->start / LINES), line_of(search->start % LINES), guesses[0].heading};
    jcal_two_dof_costs(&self->moments, self->cfg.constraint, &point, guesses, HEADINGS);
    unsigned least = 0u;
    for (unsigned i = 1u; i < HEADINGS; ++i) {
        least = (guesses[i].cost < guesses[least].cost) ? i : least;
    }
    point.heading = guesses[least].heading;
    begin(&search->probe, &point);
    search->start = (uint8_t)((search->start + START_STRIDE) % STARTS);
    search->probing = true;
}

/// The line of `axis` in the sense of `like`.
static jcal_vec3_t align(jcal_vec3_t axis, jcal_vec3_t like)
{
    return (jcal_vec3_dot(axis, like) < 0.0f) ? jcal_vec3_scale(axis, -1.0f) : axis;
}

/// Makes a point the estimate. If the one before it was ready, the joint is another one now.
static void adopt(jcal_two_dof_t *self, const jcal_two_dof_point_t *point)
{
    if (self->watch.on) {
        jcal_two_dof_begin_anew(self, JCAL_MOVED);
        return;
    }
    begin(&self->best, point);
    self->has_best = true;
    self->heading_then = (jcal_plane_t){0.0f, 0.0f};
    self->drift_rad_s = 0.0f;
    self->search.agreed = 0u;
    self->search.exchanges = 0u;
    if (self->verdict.status != (uint8_t)JCAL_MOVED) {
        self->verdict.status = (uint8_t)JCAL_COLLECTING;
    }
    self->verdict.reason = (uint8_t)JCAL_REASON_UNCERTAIN;
}

/// Files what a finished probe found: the estimate itself, a better minimum or a rival. Its cost is that of its last linearisation
/// and what its last step promised.
static void file_probe(jcal_two_dof_t *self)
{
    jcal_two_dof_search_t *const search = &self->search;
    const jcal_two_dof_point_t *const point = &search->probe.point;
    const float cost = search->lin.cost + (2.0f * search->probe.predicted);
    search->tried = (uint8_t)((search->tried < UINT8_MAX) ? (search->tried + 1u) : UINT8_MAX);
    search->probing = false;
    if (!self->has_best) {
        adopt(self, point);
        search->cost = cost;
        return;
    }
    const bool better = cost < (search->cost - BETTER);
    if (within(&self->best.point, point, SAME_COSINE)) {
        if (better) {
            jcal_two_dof_point_t aligned = *point; /* the senses stay: the mean of the sine goes with them */
            aligned.j1 = align(point->j1, self->best.point.j1);
            aligned.j2 = align(point->j2, self->best.point.j2);
            begin(&self->best, &aligned);
        }
    } else if (better) {
        const jcal_two_dof_point_t rival = self->best.point;
        const float rival_cost = search->cost;
        adopt(self, point);
        search->rival = rival;
        search->rival_cost = rival_cost;
        search->has_rival = self->has_best;
        search->cost = cost;
    } else if (!search->has_rival || (cost < search->rival_cost)) {
        search->rival = *point;
        search->rival_cost = cost;
        search->has_rival = true;
    } else {
        /* neither the best nor the second */
    }
}

/// True if the next steps would have to gain several times what the last one promised to come near the estimate's cost.
static bool is_hopeless(const jcal_two_dof_t *self)
{
    const jcal_two_dof_search_t *const search = &self->search;
    const float hoped = search->lin.cost + (HOPE * 2.0f * search->probe.predicted);
    return self->has_best && (search->probe.steps >= HOPELESS_STEPS) && (hoped > (search->cost + HOPELESS_GAP));
}

static void probe(jcal_two_dof_t *self)
{
    jcal_two_dof_search_t *const search = &self->search;
    jcal_two_dof_point_t *const point = &search->probe.point;
    if (!search->probing) {
        begin_probe(self);
    } else if (!search->half) {
        first_half(self, point);
        return;
    } else {
        second_half(self, point, NULL);
        jcal_two_dof_prior_apply(&self->prior, point, &search->lin, &search->lin);
        const float length = advance(self);
        search->probe.steps = (uint8_t)(search->probe.steps + 1u);
        const bool ended = (length < STEP_MIN_RAD) || (search->probe.steps >= PROBE_STEPS) || is_hopeless(self);
        if (ended || (self->has_best && within(&self->best.point, point, JOINED_COSINE))) {
            file_probe(self);
        }
    }
    search->turn = (uint8_t)((search->turn + 1u) % TURNS);
}

static void track(jcal_two_dof_t *self)
{
    jcal_two_dof_search_t *const search = &self->search;
    if (!search->half) {
        first_half(self, &self->best.point);
        return;
    }
    second_half(self, &self->best.point, search->parts);
    jcal_two_dof_lin_t all;
    jcal_two_dof_prior_apply(&self->prior, &self->best.point, &search->lin, &all);
    jcal_gn_t gn = jcal_gn_begin();
    float d[JCAL_TWO_DOF_UNKNOWNS];
    (void)make_step(&self->best, &gn, &all, d);
    float on[JCAL_TWO_DOF_UNKNOWNS];
    jcal_sym_times(search->lin.matrix, JCAL_TWO_DOF_UNKNOWNS, d, on);
    for (unsigned i = 0u; i < JCAL_TWO_DOF_UNKNOWNS; ++i) {
        search->lin.gradient[i] += on[i]; /* to first order that at the new place */
    }
    search->cost = all.cost;
    search->turn = TURN_JUDGE;
}

void jcal_two_dof_work(jcal_two_dof_t *self)
{
    jcal_two_dof_search_t *const search = &self->search;
    if (!(self->moving_s > 0.0f)) {
        return;
    }
    if (!self->has_best && (search->turn < TURN_PROBE)) {
        search->turn = TURN_PROBE;
    }
    switch (search->turn) {
    case TURN_TRACK:
        track(self);
        break;
    case TURN_JUDGE:
        jcal_two_dof_judge(self);
        search->turn = jcal_two_dof_fade_is_due(self) ? TURN_FADE : TURN_RIVAL;
        break;
    case TURN_FADE:
        jcal_two_dof_fade_now(self);
        search->turn = TURN_DRIFT;
        break;
    case TURN_DRIFT:
        jcal_two_dof_follow_drift(self);
        search->turn = TURN_RIVAL;
        break;
    case TURN_RIVAL:
        if (search->has_rival) {
            search->rival_cost = cost_at(self, &search->rival);
            search->has_rival = !within(&self->best.point, &search->rival, SAME_COSINE);
        }
        search->turn = TURN_PROBE;
        break;
    default:
        probe(self);
        break;
    }
}

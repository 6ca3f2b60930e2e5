/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum of the moments and looks for others. See hinge/search.h.
#include "hinge/search.h"

#include "hinge/model.h"
#include "hinge/point.h"
#include "hinge/refine.h"
#include "math/eig.h"
#include "math/scalar.h"
#include "math/solve.h"
#include "math/sym.h"

#include <math.h>

/// Starts of one round: 3 x 3 eigenvectors, and the estimate with axis 2 turned round.
#define EIGEN_STARTS 9u
#define STARTS 10u
/// Steps of a probe.
#define PROBE_STEPS 5u

/// A change of cost too small to matter, in units of one independent reading; rounding may make a good step look
/// worse by it.
#define HARMLESS_COST 0.01f
/// Damping never grows beyond this: the sums change with every sample, so a step that was refused may be right soon.
#define DAMPING_MAX 1.0f

/// A longer step than this says that the model behind it does not reach so far, rad.
#define STEP_MAX_RAD 0.35f
/// A shorter step than this means that the probe has arrived, rad.
#define STEP_MIN_RAD 0.002f
/// cos 3 deg: a probe this near to the estimate, in the same pairing, will end there.
#define JOINED_COSINE 0.99863f

/// A damped step d. False if there is none.
static bool step(const jcal_hinge_lin_t *lin, float *damping, float d[JCAL_HINGE_TILTS], float *predicted)
{
    const jcal_gn_model_t model = {JCAL_HINGE_TILTS, lin->gradient, lin->matrix};
    jcal_gn_t gn = {*damping};
    const jcal_status_t status = jcal_gn_step(&gn, &model, d, NULL);
    *damping = gn.damping;
    if (status != JCAL_OK) {
        return false;
    }
    float longest = 0.0f;
    for (size_t i = 0u; i < JCAL_HINGE_TILTS; ++i) {
        longest = jcal_max(fabsf(d[i]), longest);
    }
    const float shorten = (longest > STEP_MAX_RAD) ? (STEP_MAX_RAD / longest) : 1.0f;
    for (size_t i = 0u; i < JCAL_HINGE_TILTS; ++i) {
        d[i] *= shorten;
    }
    *predicted = jcal_gn_predict(&model, d);
    return true;
}

/// Moves a point by one step if that lowers the cost; returns the length of the step, rad.
static float descend(const jcal_hinge_t *self, jcal_hinge_point_t *point, float *damping)
{
    jcal_hinge_lin_t lin;
    float d[JCAL_HINGE_TILTS];
    float predicted;
    jcal_hinge_linearise(&self->moments, &self->cfg, point, &lin);
    if (!step(&lin, damping, d, &predicted)) {
        return STEP_MAX_RAD;
    }
    jcal_hinge_point_t trial = *point;
    jcal_hinge_point_move(&trial, d);
    const float change = 0.5f * jcal_hinge_change(&self->moments, &self->cfg, point, &trial);
    jcal_gn_t gn = {*damping};
    const bool kept = jcal_gn_judge(&gn, predicted, change);
    if (kept || (fabsf(change) < HARMLESS_COST)) {
        *point = trial;
    }
    *damping = jcal_min(gn.damping, kept ? JCAL_GN_DAMPING_MAX : DAMPING_MAX);
    return jcal_gn_length(d, JCAL_HINGE_TILTS);
}

void jcal_hinge_track(jcal_hinge_t *self)
{
    if (!self->has_point) {
        return;
    }
    (void)descend(self, &self->point, &self->damping);
    self->acc_constant_m_s2 = jcal_hinge_acc_constant(&self->moments, &self->cfg, &self->refine.point);
}

/// Eigenvector `which` of the weighted sum of |w|^2 w w' of the sensor whose products begin at `first`.
static jcal_vec3_t rate_eigenvector(const jcal_hinge_moments_t *moments, unsigned first, unsigned which)
{
    float sums[6]; /* xx, yy, zz, xy, xz, yz */
    for (unsigned i = 0u; i < 6u; ++i) {
        sums[i] = moments->gyr[jcal_sym_at(first, first + i)] + moments->gyr[jcal_sym_at(first + 1u, first + i)] +
                  moments->gyr[jcal_sym_at(first + 2u, first + i)];
    }
    const float packed[6] = {sums[0], sums[3], sums[1], sums[4], sums[5], sums[2]}; /* lower triangle */
    float values[3];
    float vectors[9];
    if (jcal_eig_symmetric(packed, 3u, values, vectors) != JCAL_OK) {
        return jcal_vec3((which == 0u) ? 1.0f : 0.0f, (which == 1u) ? 1.0f : 0.0f, (which == 2u) ? 1.0f : 0.0f);
    }
    const float *const v = &vectors[3u * which];
    return jcal_vec3_normalise(jcal_vec3(v[0], v[1], v[2]));
}

static jcal_hinge_point_t point_at(const jcal_hinge_place_t *place)
{
    jcal_hinge_point_t point = {{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}, {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}};
    jcal_hinge_point_set(&point, place->j1, place->j2);
    return point;
}

static jcal_hinge_place_t place_of(const jcal_hinge_point_t *point)
{
    const jcal_hinge_place_t place = {point->axis1.j, point->axis2.j};
    return place;
}

static float cost_of(const jcal_hinge_t *self, const jcal_hinge_point_t *point)
{
    return jcal_hinge_cost(&self->moments, &self->cfg, point);
}

float jcal_hinge_cost_of_rival(const jcal_hinge_t *self)
{
    const jcal_hinge_point_t rival = point_at(&self->search.rival);
    return cost_of(self, &rival);
}

jcal_hinge_point_t jcal_hinge_flipped(const jcal_hinge_t *self)
{
    jcal_hinge_point_t flip = self->point;
    if (self->search.has_flip) {
        jcal_hinge_point_set(&flip, self->search.flip.j1, self->search.flip.j2);
    } else { /* it has no minimum near these lines; one elsewhere is a rival */
        jcal_hinge_axis_set(&flip.axis2, jcal_vec3_scale(flip.axis2.j, -1.0f));
    }
    return flip;
}

/// The pairing of these lines that the specific forces prefer: (24) knows none.
static void choose_pairing(const jcal_hinge_t *self, jcal_hinge_point_t *point)
{
    jcal_hinge_point_t turned = *point;
    jcal_hinge_axis_set(&turned.axis2, jcal_vec3_scale(point->axis2.j, -1.0f));
    const float here = jcal_hinge_cost_acc(&self->moments, &self->cfg, point);
    if (jcal_hinge_cost_acc(&self->moments, &self->cfg, &turned) < here) {
        *point = turned;
    }
}

static void begin_probe(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    const unsigned start = search->start;
    jcal_hinge_point_t probe = self->point;
    if (start < EIGEN_STARTS) {
        jcal_hinge_point_set(&probe, rate_eigenvector(&self->moments, JCAL_HINGE_Z_W1W1, start / 3u),
                             rate_eigenvector(&self->moments, JCAL_HINGE_Z_W2W2, start % 3u));
        choose_pairing(self, &probe);
    } else {
        jcal_hinge_axis_set(&probe.axis2, jcal_vec3_scale(probe.axis2.j, -1.0f));
    }
    search->probe = place_of(&probe);
    search->damping = JCAL_GN_DAMPING_START;
    search->iterations = 0u;
    search->running = true;
}

/// What was judged was the old minimum.
static void begin_anew(jcal_hinge_t *self, const jcal_hinge_point_t *point)
{
    self->point = *point;
    self->damping = JCAL_GN_DAMPING_START;
    self->has_point = true;
    self->agreed = 0u;
    self->verdict.status = (uint8_t)JCAL_COLLECTING;
    self->verdict.reason = (uint8_t)JCAL_REASON_NO_DATA;
    jcal_hinge_refine_go(&self->refine, point);
}

/// Another minimum is better: it becomes the estimate, and the old one the rival.
static void adopt(jcal_hinge_t *self, const jcal_hinge_point_t *probe)
{
    jcal_hinge_search_t *const search = &self->search;
    if (self->has_point) {
        search->rival = place_of(&self->point);
        search->has_rival = true;
        search->has_flip = false;
    }
    begin_anew(self, probe);
}

void jcal_hinge_turn_round(jcal_hinge_t *self)
{
    const jcal_hinge_point_t flip = jcal_hinge_flipped(self);
    self->search.flip = place_of(&self->point);
    self->search.has_flip = true;
    begin_anew(self, &flip);
}

/// True if the probe runs into the estimate, so that its further steps would tell nothing.
static bool has_joined(const jcal_hinge_t *self, const jcal_hinge_point_t *probe)
{
    return self->has_point && (fabsf(jcal_vec3_dot(self->point.axis1.j, probe->axis1.j)) > JOINED_COSINE) &&
           (fabsf(jcal_vec3_dot(self->point.axis2.j, probe->axis2.j)) > JOINED_COSINE) &&
           jcal_hinge_same_pairing(&self->point, probe);
}

/// Files what a finished probe found: the estimate itself, a better minimum, the other pairing, or a rival.
static void file_probe(jcal_hinge_t *self, const jcal_hinge_point_t *probe)
{
    jcal_hinge_search_t *const search = &self->search;
    if (!self->has_point) {
        adopt(self, probe);
        return;
    }
    const float cost = cost_of(self, probe);
    const bool better = cost < cost_of(self, &self->point);
    if (!jcal_hinge_same_lines(&self->point, probe)) {
        if (better) {
            adopt(self, probe);
        } else if (!search->has_rival || (cost < jcal_hinge_cost_of_rival(self))) {
            search->rival = place_of(probe);
            search->has_rival = true;
        } else {
            /* neither the best nor the second */
        }
    } else if (!jcal_hinge_same_pairing(&self->point, probe)) {
        search->flip = place_of(probe);
        search->has_flip = true;
        /* Later on the judgement decides, which knows what the rates say of the pairing. */
        if (better && !(self->refine.blocks > 0.0f) && (self->cfg.sign_hint == JCAL_SIGN_UNKNOWN)) {
            jcal_hinge_turn_round(self);
        }
    } else if (better && !has_joined(self, probe)) {
        self->point = *probe; /* a better place close by */
        self->damping = JCAL_GN_DAMPING_START;
    } else {
        /* the estimate itself */
    }
}

void jcal_hinge_search(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    if (!search->running) {
        begin_probe(self);
        return;
    }
    jcal_hinge_point_t probe = point_at(&search->probe);
    const float length = descend(self, &probe, &search->damping);
    search->probe = place_of(&probe);
    search->iterations = (uint8_t)(search->iterations + 1u);
    const bool ended = (length < STEP_MIN_RAD) || (search->iterations >= PROBE_STEPS);
    if (!ended && !has_joined(self, &probe)) {
        return;
    }
    search->running = false;
    search->start = (uint8_t)(search->start + 1u);
    jcal_hinge_obey(&probe, self->cfg.sign_hint);
    file_probe(self, &probe);
    if (search->start >= STARTS) {
        search->start = 0u;
        const bool counts = (self->excitation > 0.0f) && (search->rounds < UINT8_MAX);
        search->rounds = counts ? (uint8_t)(search->rounds + 1u) : search->rounds;
    }
}

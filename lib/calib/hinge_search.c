/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum and looks for others. See hinge_search.h.
#include "calib/hinge_search.h"

#include "calib/hinge_evidence.h"
#include "calib/hinge_model.h"
#include "calib/hinge_point.h"
#include "math/eig.h"
#include "math/scalar.h"
#include "math/solve.h"
#include "math/sym.h"

#include <math.h>

/// Starts of one round: 3 x 3 eigenvectors, both pairings, and the estimate with axis 2 turned round.
#define EIGEN_STARTS 18u
#define STARTS 19u
/// Steps of a probe with the biases of the estimate, and then with biases of its own.
#define PROBE_STEPS 5u
#define REFINE_STEPS 2u

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

/// Scales the unknowns first .. last - 1 by one over the root of their largest diagonal element.
static float group_scale(const float *matrix, size_t first, size_t last)
{
    float largest = 0.0f;
    for (size_t i = first; i < last; ++i) {
        largest = jcal_max(matrix[jcal_sym_at(i, i)], largest);
    }
    return (largest > 0.0f) ? (1.0f / sqrtf(largest)) : 1.0f;
}

/// A damped step d (8) over the first n unknowns, axes and biases each brought to a common scale. False if there is
/// none.
static bool step(const jcal_hinge_lin_t *lin, size_t n, float *damping, float d[8], float *predicted)
{
    const float scales[2] = {group_scale(lin->matrix, 0u, 4u), (n > 4u) ? group_scale(lin->matrix, 4u, 8u) : 0.0f};
    float gradient[JCAL_HINGE_UNKNOWNS];
    float matrix[36];
    float scaled[JCAL_HINGE_UNKNOWNS] = {0.0f};
    for (size_t i = 0u; i < n; ++i) {
        gradient[i] = lin->gradient[i] * scales[i / 4u];
        for (size_t k = 0u; k <= i; ++k) {
            matrix[jcal_sym_at(i, k)] = lin->matrix[jcal_sym_at(i, k)] * scales[i / 4u] * scales[k / 4u];
        }
    }
    const jcal_gn_model_t model = {n, gradient, matrix};
    jcal_gn_t gn = {*damping};
    const jcal_status_t status = jcal_gn_step(&gn, &model, scaled, NULL);
    *damping = gn.damping;
    if (status != JCAL_OK) {
        return false;
    }
    float longest = 0.0f;
    for (size_t i = 0u; i < 4u; ++i) {
        longest = jcal_max(fabsf(scaled[i]) * scales[0], longest);
    }
    const float shorten = (longest > STEP_MAX_RAD) ? (STEP_MAX_RAD / longest) : 1.0f;
    for (size_t i = 0u; i < JCAL_HINGE_UNKNOWNS; ++i) {
        scaled[i] *= shorten;
        d[i] = scaled[i] * scales[i / 4u];
    }
    *predicted = jcal_gn_predict(&model, scaled);
    return true;
}

/// Moves a point by one step over n unknowns if that lowers the cost; `lengths` are those of the steps of both axes,
/// rad.
static void descend(const jcal_hinge_t *self, size_t n, jcal_hinge_point_t *point, float *damping, float lengths[2])
{
    jcal_hinge_lin_t lin;
    float d[JCAL_HINGE_UNKNOWNS];
    float predicted;
    jcal_hinge_linearise(&self->moments, &self->cfg, point, (unsigned)n, &lin);
    lengths[0] = STEP_MAX_RAD;
    lengths[1] = STEP_MAX_RAD;
    if (!step(&lin, n, damping, d, &predicted)) {
        return;
    }
    jcal_hinge_point_t trial = *point;
    jcal_hinge_point_move(&trial, d, self->cfg.gyr_bias_rad_s);
    const float change = 0.5f * jcal_hinge_change(&self->moments, &self->cfg, point, &trial);
    jcal_gn_t gn = {*damping};
    const bool kept = jcal_gn_judge(&gn, predicted, change);
    if (kept || (fabsf(change) < HARMLESS_COST)) {
        *point = trial;
    }
    *damping = jcal_min(gn.damping, kept ? JCAL_GN_DAMPING_MAX : DAMPING_MAX);
    lengths[0] = sqrtf((d[0] * d[0]) + (d[1] * d[1]));
    lengths[1] = sqrtf((d[2] * d[2]) + (d[3] * d[3]));
}

float jcal_hinge_cost(const jcal_hinge_t *self, const jcal_hinge_point_t *point)
{
    const float unit = self->cfg.gyr_bias_rad_s;
    const float biases =
        jcal_vec3_dot(point->axis1.bias, point->axis1.bias) + jcal_vec3_dot(point->axis2.bias, point->axis2.bias);
    return jcal_hinge_cost_gyr(&self->moments, point) + jcal_hinge_cost_acc(&self->moments, &self->cfg, point) +
           (biases / (unit * unit));
}

void jcal_hinge_track(jcal_hinge_t *self)
{
    if (!self->has_point) {
        return;
    }
    descend(self, JCAL_HINGE_UNKNOWNS, &self->point, &self->damping, self->moved_rad);
    jcal_hinge_evidence_follow(&self->evidence, &self->point, false);
    self->acc_constant_m_s2 = jcal_hinge_acc_constant(&self->moments, &self->cfg, &self->point);
}

/// Eigenvector `which` of the weighted sum of w w' that begins at feature `first`; the moments with the feature 1
/// hold it.
static jcal_vec3_t rate_eigenvector(const jcal_hinge_moments_t *moments, unsigned first, unsigned which)
{
    const float *const sums = &moments->gyr[jcal_sym_at(JCAL_HINGE_Z_ONE, first)];
    const float packed[6] = {sums[0], sums[3], sums[1],
                             sums[4], sums[5], sums[2]}; /* xx, yy, zz, xy, xz, yz -> lower triangle */
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
    jcal_hinge_point_t point = {{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, place->bias1},
                                {{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, place->bias2}};
    jcal_hinge_axis_set(&point.axis1, place->j1);
    jcal_hinge_axis_set(&point.axis2, place->j2);
    return point;
}

static jcal_hinge_place_t place_of(const jcal_hinge_point_t *point)
{
    const jcal_hinge_place_t place = {point->axis1.j, point->axis2.j, point->axis1.bias, point->axis2.bias};
    return place;
}

float jcal_hinge_cost_of_rival(const jcal_hinge_t *self)
{
    const jcal_hinge_point_t rival = point_at(&self->search.rival);
    return jcal_hinge_cost(self, &rival);
}

static void begin_probe(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    const unsigned start = search->start;
    search->probe = place_of(&self->point);
    search->probe.j2 = jcal_vec3_scale(self->point.axis2.j, -1.0f);
    if (start < EIGEN_STARTS) {
        const jcal_vec3_t j2 = rate_eigenvector(&self->moments, JCAL_HINGE_Z_W2W2, start / 6u);
        search->probe.j1 = rate_eigenvector(&self->moments, JCAL_HINGE_Z_W1W1, (start / 2u) % 3u);
        search->probe.j2 = jcal_vec3_scale(j2, ((start % 2u) == 0u) ? 1.0f : -1.0f);
    }
    search->damping = JCAL_GN_DAMPING_START;
    search->iterations = 0u;
    search->running = true;
}

/// Both signs turned together mean the same joint.
static bool same_pairing(const jcal_hinge_point_t *a, const jcal_hinge_point_t *b)
{
    return (jcal_vec3_dot(a->axis1.j, b->axis1.j) * jcal_vec3_dot(a->axis2.j, b->axis2.j)) > 0.0f;
}

/// The probe's minimum is better: it becomes the estimate, and the old one takes the place that it left.
static void adopt(jcal_hinge_t *self, const jcal_hinge_point_t *probe, bool same_lines)
{
    jcal_hinge_search_t *const search = &self->search;
    const jcal_hinge_point_t old = self->point;
    self->point = *probe;
    self->moved_rad[0] = STEP_MAX_RAD;
    self->moved_rad[1] = STEP_MAX_RAD;
    self->damping = JCAL_GN_DAMPING_START;
    self->agreed = 0u;
    self->verdict.status = (uint8_t)JCAL_COLLECTING; /* what was judged was the old minimum */
    self->verdict.reason = (uint8_t)JCAL_REASON_NO_DATA;
    if (self->has_point && same_lines) {
        search->flip1 = old.axis1.j;
        search->flip2 = old.axis2.j;
        search->has_flip = true;
    } else if (self->has_point) {
        search->rival = place_of(&old);
        search->has_rival = true;
        search->has_flip = false;
    }
    self->has_point = true;
    const float turn_same = self->evidence.turn_other;
    const float turn_other = self->evidence.turn_same;
    jcal_hinge_evidence_follow(&self->evidence, &self->point, true);
    if (same_lines) { /* the same lines in the other pairing: what the rates said of the pairings still holds */
        self->evidence.turn_same = turn_same;
        self->evidence.turn_other = turn_other;
    }
}

/// True if the probe runs into the estimate, so that its further steps would tell nothing.
static bool has_joined(const jcal_hinge_t *self, const jcal_hinge_point_t *probe)
{
    return self->has_point && (fabsf(jcal_vec3_dot(self->point.axis1.j, probe->axis1.j)) > JOINED_COSINE) &&
           (fabsf(jcal_vec3_dot(self->point.axis2.j, probe->axis2.j)) > JOINED_COSINE) &&
           same_pairing(&self->point, probe);
}

/// A better minimum close by: the estimate goes there, and what was summed at the old place still holds nearly enough.
static void slide(jcal_hinge_t *self, const jcal_hinge_point_t *probe)
{
    self->point = *probe;
    self->damping = JCAL_GN_DAMPING_START;
    self->moved_rad[0] = STEP_MAX_RAD;
    self->moved_rad[1] = STEP_MAX_RAD;
    jcal_hinge_evidence_follow(&self->evidence, &self->point, false);
}

static void keep_flip(jcal_hinge_search_t *search, const jcal_hinge_point_t *probe)
{
    search->flip1 = probe->axis1.j;
    search->flip2 = probe->axis2.j;
    search->has_flip = true;
}

/// Files what a finished probe found: the estimate itself, a better minimum, the other pairing, or a rival.
static void file_probe(jcal_hinge_t *self, const jcal_hinge_point_t *probe)
{
    jcal_hinge_search_t *const search = &self->search;
    if (!self->has_point) {
        adopt(self, probe, false);
        return;
    }
    const bool same_lines = jcal_hinge_same_lines(&self->point, probe->axis1.j, probe->axis2.j);
    const bool other_pairing = same_lines && !same_pairing(&self->point, probe);
    /* The turn of the rates tells the pairings apart; it is summed at the present lines only. */
    const float handicap = other_pairing ? (self->evidence.turn_other - self->evidence.turn_same) : 0.0f;
    const float cost = jcal_hinge_cost(self, probe);
    const bool better = (cost + handicap) < jcal_hinge_cost(self, &self->point);
    if (other_pairing) {
        if (better && (self->cfg.sign_hint == JCAL_SIGN_UNKNOWN)) {
            adopt(self, probe, true);
        } else {
            keep_flip(search, probe);
        }
    } else if (same_lines) {
        /* What lies nearby is covered by the bound, unless it is the better place. */
        if (better && !has_joined(self, probe)) {
            slide(self, probe);
        }
    } else if (better) {
        adopt(self, probe, false);
    } else if (!search->has_rival || (cost < jcal_hinge_cost_of_rival(self))) {
        search->rival = place_of(probe);
        search->has_rival = true;
    }
}

void jcal_hinge_search(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    if (!search->running) {
        begin_probe(self);
        return;
    }
    float lengths[2];
    jcal_hinge_point_t probe = point_at(&search->probe);
    const bool refining = search->iterations >= PROBE_STEPS;
    descend(self, refining ? JCAL_HINGE_UNKNOWNS : JCAL_HINGE_AXIS_UNKNOWNS, &probe, &search->damping, lengths);
    search->probe = place_of(&probe);
    search->iterations = (uint8_t)(search->iterations + 1u);
    if (!has_joined(self, &probe)) {
        const bool arrived = jcal_max(lengths[0], lengths[1]) < STEP_MIN_RAD;
        if (!refining && arrived) {
            search->iterations = PROBE_STEPS; /* a place of its own: now its own biases */
        }
        if (search->iterations < (PROBE_STEPS + REFINE_STEPS)) {
            return;
        }
    }
    search->running = false;
    search->start = (uint8_t)(search->start + 1u);
    jcal_hinge_obey(&probe, self->cfg.sign_hint);
    file_probe(self, &probe);
    if (search->start >= STARTS) {
        search->start = 0u;
        const bool counts = (self->evidence.excitation > 0.0f) && (search->rounds < UINT8_MAX);
        search->rounds = counts ? (uint8_t)(search->rounds + 1u) : search->rounds;
    }
}

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
#define PROBE_STEPS 8u

/// A longer step than this says that the model behind it does not reach so far, rad.
#define STEP_MAX_RAD 0.35f
/// A shorter step than this means that the probe has arrived, rad.
#define STEP_MIN_RAD 0.002f
/// cos 4 deg: a probe this near to the estimate, in the same pairing, will end there.
#define JOINED_COSINE 0.9975f

/// Scales the unknowns first .. last - 1 by one over the root of their largest diagonal element.
static float group_scale(const float *matrix, size_t first, size_t last)
{
    float largest = 0.0f;
    for (size_t i = first; i < last; ++i) {
        largest = jcal_max(matrix[jcal_sym_at(i, i)], largest);
    }
    return (largest > 0.0f) ? (1.0f / sqrtf(largest)) : 1.0f;
}

/// A damped step d (8) over the first n unknowns, axes and biases each brought to a common scale. False if there is none.
static bool step(const jcal_hinge_lin_t *lin, size_t n, float *damping, float d[8], float *predicted)
{
    const float scales[2] = {group_scale(lin->matrix, 0u, 4u), group_scale(lin->matrix, 4u, 8u)};
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

/// Moves a point by one step over n unknowns if that lowers the cost; hands back the length of the step, rad.
static float descend(const jcal_hinge_t *self, size_t n, jcal_hinge_point_t *point, float *damping)
{
    jcal_hinge_lin_t lin;
    float d[JCAL_HINGE_UNKNOWNS];
    float predicted;
    jcal_hinge_linearise(&self->moments, &self->cfg, point, &lin);
    if (!step(&lin, n, damping, d, &predicted)) {
        return STEP_MAX_RAD;
    }
    jcal_hinge_point_t trial = *point;
    jcal_hinge_point_move(&trial, d, self->cfg.gyr_bias_rad_s);
    const float change = 0.5f * jcal_hinge_change(&self->moments, &self->cfg, point, &trial);
    jcal_gn_t gn = {*damping};
    if (jcal_gn_judge(&gn, predicted, change)) {
        *point = trial;
    }
    *damping = gn.damping;
    return jcal_max(jcal_max(fabsf(d[0]), fabsf(d[1])), jcal_max(fabsf(d[2]), fabsf(d[3])));
}

float jcal_hinge_cost(const jcal_hinge_t *self, const jcal_hinge_point_t *point)
{
    return jcal_hinge_cost_gyr(&self->moments, point) + jcal_hinge_cost_acc(&self->moments, &self->cfg, point);
}

float jcal_hinge_cost_at(const jcal_hinge_t *self, jcal_vec3_t j1, jcal_vec3_t j2)
{
    jcal_hinge_point_t there = self->point;
    jcal_hinge_axis_set(&there.axis1, j1);
    jcal_hinge_axis_set(&there.axis2, j2);
    return jcal_hinge_cost(self, &there);
}

void jcal_hinge_track(jcal_hinge_t *self)
{
    if (!self->has_point) {
        return;
    }
    (void)descend(self, JCAL_HINGE_UNKNOWNS, &self->point, &self->damping);
    jcal_hinge_evidence_follow(&self->evidence, &self->point, false);
    self->acc_constant_m_s2 = jcal_hinge_acc_constant(&self->moments, &self->cfg, &self->point);
}

/// Eigenvector `which` of the weighted sum of w w' that begins at feature `first`; the moments with the feature 1 hold it.
static jcal_vec3_t rate_eigenvector(const jcal_hinge_moments_t *moments, unsigned first, unsigned which)
{
    const float *const sums = &moments->gyr[jcal_sym_at(JCAL_HINGE_Z_ONE, first)];
    const float packed[6] = {sums[0], sums[3], sums[1], sums[4], sums[5], sums[2]}; /* xx, yy, zz, xy, xz, yz -> lower triangle */
    float values[3];
    float vectors[9];
    if (jcal_eig_symmetric(packed, 3u, values, vectors) != JCAL_OK) {
        return jcal_vec3((which == 0u) ? 1.0f : 0.0f, (which == 1u) ? 1.0f : 0.0f, (which == 2u) ? 1.0f : 0.0f);
    }
    const float *const v = &vectors[3u * which];
    return jcal_vec3_normalise(jcal_vec3(v[0], v[1], v[2]));
}

static void begin_probe(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    const unsigned start = search->start;
    search->probe = self->point; /* the biases of the estimate; none before there is one */
    jcal_vec3_t j1 = self->point.axis1.j;
    jcal_vec3_t j2 = jcal_vec3_scale(self->point.axis2.j, -1.0f);
    if (start < EIGEN_STARTS) {
        j1 = rate_eigenvector(&self->moments, JCAL_HINGE_Z_W1W1, (start / 2u) % 3u);
        j2 = rate_eigenvector(&self->moments, JCAL_HINGE_Z_W2W2, start / 6u);
        j2 = jcal_vec3_scale(j2, ((start % 2u) == 0u) ? 1.0f : -1.0f);
    }
    jcal_hinge_axis_set(&search->probe.axis1, j1);
    jcal_hinge_axis_set(&search->probe.axis2, j2);
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
static void adopt(jcal_hinge_t *self, bool same_lines)
{
    jcal_hinge_search_t *const search = &self->search;
    const jcal_hinge_point_t old = self->point;
    self->point = search->probe;
    self->damping = JCAL_GN_DAMPING_START;
    if (self->has_point && same_lines) {
        search->flip1 = old.axis1.j;
        search->flip2 = old.axis2.j;
        search->has_flip = true;
    } else if (self->has_point) {
        search->rival1 = old.axis1.j;
        search->rival2 = old.axis2.j;
        search->has_rival = true;
        search->has_flip = false;
    }
    self->has_point = true;
    search->rounds = 0u;
    search->start = 0u;
    jcal_hinge_evidence_follow(&self->evidence, &self->point, true);
}

/// Files what a finished probe found: the estimate itself, a better minimum, the other pairing, or a rival.
static void file_probe(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    const jcal_hinge_point_t *const probe = &search->probe;
    const bool same_lines = jcal_hinge_same_lines(&self->point, probe->axis1.j, probe->axis2.j);
    if (self->has_point && same_lines && same_pairing(&self->point, probe)) {
        return;
    }
    const bool hinted = self->cfg.sign_hint != JCAL_SIGN_UNKNOWN;
    const float cost = jcal_hinge_cost(self, probe);
    if (!self->has_point || ((cost < jcal_hinge_cost(self, &self->point)) && !(hinted && same_lines))) {
        adopt(self, same_lines);
    } else if (same_lines) {
        search->flip1 = probe->axis1.j;
        search->flip2 = probe->axis2.j;
        search->has_flip = true;
    } else if (!search->has_rival || (cost < jcal_hinge_cost_at(self, search->rival1, search->rival2))) {
        search->rival1 = probe->axis1.j;
        search->rival2 = probe->axis2.j;
        search->has_rival = true;
    }
}

/// True if the probe runs into the estimate, so that its further steps would tell nothing.
static bool has_joined(const jcal_hinge_t *self)
{
    const jcal_hinge_point_t *const probe = &self->search.probe;
    return self->has_point && (fabsf(jcal_vec3_dot(self->point.axis1.j, probe->axis1.j)) > JOINED_COSINE)
           && (fabsf(jcal_vec3_dot(self->point.axis2.j, probe->axis2.j)) > JOINED_COSINE)
           && same_pairing(&self->point, probe);
}

void jcal_hinge_search(jcal_hinge_t *self)
{
    jcal_hinge_search_t *const search = &self->search;
    if (!search->running) {
        begin_probe(self);
        return;
    }
    const float moved_rad = descend(self, JCAL_HINGE_AXIS_UNKNOWNS, &search->probe, &search->damping);
    search->iterations = (uint8_t)(search->iterations + 1u);
    const bool arrived = (moved_rad < STEP_MIN_RAD) || has_joined(self);
    if (!arrived && (search->iterations < PROBE_STEPS)) {
        return;
    }
    search->running = false;
    search->start = (uint8_t)(search->start + 1u);
    jcal_hinge_obey(&search->probe, self->cfg.sign_hint);
    file_probe(self);
    if (search->start >= STARTS) {
        search->start = 0u;
        search->rounds = (search->rounds < UINT8_MAX) ? (uint8_t)(search->rounds + 1u) : search->rounds;
    }
}

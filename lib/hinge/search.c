/* SPDX-License-Identifier: MIT */
/// @file
/// Follows the best minimum of the moments and looks for others. See hinge/search.h.
#include "hinge/search.h"

#include "hinge/model.h"
#include "hinge/point.h"
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
    const bool done = jcal_gn_step(&gn, &model, d, NULL);
    *damping = gn.damping;
    if (!done) {
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
static float descend(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg, jcal_hinge_point_t *point,
                     float *damping)
{
    jcal_hinge_lin_t lin;
    float d[JCAL_HINGE_TILTS];
    float predicted;
    jcal_hinge_linearise(moments, cfg, point, &lin);
    if (!step(&lin, damping, d, &predicted)) {
        return STEP_MAX_RAD;
    }
    jcal_hinge_point_t trial = *point;
    jcal_hinge_point_move(&trial, d);
    const float change = 0.5f * jcal_hinge_change(moments, cfg, point, &trial);
    jcal_gn_t gn = {*damping};
    const bool kept = jcal_gn_judge(&gn, predicted, change);
    if (kept || (fabsf(change) < HARMLESS_COST)) {
        *point = trial;
    }
    *damping = jcal_min(gn.damping, kept ? JCAL_GN_DAMPING_MAX : DAMPING_MAX);
    return jcal_gn_length(d, JCAL_HINGE_TILTS);
}

void jcal_hinge_track(jcal_hinge_coarse_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_point_t *refined)
{
    if (!self->has_point) {
        return;
    }
    (void)descend(&self->moments, cfg, &self->point, &self->damping);
    self->acc_constant_m_s2 = jcal_hinge_acc_constant(&self->moments, cfg, refined);
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
    if (!jcal_eig_symmetric(packed, 3u, values, vectors)) {
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

float jcal_hinge_cost_of_rival(const jcal_hinge_search_t *self, const jcal_hinge_moments_t *moments,
                               const jcal_hinge_config_t *cfg)
{
    const jcal_hinge_place_t place = {jcal_hinge_noted(self->rival[0]), jcal_hinge_noted(self->rival[1])};
    const jcal_hinge_point_t rival = point_at(&place);
    return jcal_hinge_cost(moments, cfg, &rival);
}

jcal_hinge_point_t jcal_hinge_flipped(const jcal_hinge_search_t *self, const jcal_hinge_point_t *point)
{
    jcal_hinge_point_t flip = *point;
    if (self->has_flip) {
        jcal_hinge_point_recall(&flip, self->flip);
    } else { /* it has no minimum near these lines; one elsewhere is a rival */
        jcal_hinge_axis_set(&flip.axis2, jcal_vec3_scale(flip.axis2.j, -1.0f));
    }
    return flip;
}

/// The pairing of these lines that the specific forces prefer: (24) knows none.
static void choose_pairing(const jcal_hinge_moments_t *moments, const jcal_hinge_config_t *cfg,
                           jcal_hinge_point_t *point)
{
    jcal_hinge_point_t turned = *point;
    jcal_hinge_axis_set(&turned.axis2, jcal_vec3_scale(point->axis2.j, -1.0f));
    const float here = jcal_hinge_cost_acc(moments, cfg, point);
    if (jcal_hinge_cost_acc(moments, cfg, &turned) < here) {
        *point = turned;
    }
}

static void begin_probe(jcal_hinge_search_t *self, const jcal_hinge_coarse_t *coarse, const jcal_hinge_config_t *cfg)
{
    const unsigned start = self->start;
    jcal_hinge_point_t probe = coarse->point;
    if (start < EIGEN_STARTS) {
        jcal_hinge_point_set(&probe, rate_eigenvector(&coarse->moments, JCAL_HINGE_Z_W1W1, start / 3u),
                             rate_eigenvector(&coarse->moments, JCAL_HINGE_Z_W2W2, start % 3u));
        choose_pairing(&coarse->moments, cfg, &probe);
    } else {
        jcal_hinge_axis_set(&probe.axis2, jcal_vec3_scale(probe.axis2.j, -1.0f));
    }
    self->probe = place_of(&probe);
    self->damping = JCAL_GN_DAMPING_START;
    self->iterations = 0u;
    self->running = true;
}

static void put(jcal_hinge_coarse_t *coarse, const jcal_hinge_point_t *point)
{
    coarse->point = *point;
    coarse->damping = JCAL_GN_DAMPING_START;
    coarse->has_point = true;
}

/// Another minimum is better: it becomes the estimate, and the old one the rival.
static void adopt(jcal_hinge_search_t *self, jcal_hinge_coarse_t *coarse, const jcal_hinge_point_t *probe)
{
    if (coarse->has_point) {
        jcal_hinge_point_note(&coarse->point, self->rival);
        self->has_rival = true;
        self->has_flip = false;
    }
    put(coarse, probe);
}

void jcal_hinge_turn_round(jcal_hinge_search_t *self, jcal_hinge_coarse_t *coarse)
{
    const jcal_hinge_point_t flip = jcal_hinge_flipped(self, &coarse->point);
    jcal_hinge_point_note(&coarse->point, self->flip);
    self->has_flip = true;
    put(coarse, &flip);
}

/// True if the probe runs into the estimate, so that its further steps would tell nothing.
static bool has_joined(const jcal_hinge_coarse_t *coarse, const jcal_hinge_point_t *probe)
{
    return coarse->has_point && (fabsf(jcal_vec3_dot(coarse->point.axis1.j, probe->axis1.j)) > JOINED_COSINE) &&
           (fabsf(jcal_vec3_dot(coarse->point.axis2.j, probe->axis2.j)) > JOINED_COSINE) &&
           jcal_hinge_same_pairing(&coarse->point, probe);
}

/// Files what a finished probe found: the estimate itself, a better minimum, the other pairing, or a rival. True if the estimate is
/// another one now.
static bool file_probe(jcal_hinge_search_t *self, jcal_hinge_coarse_t *coarse, const jcal_hinge_config_t *cfg,
                       bool may_turn, const jcal_hinge_point_t *probe)
{
    if (!coarse->has_point) {
        adopt(self, coarse, probe);
        return true;
    }
    const float cost = jcal_hinge_cost(&coarse->moments, cfg, probe);
    const bool better = cost < jcal_hinge_cost(&coarse->moments, cfg, &coarse->point);
    if (!jcal_hinge_same_lines(&coarse->point, probe)) {
        if (better) {
            adopt(self, coarse, probe);
            return true;
        }
        if (!self->has_rival || (cost < jcal_hinge_cost_of_rival(self, &coarse->moments, cfg))) {
            jcal_hinge_point_note(probe, self->rival);
            self->has_rival = true;
        }
    } else if (!jcal_hinge_same_pairing(&coarse->point, probe)) {
        jcal_hinge_point_note(probe, self->flip);
        self->has_flip = true;
        if (better && may_turn) {
            jcal_hinge_turn_round(self, coarse);
            return true;
        }
    } else if (better && !has_joined(coarse, probe)) {
        put(coarse, probe); /* a better place close by */
    } else {
        /* the estimate itself */
    }
    return false;
}

bool jcal_hinge_search(jcal_hinge_search_t *self, jcal_hinge_coarse_t *coarse, const jcal_hinge_config_t *cfg,
                       const jcal_hinge_scope_t *scope)
{
    if (!self->running) {
        begin_probe(self, coarse, cfg);
        return false;
    }
    jcal_hinge_point_t probe = point_at(&self->probe);
    const float length = descend(&coarse->moments, cfg, &probe, &self->damping);
    self->probe = place_of(&probe);
    self->iterations = (uint8_t)(self->iterations + 1u);
    const bool ended = (length < STEP_MIN_RAD) || (self->iterations >= PROBE_STEPS);
    if (!ended && !has_joined(coarse, &probe)) {
        return false;
    }
    self->running = false;
    self->start = (uint8_t)(self->start + 1u);
    jcal_hinge_obey(&probe, cfg->sign_hint, scope->kept_sign);
    const bool may_turn = scope->pairing_is_free && (cfg->sign_hint == JCAL_SIGN_UNKNOWN);
    const bool another = file_probe(self, coarse, cfg, may_turn, &probe);
    if (self->start >= STARTS) {
        self->start = 0u;
        const bool counts = scope->joint_has_moved && (self->rounds < UINT8_MAX);
        self->rounds = counts ? (uint8_t)(self->rounds + 1u) : self->rounds;
    }
    return another;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Algorithm 1 of [OLS20] in slices, and what the window engine does with its result.
#include "hinge/window_solve.h"

#include "hinge/window_accept.h"
#include "jointcal/hinge_window.h"
#include "math/rng.h"
#include "math/solve.h"
#include "math/sphere.h"

enum { UNKNOWNS = 4 };

/* A full solve goes through these in order, one slice each or several. */
enum {
    PHASE_IDLE = 0,
    PHASE_FIRST = 1,  /* Gauss-Newton from a random start. */
    PHASE_SECOND = 2, /* Gauss-Newton from there with the other sign of j2 (28). */
    PHASE_CHOOSE = 3, /* The better one (29): Algorithm 4, and the estimate if it is better than the one followed. */
    PHASE_OTHER = 4,  /* Gauss-Newton from the estimate with the other sign of j2. */
    PHASE_MARGIN = 5  /* Cost of the other pairing over the cost of the estimate. */
};

/* A step shorter than this ends the iteration, rad: a tenth of what float32 sums can tell apart. */
static const float step_tolerance_rad = 1e-5f;

/* Larger ratios of cost say nothing more. */
static const float margin_max = 1e6f;

static jcal_hinge_axes_t other_pairing(const jcal_hinge_axes_t *axes)
{
    const jcal_hinge_axes_t other = {{axes->j[0], jcal_vec3_scale(axes->j[1], -1.0f)}};
    return other;
}

/* One damped Gauss-Newton iteration of (30); true once the steps are too short to matter. */
static bool iterate(const jcal_hinge_rows_t *rows, jcal_hinge_axes_t *axes, float *damping)
{
    jcal_hinge_sums_t sums;
    jcal_hinge_cost_sums(rows, axes, &sums);
    const jcal_gn_model_t model = {UNKNOWNS, sums.gradient, sums.matrix};
    jcal_gn_t gn = {*damping};
    float d[UNKNOWNS];
    float predicted = 0.0f;
    const bool done = jcal_gn_step(&gn, &model, d, &predicted);
    if (done) {
        jcal_hinge_axes_t trial = *axes;
        jcal_gn_move(trial.j, 2u, NULL, 0u, d);
        if (jcal_gn_judge(&gn, predicted, jcal_hinge_cost_change(rows, axes, &trial))) {
            *axes = trial;
        }
    }
    *damping = gn.damping;
    return done && (jcal_gn_length(d, UNKNOWNS) < step_tolerance_rad);
}

/* +1 or -1: the sign of the component of largest magnitude. */
static float dominant_sign(jcal_vec3_t v)
{
    float dominant = v.x;
    dominant = (fabsf(v.y) > fabsf(dominant)) ? v.y : dominant;
    dominant = (fabsf(v.z) > fabsf(dominant)) ? v.z : dominant;
    return (dominant < 0.0f) ? -1.0f : 1.0f;
}

/* Whether the user's hint, if there is one, agrees with a pairing. */
static bool contradicts_hint(jcal_sign_hint_t hint, const jcal_hinge_axes_t *axes)
{
    const bool same = dominant_sign(axes->j[0]) == dominant_sign(axes->j[1]);
    return ((hint == JCAL_SIGN_SAME) && !same) || ((hint == JCAL_SIGN_OPPOSITE) && same);
}

static void enter(jcal_hinge_solve_t *solve, uint8_t phase, const jcal_hinge_axes_t *start)
{
    solve->phase = phase;
    solve->iterations = 0u;
    solve->damping = JCAL_GN_DAMPING_START;
    solve->at = *start;
}

/* True once the phase's iteration is over. */
static bool advance(jcal_hinge_solve_t *solve, const jcal_hinge_rows_t *rows)
{
    ++solve->iterations;
    return iterate(rows, &solve->at, &solve->damping) || (solve->iterations >= JCAL_HINGE_WINDOW_ITERATIONS);
}

static void choose(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows)
{
    jcal_hinge_solve_t *const solve = &self->solve;
    /* (29) */
    const bool second = jcal_hinge_cost_change(rows, &solve->first, &solve->at) < 0.0f;
    const jcal_hinge_axes_t best = second ? solve->at : solve->first;
    jcal_hinge_sums_t sums;
    jcal_hinge_cost_sums(rows, &best, &sums);
    jcal_hinge_accept_update(&self->accept, &self->cfg, &best, &sums);
    /* A hint excludes one of the two pairings of (29), though not from Algorithm 4, which knows of none. */
    const bool excluded = contradicts_hint(self->cfg.hinge.sign_hint, &best);
    const jcal_hinge_axes_t other_minimum = second ? solve->first : solve->at;
    const jcal_hinge_axes_t wanted = excluded ? other_minimum : best;
    const bool better = !contradicts_hint(self->cfg.hinge.sign_hint, &wanted) &&
                        (jcal_hinge_cost_change(rows, &self->axes, &wanted) < 0.0f);
    if (better || !self->has_axes) {
        self->axes = wanted;
        self->damping = solve->damping;
        self->has_axes = true;
    }
    const jcal_hinge_axes_t other = other_pairing(&self->axes);
    enter(solve, PHASE_OTHER, &other);
}

/* V(other) / V(axes); both zero says nothing, which is a ratio of 1. */
static float ratio(float other, float cost)
{
    if (other > (margin_max * cost)) {
        return margin_max;
    }
    return (cost > 0.0f) ? (other / cost) : 1.0f;
}

static void weigh_pairings(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows)
{
    jcal_hinge_axes_t other = self->solve.at;
    const bool same1 = jcal_vec3_dot(other.j[0], self->axes.j[0]) >= 0.0f;
    const bool same2 = jcal_vec3_dot(other.j[1], self->axes.j[1]) >= 0.0f;
    if (same1 == same2) {
        /* The iteration left the other pairing: it has no minimum of its own, so its cost right there counts. */
        other = other_pairing(&self->axes);
    }
    const bool cheaper = jcal_hinge_cost_change(rows, &self->axes, &other) < 0.0f;
    const bool wanted = (self->cfg.hinge.sign_hint == JCAL_SIGN_UNKNOWN)
                            ? cheaper
                            : contradicts_hint(self->cfg.hinge.sign_hint, &self->axes);
    if (wanted) {
        const jcal_hinge_axes_t swap = self->axes;
        self->axes = other;
        other = swap;
        self->damping = JCAL_GN_DAMPING_START;
    }
    jcal_hinge_sums_t sums;
    jcal_hinge_cost_sums(rows, &self->axes, &sums);
    const float cost = sums.cost;
    jcal_hinge_cost_sums(rows, &other, &sums);
    self->sign_margin = ratio(sums.cost, cost);
    self->solve.phase = PHASE_IDLE;
}

void jcal_hinge_window_solve_reset(jcal_hinge_window_t *self)
{
    self->solve = (jcal_hinge_solve_t){0};
    self->solve.random = self->cfg.seed;
    self->accept = (jcal_hinge_accept_t){0};
    self->accept.seqad_rad = JCAL_PI;
    self->accept.local_rad[0] = JCAL_HALF_PI;
    self->accept.local_rad[1] = JCAL_HALF_PI;
    self->axes = (jcal_hinge_axes_t){{{0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}}};
    self->damping = JCAL_GN_DAMPING_START;
    self->sign_margin = 0.0f;
}

void jcal_hinge_window_follow(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows)
{
    if (self->has_axes) {
        (void)iterate(rows, &self->axes, &self->damping);
    }
}

bool jcal_hinge_window_solve_begin(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows)
{
    if ((self->solve.phase != PHASE_IDLE) || ((rows->n_gyr[0] + rows->n_gyr[1]) < JCAL_HINGE_WINDOW_ROWS_MIN)) {
        return false;
    }
    jcal_rng_t rng = {self->solve.random};
    const jcal_vec3_t j1 = jcal_rng_unit(&rng);
    const jcal_vec3_t j2 = jcal_rng_unit(&rng);
    const jcal_hinge_axes_t start = {{j1, j2}};
    self->solve.random = rng.state;
    enter(&self->solve, PHASE_FIRST, &start);
    return true;
}

void jcal_hinge_window_solve_slice(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows)
{
    jcal_hinge_solve_t *const solve = &self->solve;
    switch (solve->phase) {
    case PHASE_FIRST:
        if (advance(solve, rows)) {
            solve->first = solve->at;
            const jcal_hinge_axes_t start = other_pairing(&solve->first);
            enter(solve, PHASE_SECOND, &start);
        }
        break;
    case PHASE_SECOND:
        if (advance(solve, rows)) {
            solve->phase = PHASE_CHOOSE;
        }
        break;
    case PHASE_CHOOSE:
        choose(self, rows);
        break;
    case PHASE_OTHER:
        if (advance(solve, rows)) {
            solve->phase = PHASE_MARGIN;
        }
        break;
    case PHASE_MARGIN:
        weigh_pairings(self, rows);
        break;
    default: /* PHASE_IDLE */
        break;
    }
}

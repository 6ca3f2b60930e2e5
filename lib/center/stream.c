/* SPDX-License-Identifier: MIT */
/// @file
/// Stream engine of the joint centre: samples into sums, and the schedule of the work.
#include "jointcal/center.h"

#include "center/gravity.h"
#include "center/input.h"
#include "center/judge.h"
#include "center/model.h"
#include "center/sums.h"
#include "joint/watch.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/solve.h"
#include "math/sym.h"
#include "sample/ring.h"

#include <float.h>
#include <math.h>
#include <stddef.h>

/// Motion that the moments hold before their minimum is a start, s: with a standard deviation below START_M, else later.
#define MOVING_MIN_S 0.5f
#define MOVING_ENOUGH_S 4.0f
#define START_M 0.05f
/// A step of the start shorter than this has arrived, m, and the longest one.
#define ARRIVED_M 0.01f
#define STEP_MAX_M 0.3f
/// The estimate may move from where the sums began as far as changes |a - K r| by this, rms: a few percent of gravity, by which rows
/// turn. If more data than that of SETTLED_S want it further away, the sums begin anew where they want it.
#define LINEAR_M_S2 0.5f
#define SETTLED_S 4.0f
/// Blocks in the sums before the estimate moves away from the start: of less data steps go far astray, and rows are linearised there.
#define BLOCKS_MIN 4.0f
/// Longest memory with orientations, s: their heading offset drifts.
#define HEADING_MEMORY_S 60.0f
/// Time from which the first heading offset is taken, s.
#define HEADING_S 2.0f
/// What may pass for usual by the watch, times the variance in the config; and where a single residual ends to count: a knock is no slip.
#define WATCH_SHARE 5.0f
#define WATCH_MOST 25.0f

/// Turns of the cycle before there is an estimate: gradient, rows of the matrix, step, and whether that arrived.
#define TURN_START_STEP (JCAL_CENTER_PLACE_UNKNOWNS + 1u)
#define TURNS_START (TURN_START_STEP + 2u)
/// Turns of the cycle after that: matrix and factor, the step from it and moving the estimate, the other slices of the judgement.
#define TURN_SOLVE (JCAL_CENTER_SLICE_FACTOR + 1u)
#define TURN_MOVE (TURN_SOLVE + 1u)
#define TURNS (JCAL_CENTER_JUDGE_SLICES + 2u)

/// Of the inbox: with its four slots by default that makes 5 KiB.
#define SLOT_BYTES (sizeof(jcal_pair_t) + sizeof(jcal_attitudes_t))
typedef char jcal_center_fits_its_budget
    [((sizeof(jcal_center_t) - (JCAL_INBOX_CAPACITY * SLOT_BYTES)) <= (5120u - (4u * SLOT_BYTES))) ? 1 : -1];

/// Forgets what was learnt of the joint.
static void begin_anew(jcal_center_t *self, jcal_calibration_t status)
{
    jcal_clear(&self->work.as, sizeof self->work.as);
    jcal_clear(&self->start, sizeof self->start);
    jcal_clear(&self->work.sums, sizeof self->work.sums);
    jcal_clear(&self->watch, sizeof self->watch);
    jcal_clear(&self->heading, sizeof self->heading);
    jcal_center_gravity_forget(&self->work.gravity);
    self->heading_s = 0.0f;
    self->moving_s = 0.0f;
    self->turn = 0u;
    self->has_start = false;
    self->has_point = false;
    jcal_center_verdict_begin(&self->work.verdict, status);
}

jcal_status_t jcal_center_init(jcal_center_t *self, const jcal_center_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_center_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_center_config_t cfg = *config; /* the caller may hand over self->cfg */
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    jcal_center_input_begin(&self->input);
    begin_anew(self, JCAL_COLLECTING);
    return JCAL_OK;
}

jcal_status_t jcal_center_reset(jcal_center_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_center_init(self, &self->cfg);
}

/// False for null and for what init has never prepared: all zero, say.
static bool is_prepared(const jcal_center_t *self)
{
    return (self != NULL) && (self->cfg.memory_s > 0.0f);
}

jcal_status_t jcal_center_push(jcal_center_t *self, const jcal_pair_t *pair)
{
    if (!is_prepared(self) || (pair == NULL) || (self->cfg.method == JCAL_CENTER_LS)) {
        return JCAL_ERR_ARG;
    }
    return jcal_center_input_push(&self->input, &self->cfg, pair, NULL);
}

jcal_status_t jcal_center_push_oriented(jcal_center_t *self, const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    if (!is_prepared(self) || (pair == NULL) || (attitudes == NULL)) {
        return JCAL_ERR_ARG;
    }
    return jcal_center_input_push(&self->input, &self->cfg, pair, attitudes);
}

/// Takes a sample into the moments.
static void add_moments(jcal_center_t *self, const jcal_kinematic_t *sample)
{
    float f[JCAL_CENTER_FEATURES];
    jcal_center_features(sample, f);
    const float force = jcal_vec3_norm(sample->body1.a) + jcal_vec3_norm(sample->body2.a);
    const float noise = self->cfg.acc_noise_m_s2 * jcal_max(force, 1.0f);
    jcal_sym_rank1(self->work.as.moments, JCAL_CENTER_FEATURES, f,
                   sample->dt_s / (jcal_center_reading_s(&self->cfg) * noise * noise));
}

static float memory_s(const jcal_center_config_t *cfg)
{
    return (cfg->method == JCAL_CENTER_LS) ? jcal_min(cfg->memory_s, HEADING_MEMORY_S) : cfg->memory_s;
}

/// Takes a sample into the sums at the estimate.
static void add_residual(jcal_center_t *self, const jcal_kinematic_t *sample, float motion_s)
{
    const float square = jcal_center_sums_take(&self->work.sums, &self->cfg, sample, WATCH_MOST);
    if (square < 0.0f) {
        return;
    }
    jcal_watch_add(&self->watch, 0u, square / WATCH_SHARE, motion_s);
    if (self->work.sums.time_s > memory_s(&self->cfg)) {
        jcal_center_sums_halve(&self->work.sums);
    }
}

static void take_in(jcal_center_t *self, const jcal_kinematic_t *sample)
{
    const float rate1 = sample->body1.rate2;
    const float rate2 = sample->body2.rate2;
    const float motion_s = sample->dt_s * jcal_watch_motion(rate1 + rate2);
    self->t_us = sample->t_us;
    if (!self->has_point && !self->has_start) {
        add_moments(self, sample);
        self->moving_s += motion_s;
    }
    if (self->moving_s > self->cfg.memory_s) {
        jcal_sym_scale(self->work.as.moments, JCAL_CENTER_FEATURES, 0.5f);
        self->moving_s *= 0.5f;
    }
    if (self->has_point) {
        add_residual(self, sample, motion_s);
        jcal_center_gravity_add(&self->work.gravity, sample, &self->work.sums.point.place,
                                jcal_center_input_turns(&self->cfg));
    } else if (self->has_start) {
        jcal_center_add_heading(sample, &self->start, &self->heading);
        self->heading_s += sample->dt_s;
    } else {
        /* nothing to refer to yet */
    }
    if (jcal_watch_alarm(&self->watch)) {
        begin_anew(self, JCAL_MOVED);
    }
}

/// True if the moments' minimum is known well enough to begin with. `matrix` is lost.
static bool is_known(const jcal_center_t *self, float *matrix, float cost)
{
    if (self->moving_s > MOVING_ENOUGH_S) {
        return true;
    }
    float inverse[JCAL_SYM_SIZE(JCAL_CENTER_PLACE_UNKNOWNS)];
    if (!jcal_chol_factor(matrix, JCAL_CENTER_PLACE_UNKNOWNS, matrix, NULL)) {
        return false;
    }
    jcal_chol_inverse(matrix, JCAL_CENTER_PLACE_UNKNOWNS, inverse);
    float trace = 0.0f;
    for (size_t i = 0u; i < JCAL_CENTER_PLACE_UNKNOWNS; ++i) {
        trace += inverse[jcal_sym_at(i, i)];
    }
    const float excess = jcal_max(1.0f, cost * jcal_center_reading_s(&self->cfg) / self->moving_s);
    return (trace * excess) < (START_M * START_M);
}

/// A slice of a damped step to the moments' minimum: gradient, rows of the matrix, step. Until the sums begin, they hold these.
static void step_start(jcal_center_t *self)
{
    jcal_center_sums_t *const sums = &self->work.sums;
    if (self->turn == 0u) {
        sums->cost = jcal_center_form(self->work.as.moments, &self->start, sums->gradient);
    } else if (self->turn < TURN_START_STEP) {
        jcal_center_form_row(self->work.as.moments, &self->start, self->turn - 1u, sums->matrix);
    } else if (self->turn == TURN_START_STEP) {
        sums->effect = FLT_MAX; /* length of the step */
        float d[JCAL_CENTER_PLACE_UNKNOWNS];
        const jcal_gn_model_t model = {JCAL_CENTER_PLACE_UNKNOWNS, sums->gradient, sums->matrix};
        jcal_gn_t gn = jcal_gn_begin();
        if (jcal_gn_step(&gn, &model, d, NULL)) {
            const float length = jcal_gn_length(d, JCAL_CENTER_PLACE_UNKNOWNS);
            const float share = (length > STEP_MAX_M) ? (STEP_MAX_M / length) : 1.0f;
            self->start.r1 = jcal_vec3_add(self->start.r1, jcal_vec3_scale(jcal_vec3(d[0], d[1], d[2]), share));
            self->start.r2 = jcal_vec3_add(self->start.r2, jcal_vec3_scale(jcal_vec3(d[3], d[4], d[5]), share));
            sums->effect = length;
        }
    } else {
        self->has_start = (sums->effect < ARRIVED_M) && is_known(self, sums->matrix, sums->cost);
    }
    self->turn = (uint8_t)((self->turn + 1u) % TURNS_START);
}

/// Mean square by which a - K r changes between a place and where the sums began, times the sum of the weights. Along an axis that
/// leaves all that as it is, a hinge's, the estimate may wander. Rows see one of three components.
static float change_since(const jcal_center_sums_t *sums, const jcal_center_place_t *to)
{
    const jcal_vec3_t way1 = jcal_vec3_sub(to->r1, sums->anchor.r1);
    const jcal_vec3_t way2 = jcal_vec3_sub(to->r2, sums->anchor.r2);
    const float way[JCAL_CENTER_PLACE_UNKNOWNS] = {way1.x, way1.y, way1.z, way2.x, way2.y, way2.z};
    float on[JCAL_CENTER_PLACE_UNKNOWNS];
    float sum = 0.0f;
    jcal_sym_times(sums->matrix, JCAL_CENTER_PLACE_UNKNOWNS, way, on); /* the leading block */
    for (size_t i = 0u; i < JCAL_CENTER_PLACE_UNKNOWNS; ++i) {
        sum += way[i] * on[i];
    }
    return 3.0f * sum;
}

static void begin_sums(jcal_center_t *self, const jcal_center_place_t *place, jcal_plane_t heading)
{
    if (self->cfg.method == JCAL_CENTER_LS) {
        jcal_center_sums_begin_oriented(&self->work.sums, place, heading);
    } else {
        jcal_center_sums_begin(&self->work.sums, place);
    }
}

/// Moves the estimate by the step that was found.
static void move_point(jcal_center_t *self)
{
    const float *const d = self->work.as.inverse.step;
    jcal_center_place_t to = self->work.sums.point.place;
    to.r1 = jcal_vec3_add(to.r1, jcal_vec3(d[0], d[1], d[2]));
    to.r2 = jcal_vec3_add(to.r2, jcal_vec3(d[3], d[4], d[5]));
    const float limit = LINEAR_M_S2 * LINEAR_M_S2 * self->work.sums.weight;
    const bool is_ready =
        self->work.verdict.status == (uint8_t)JCAL_READY; /* nothing that is known so well is thrown away */
    if (is_ready || !(change_since(&self->work.sums, &to) > limit)) {
        jcal_center_sums_move(&self->work.sums, d);
    } else if (self->work.sums.time_s > SETTLED_S) {
        const jcal_center_point_t before = self->work.sums.point;
        begin_sums(self, &to, before.heading);
        self->work.sums.point.b1 = before.b1;
        self->work.sums.point.b2 = before.b2;
        self->turn = 0u;
    } else {
        /* too little data to follow */
    }
}

/// Finds a point to begin with.
static void work_at_start(jcal_center_t *self)
{
    if (!self->has_start && (self->moving_s > MOVING_MIN_S)) {
        step_start(self);
    } else if (self->has_start && ((self->cfg.method != JCAL_CENTER_LS) || (self->heading_s > HEADING_S))) {
        begin_sums(self, &self->start, self->heading);
        jcal_clear(&self->work.as.inverse, sizeof self->work.as.inverse);
        self->has_point = true;
        self->turn = 0u;
    }
}

/// One slice of the work at the estimate.
static void work_at_point(jcal_center_t *self)
{
    const unsigned turn = self->turn;
    if (jcal_center_sums_close(&self->work.sums) || ((turn == 0u) && !(self->work.sums.blocks >= BLOCKS_MIN))) {
        return;
    }
    self->turn = (uint8_t)((turn + 1u) % TURNS);
    if (turn == TURN_SOLVE) {
        jcal_center_solve(&self->cfg, &self->work);
    } else if (turn == TURN_MOVE) {
        move_point(self);
    } else if (!jcal_center_judge(&self->cfg, &self->work, (turn < TURN_SOLVE) ? turn : (turn - 2u))) {
        self->turn = 0u;
    } else if (self->work.verdict.status == (uint8_t)JCAL_READY) {
        jcal_watch_start(&self->watch);
    } else {
        /* not ready yet */
    }
}

jcal_status_t jcal_center_step(jcal_center_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    jcal_kinematic_t sample;
    const jcal_center_input_event_t event = jcal_center_input_take(&self->input, &self->cfg, &sample);
    if (event == JCAL_CENTER_NONE) {
        return JCAL_IDLE;
    }
    if (event == JCAL_CENTER_SAMPLE) {
        take_in(self, &sample);
    }
    if ((event != JCAL_CENTER_WAITS) && self->has_worked) {
        self->has_worked = false; /* samples and work take turns if there is a push for each */
        return JCAL_OK;
    }
    self->has_worked = event == JCAL_CENTER_WAITS;
    if (self->has_point) {
        work_at_point(self);
    } else {
        work_at_start(self);
    }
    return JCAL_OK;
}

jcal_status_t jcal_center_update(jcal_center_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (uint32_t left = jcal_ring_waiting(&self->input.inbox.ring); left > 0u; --left) {
        (void)jcal_center_step(self); /* pushed without a step */
    }
    const jcal_status_t status = jcal_center_push(self, pair);
    if (status >= JCAL_OK) {
        (void)jcal_center_step(self);
    }
    return status;
}

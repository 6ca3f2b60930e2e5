/* SPDX-License-Identifier: MIT */
/// @file
/// Stream engine of the 2-DoF joint: orientations into rates, samples into sums, and the schedule of the work.
#include "jointcal/two_dof.h"

#include "joint/watch.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "sample/ring.h"
#include "two_dof/judge.h"
#include "two_dof/kept.h"
#include "two_dof/memory.h"
#include "two_dof/model.h"
#include "two_dof/prior.h"
#include "two_dof/residual.h"
#include "two_dof/search.h"
#include "two_dof/verdict.h"

#include <float.h>
#include <stddef.h>

/// Orientations are kept this far apart, us: rates come from every other one, so this sets their low-pass, a mean over 80 ms (the
/// first zero of its response lies at 12.5 Hz, -3 dB at 5.5 Hz) that has no delay against the orientation in the middle.
#define KEEP_US 38000u
/// What may pass for usual by the watch, times the variance in the config: errors of the inclination come and go within seconds.
#define WATCH_SHARE 5.0f

/// Items of work for one kept sample: both kinds of moments, then slices of the search.
#define ITEM_ROTATION 0u
#define ITEM_ORIENTATION 1u
#define ITEMS 4u
#define ITEMS_READY 3u

/// A calibration that was ready and has not fitted for so many judgements is void.
#define MISFITS_MAX 8u
/// After a slip an orientation filter takes seconds to settle. What has not fitted for so many judgements then is given up, too.
#define MISFITS_RECOVERING 16u

/// Turns of the cycle of estimate, judgement and search; the last of them are the probe's.
enum { TURN_TRACK = 0, TURN_JUDGE = 1, TURN_FADE = 2, TURN_DRIFT = 3, TURN_RIVAL = 4, TURN_PROBE = 5, TURNS = 9 };

/// Of the inbox: with its four slots by default that makes 4 KiB.
#define SLOT_BYTES (sizeof(jcal_orientation_pair_t) + 1u)
typedef char jcal_two_dof_fits_its_budget
    [((sizeof(jcal_two_dof_t) - (JCAL_INBOX_CAPACITY * SLOT_BYTES)) <= (4096u - (4u * SLOT_BYTES))) ? 1 : -1];

/// Forgets all that was learnt of the joint and begins again with the given status; samples, counters and config stay.
static void begin_anew(jcal_two_dof_t *self, jcal_calibration_t status)
{
    jcal_clear(&self->moments, sizeof self->moments);
    jcal_clear(&self->prior, sizeof self->prior);
    jcal_clear(&self->search, sizeof self->search);
    self->age_s = 0.0f;
    self->moving_s = 0.0f;
    self->memory.since_s = 0.0f;
    self->turn = 0u;
    self->misfits = 0u;
    self->recovers = self->recovers || (status == JCAL_MOVED);
    jcal_clear(&self->watch, sizeof self->watch);
    jcal_two_dof_verdict_begin(&self->verdict, status);
}

jcal_status_t jcal_two_dof_init(jcal_two_dof_t *self, const jcal_two_dof_config_t *config)
{
    if ((self == NULL) || (config == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_two_dof_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    const jcal_two_dof_config_t cfg = *config; /* the caller may hand over self->cfg */
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    self->share = ITEMS;
    self->item = ITEMS;
    begin_anew(self, JCAL_COLLECTING);
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_reset(jcal_two_dof_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_two_dof_init(self, &self->cfg);
}

/// False for null and for what init has never prepared: all zero, say.
static bool is_prepared(const jcal_two_dof_t *self)
{
    return (self != NULL) && (self->share > 0u);
}

jcal_status_t jcal_two_dof_push(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair)
{
    if (!is_prepared(self) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    return jcal_two_dof_keep(&self->kept, &self->gate, &self->cfg.gate, pair, KEEP_US);
}

static void add_rotation(jcal_two_dof_t *self, const jcal_two_dof_sample_t *sample, float rate2)
{
    const float time_s = self->time_s;
    const jcal_two_dof_config_t *const cfg = &self->cfg;
    const float variance =
        (cfg->rate_noise_rad_s * cfg->rate_noise_rad_s) + (cfg->rate_error * cfg->rate_error * rate2);
    float features[JCAL_TWO_DOF_FEATURES];
    jcal_two_dof_rotation_features(sample, features);
    if (self->search.has_best && (cfg->constraint != JCAL_CONSTRAINT_ORIENTATION)) {
        const float sine = self->verdict.sine;
        const float residual = jcal_two_dof_value(features, &self->search.best.point);
        jcal_watch_add(&self->watch, ITEM_ROTATION,
                       residual * residual / (WATCH_SHARE * variance * (1.0f - (sine * sine))), time_s);
    }
    const float weight = time_s / (JCAL_TWO_DOF_RATE_TIME_S * variance);
    jcal_two_dof_add(self->moments.rotation, features, weight);
}

static void add_orientation(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair)
{
    const float time_s = self->time_s;
    const jcal_two_dof_config_t *const cfg = &self->cfg;
    const float variance = cfg->angle_noise_rad * cfg->angle_noise_rad;
    const float weight = time_s / (JCAL_TWO_DOF_ANGLE_TIME_S * variance);
    float features[JCAL_TWO_DOF_FEATURES];
    jcal_two_dof_orientation_features(pair->q1, pair->q2, features);
    if (self->search.has_best && (cfg->constraint != JCAL_CONSTRAINT_ROTATION)) {
        const float residual = jcal_two_dof_value(features, &self->search.best.point) - self->verdict.sine;
        jcal_watch_add(&self->watch, ITEM_ORIENTATION, residual * residual / (WATCH_SHARE * variance), time_s);
    }
    jcal_two_dof_add(self->moments.orientation, features, weight);
    for (size_t i = 0u; i < JCAL_TWO_DOF_FEATURES; ++i) {
        self->moments.mean[i] += weight * features[i];
    }
    self->moments.weight += weight;
}

/// Rotation-based moments of the sample last taken.
static void sum_rotation(jcal_two_dof_t *self)
{
    jcal_two_dof_middle_t middle;
    self->time_s = 0.0f;
    if (!jcal_two_dof_middle(&self->kept, &middle)) {
        return;
    }
    const jcal_two_dof_sample_t sample = {.q1 = middle.at->q1, .q2 = middle.at->q2, .w1 = middle.w1, .w2 = middle.w2};
    const float dt_s = middle.dt_s;
    const float rate2 = jcal_vec3_dot(sample.w1, sample.w1) + jcal_vec3_dot(sample.w2, sample.w2);
    self->time_s = dt_s * jcal_watch_motion(rate2);
    self->age_s = (self->age_s + dt_s) * (self->moving_s / (self->moving_s + self->time_s + FLT_MIN));
    self->memory.since_s += dt_s;
    add_rotation(self, &sample, rate2);
}

/// Orientation-based ones of the same sample.
static void sum_orientation(jcal_two_dof_t *self)
{
    if (self->time_s > 0.0f) {
        add_orientation(self, &self->kept.last[1]);
        self->moving_s += self->time_s;
        self->t_us = self->kept.last[1].t_us;
    }
    if (jcal_watch_alarm(&self->watch)) {
        begin_anew(self, JCAL_MOVED);
    }
}

/// What the data show now, and how the search and the judgement are to see it.
static jcal_two_dof_landscape_t landscape_of(const jcal_two_dof_t *self)
{
    const jcal_two_dof_landscape_t landscape = {
        .moments = &self->moments,
        .prior = &self->prior,
        .pose = &self->kept.last[0],
        .constraint = self->cfg.constraint,
        .moving_s = self->moving_s,
        .excess = self->verdict.excess,
    };
    return landscape;
}

/// Judges the estimate. A calibration that was ready and no longer fits is given up, and so is one after a slip that never does.
static void judge(jcal_two_dof_t *self, const jcal_two_dof_landscape_t *landscape)
{
    const jcal_two_dof_case_t of = {&self->search, landscape, self->age_s,
                                    jcal_orientation_gate_complaint(&self->gate)};
    jcal_two_dof_judge(&self->verdict, &self->cfg, &of);
    const bool was_ready = self->watch.on;
    const bool misfit = self->verdict.reason == (uint8_t)JCAL_REASON_DOES_NOT_FIT;
    self->misfits = (uint8_t)((misfit && (was_ready || self->recovers)) ? (self->misfits + 1u) : 0u);
    if (self->misfits >= (was_ready ? MISFITS_MAX : MISFITS_RECOVERING)) {
        begin_anew(self, was_ready ? JCAL_MOVED : (jcal_calibration_t)self->verdict.status);
    } else if (self->verdict.status == (uint8_t)JCAL_READY) {
        self->recovers = false;
        jcal_watch_start(&self->watch);
    } else {
        /* not ready yet */
    }
}

/// Fades all sums; while the status is ready, what they said of the axes goes to the prior.
static void fade(jcal_two_dof_t *self)
{
    if (self->verdict.status == (uint8_t)JCAL_READY) {
        jcal_two_dof_prior_take(&self->prior, &self->search.best.point, &self->search.lin,
                                1.0f - JCAL_TWO_DOF_FADE_KEEP);
    }
    jcal_two_dof_fade(&self->moments, JCAL_TWO_DOF_FADE_KEEP);
    self->moving_s *= JCAL_TWO_DOF_FADE_KEEP;
    self->search.cost *= JCAL_TWO_DOF_FADE_KEEP;
    self->search.rival_cost *= JCAL_TWO_DOF_FADE_KEEP;
}

/// Refers the sums to where the heading offset is by now.
static void follow_drift(jcal_two_dof_t *self)
{
    jcal_plane_t *const heading = &self->search.best.point.heading;
    jcal_plane_t turn;
    if ((self->verdict.status == (uint8_t)JCAL_READY) &&
        jcal_two_dof_follow_drift(&self->memory, &self->cfg, *heading, &turn)) {
        jcal_two_dof_turn(&self->moments, turn);
        *heading = jcal_plane_direction(jcal_plane_times(*heading, turn));
    }
    self->memory.since_s = 0.0f;
}

/// The search has found another estimate. If the one before it was ready, the joint is another one now.
static void change_estimate(jcal_two_dof_t *self)
{
    if (self->watch.on) {
        begin_anew(self, JCAL_MOVED);
        return;
    }
    self->memory.heading_then = (jcal_plane_t){0.0f, 0.0f};
    self->memory.drift_rad_s = 0.0f;
    self->verdict.agreed = 0u;
    if (self->verdict.status != (uint8_t)JCAL_MOVED) {
        self->verdict.status = (uint8_t)JCAL_COLLECTING;
    }
    self->verdict.reason = (uint8_t)JCAL_REASON_UNCERTAIN;
}

/// A slice of the search. Returns whether its turn is over.
static bool search(jcal_two_dof_t *self, const jcal_two_dof_landscape_t *landscape)
{
    const jcal_two_dof_found_t found = jcal_two_dof_probe(&self->search, landscape);
    if (found == JCAL_TWO_DOF_ESTIMATE) {
        change_estimate(self);
    }
    return found != JCAL_TWO_DOF_HALF_DONE;
}

/// One slice of work on the estimate: half a step, a judgement, forgetting, or the search for others.
static void work(jcal_two_dof_t *self)
{
    if (!(self->moving_s > 0.0f)) {
        return;
    }
    if (!self->search.has_best && (self->turn < TURN_PROBE)) {
        self->turn = TURN_PROBE;
    }
    const jcal_two_dof_landscape_t landscape = landscape_of(self);
    unsigned next = (self->turn + 1u) % TURNS;
    switch (self->turn) {
    case TURN_TRACK:
        next = (jcal_two_dof_track(&self->search, &landscape) == JCAL_TWO_DOF_HALF_DONE) ? TURN_TRACK : TURN_JUDGE;
        break;
    case TURN_JUDGE:
        judge(self, &landscape);
        next = jcal_two_dof_fade_is_due(&self->memory, &self->cfg, &self->verdict) ? TURN_FADE : TURN_RIVAL;
        break;
    case TURN_FADE:
        fade(self);
        break;
    case TURN_DRIFT:
        follow_drift(self);
        break;
    case TURN_RIVAL:
        jcal_two_dof_compare(&self->search, &landscape);
        break;
    default:
        next = search(self, &landscape) ? next : self->turn;
        break;
    }
    self->turn = (uint8_t)next;
}

/// Items of work for the sample last taken: slices of the search are fewer once the status is ready.
static unsigned items_of(const jcal_two_dof_t *self)
{
    if (self->verdict.status != (uint8_t)JCAL_READY) {
        return ITEMS;
    }
    return self->odd ? ITEMS_READY : (ITEM_ORIENTATION + 1u);
}

static void do_item(jcal_two_dof_t *self)
{
    switch (self->item) {
    case ITEM_ROTATION:
        sum_rotation(self);
        break;
    case ITEM_ORIENTATION:
        sum_orientation(self);
        break;
    default:
        work(self);
        break;
    }
    self->item = (uint8_t)(self->item + 1u);
}

/// Begins with an orientation that has just been taken, for which so many samples were pushed.
static void begin_items(jcal_two_dof_t *self, unsigned pushes)
{
    self->share = (uint8_t)((ITEMS + pushes - 1u) / pushes);
    self->item = 0u;
    self->odd = !self->odd;
}

jcal_status_t jcal_two_dof_step(jcal_two_dof_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    const bool waits = jcal_ring_waiting(&self->kept.ring) > 0u;
    while (waits && (self->item <= ITEM_ORIENTATION)) {
        do_item(self); /* moments of the one before that are still to be summed */
    }
    unsigned pushes;
    if (waits && jcal_two_dof_take(&self->kept, &pushes)) {
        begin_items(self, pushes);
    } else if (self->item >= items_of(self)) {
        return JCAL_IDLE;
    } else {
        /* go on with the last one */
    }
    for (unsigned i = 0u; (i < self->share) && (self->item < items_of(self)); ++i) {
        do_item(self);
    }
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_update(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (uint32_t left = jcal_ring_waiting(&self->kept.ring); left > 0u; --left) {
        (void)jcal_two_dof_step(self); /* pushed without a step */
    }
    const jcal_status_t status = jcal_two_dof_push(self, pair);
    if (status >= JCAL_OK) {
        (void)jcal_two_dof_step(self);
    }
    return status;
}

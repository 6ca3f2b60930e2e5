/* SPDX-License-Identifier: MIT */
/// @file
/// Stream engine of the 2-DoF joint: config, orientations into rates, samples into sums, and the schedule of the work.
#include "jointcal/two_dof.h"

#include "joint/watch.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "sample/ring.h"
#include "two_dof/kept.h"
#include "two_dof/model.h"
#include "two_dof/residual.h"
#include "two_dof/search.h"
#include "two_dof/stream.h"
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

/// Of the inbox: with its four slots by default that makes 4 KiB.
#define SLOT_BYTES (sizeof(jcal_orientation_pair_t) + 1u)
typedef char jcal_two_dof_fits_its_budget
    [((sizeof(jcal_two_dof_t) - (JCAL_INBOX_CAPACITY * SLOT_BYTES)) <= (4096u - (4u * SLOT_BYTES))) ? 1 : -1];

jcal_two_dof_config_t jcal_two_dof_config_default(void)
{
    const jcal_two_dof_config_t config = {
        .gate = jcal_gate_config_default(),
        .constraint = JCAL_CONSTRAINT_COMBINED,
        .max_bound_rad = 3.0f * JCAL_RAD_PER_DEG,
        .mismatch_rad = 0.75f * JCAL_RAD_PER_DEG,
        .rate_noise_rad_s = 0.02f,
        .rate_error = 0.02f,
        .angle_noise_rad = 0.013f,
        .heading_drift_rad_s = 3.0f * JCAL_RAD_PER_DEG / 60.0f,
        .memory_s = 5.0f,
    };
    return config;
}

typedef struct {
    const char *name;
    float value, low, high;
} field_t;

const char *jcal_two_dof_config_check(const jcal_two_dof_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const field_t fields[] = {
        {"max_bound_rad", config->max_bound_rad, 0.001f, 0.5f},
        {"mismatch_rad", config->mismatch_rad, 0.0f, 0.1f},
        {"rate_noise_rad_s", config->rate_noise_rad_s, 1e-3f, 1.0f},
        {"rate_error", config->rate_error, 0.0f, 0.5f},
        {"angle_noise_rad", config->angle_noise_rad, 1e-3f, 0.5f},
        {"heading_drift_rad_s", config->heading_drift_rad_s, 0.0f, 0.05f},
        {"memory_s", config->memory_s, 2.0f, 600.0f},
    };
    for (size_t i = 0u; i < (sizeof fields / sizeof fields[0]); ++i) {
        if (!jcal_within(fields[i].value, fields[i].low, fields[i].high)) {
            return fields[i].name;
        }
    }
    const int constraint = (int)config->constraint;
    if ((constraint < (int)JCAL_CONSTRAINT_COMBINED) || (constraint > (int)JCAL_CONSTRAINT_ORIENTATION)) {
        return "constraint";
    }
    return jcal_gate_config_check(&config->gate);
}

void jcal_two_dof_begin_anew(jcal_two_dof_t *self, jcal_calibration_t status)
{
    jcal_clear(&self->moments, sizeof self->moments);
    jcal_clear(&self->prior, sizeof self->prior);
    jcal_clear(&self->best, sizeof self->best);
    jcal_clear(&self->search, sizeof self->search);
    self->age_s = 0.0f;
    self->moving_s = 0.0f;
    self->since_forgot_s = 0.0f;
    self->has_best = false;
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
    jcal_two_dof_begin_anew(self, JCAL_COLLECTING);
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_reset(jcal_two_dof_t *self)
{
    return (self == NULL) ? JCAL_ERR_ARG : jcal_two_dof_init(self, &self->cfg);
}

jcal_status_t jcal_two_dof_push(jcal_two_dof_t *self, const jcal_orientation_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
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
    if (self->has_best && (cfg->constraint != JCAL_CONSTRAINT_ORIENTATION)) {
        const float sine = self->verdict.sine;
        const float residual = jcal_two_dof_value(features, &self->best.point);
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
    if (self->has_best && (cfg->constraint != JCAL_CONSTRAINT_ROTATION)) {
        const float residual = jcal_two_dof_value(features, &self->best.point) - self->verdict.sine;
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
    self->since_forgot_s += dt_s;
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
        jcal_two_dof_begin_anew(self, JCAL_MOVED);
    }
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
        jcal_two_dof_work(self);
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
    if (self == NULL) {
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

jcal_status_t jcal_two_dof_get(const jcal_two_dof_t *self, jcal_two_dof_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_two_dof_report(&self->verdict, &self->cfg, self->has_best ? &self->best.point : NULL, out);
    jcal_two_dof_report_gate(&self->gate, out);
    out->head.engine = JCAL_ENGINE_STREAM;
    out->head.t_us = self->t_us;
    out->head.overrun = self->kept.ring.overrun;
    return JCAL_OK;
}

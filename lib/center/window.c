/* SPDX-License-Identifier: MIT */
/// @file
/// Window engine of the joint centre: storage, and one Gauss-Newton step over the window for each sample.
#include "jointcal/center_window.h"

#include "center/gravity.h"
#include "center/input.h"
#include "center/judge.h"
#include "center/result.h"
#include "center/sums.h"
#include "joint/watch.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "sample/ring.h"

#include <math.h>

/// Samples before the first step, about 1 s.
#define FIRST_STEP 50u
/// Samples between judgements, about half a second: what the stream engine takes for one.
#define JUDGE_EVERY 25u
/// No step is longer, m.
#define STEP_MAX_M 0.3f
/// What may pass for usual by the watch, times the variance in the config; and where a residual ends to count: a knock is no slip.
#define WATCH_SHARE 5.0f
#define WATCH_MOST 25.0f

/// False for null and for what init has never prepared: all zero, say.
static bool is_prepared(const jcal_center_window_t *self)
{
    return (self != NULL) && (self->storage != NULL) && (self->cfg.n_max > 0u);
}

static jcal_kinematic_t *samples_of(const jcal_center_window_t *self)
{
    return (jcal_kinematic_t *)self->storage;
}

static bool storage_fits(const jcal_center_window_config_t *cfg, const void *storage, size_t bytes)
{
    return (((uintptr_t)storage % sizeof(uint64_t)) == 0u) && (bytes >= jcal_center_window_storage_bytes(cfg));
}

size_t jcal_center_window_storage_bytes(const jcal_center_window_config_t *config)
{
    return (config == NULL) ? 0u : JCAL_CENTER_WINDOW_STORAGE_BYTES(config->n_max);
}

/// Forgets what was learnt of the joint.
static void begin_anew(jcal_center_window_t *self, jcal_calibration_t status)
{
    const jcal_center_gravity_t gravity = self->work.gravity; /* which is the sensors', not the joint's */
    jcal_clear(&self->work, sizeof self->work);
    self->work.gravity = gravity;
    jcal_center_gravity_forget(&self->work.gravity);
    jcal_clear(&self->watch, sizeof self->watch);
    self->next = 0u;
    self->count = 0u;
    self->unjudged = 0u;
    self->has_point = false;
    jcal_center_verdict_begin(&self->work.verdict, status);
}

static void forget(jcal_center_window_t *self)
{
    jcal_center_input_begin(&self->input);
    jcal_clear(&self->work, sizeof self->work);
    self->t_us = 0u;
    begin_anew(self, JCAL_COLLECTING);
}

jcal_status_t jcal_center_window_init(jcal_center_window_t *self, const jcal_center_window_config_t *config,
                                      void *storage, size_t storage_bytes)
{
    if ((self == NULL) || (config == NULL) || (storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_center_window_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    if (!storage_fits(config, storage, storage_bytes)) {
        return JCAL_ERR_STORAGE;
    }
    const jcal_center_window_config_t cfg = *config; /* the caller may hand over self->cfg */
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    self->storage = storage;
    forget(self);
    return JCAL_OK;
}

jcal_status_t jcal_center_window_attach(jcal_center_window_t *self, void *storage, size_t storage_bytes)
{
    if ((self == NULL) || (self->cfg.n_max == 0u) || (storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (!storage_fits(&self->cfg, storage, storage_bytes)) {
        return JCAL_ERR_STORAGE;
    }
    self->storage = storage;
    return JCAL_OK;
}

jcal_status_t jcal_center_window_reset(jcal_center_window_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    forget(self);
    return JCAL_OK;
}

jcal_status_t jcal_center_window_push(jcal_center_window_t *self, const jcal_pair_t *pair)
{
    if (!is_prepared(self) || (pair == NULL) || (self->cfg.center.method == JCAL_CENTER_LS)) {
        return JCAL_ERR_ARG;
    }
    return jcal_center_input_push(&self->input, &self->cfg.center, pair, NULL);
}

jcal_status_t jcal_center_window_push_oriented(jcal_center_window_t *self, const jcal_pair_t *pair,
                                               const jcal_attitudes_t *attitudes)
{
    if (!is_prepared(self) || (pair == NULL) || (attitudes == NULL)) {
        return JCAL_ERR_ARG;
    }
    return jcal_center_input_push(&self->input, &self->cfg.center, pair, attitudes);
}

/// The sample `age` after the oldest.
static const jcal_kinematic_t *sample_at(const jcal_center_window_t *self, uint32_t age)
{
    const uint32_t oldest = (self->count < self->cfg.n_max) ? 0u : self->next;
    return &samples_of(self)[(oldest + age) % self->cfg.n_max];
}

/// The sums at the estimate, over the whole window. With orientations the heading offset is the best one at this place.
/// Returns the newest residual, squared, over what is usual.
static float sum_up(jcal_center_window_t *self)
{
    jcal_center_point_t point = self->work.sums.point;
    if (self->cfg.center.method == JCAL_CENTER_LS) {
        jcal_plane_t heading = {0.0f, 0.0f};
        for (uint32_t i = 0u; i < self->count; ++i) {
            jcal_center_add_heading(sample_at(self, i), &point.place, &heading);
        }
        jcal_center_sums_begin_oriented(&self->work.sums, &point.place, heading);
    } else {
        jcal_center_sums_begin(&self->work.sums, &point.place);
        self->work.sums.point.b1 = point.b1;
        self->work.sums.point.b2 = point.b2;
    }
    float newest = -1.0f;
    for (uint32_t i = 0u; i < self->count; ++i) {
        newest = jcal_center_sums_take(&self->work.sums, &self->cfg.center, sample_at(self, i), WATCH_MOST);
        (void)jcal_center_sums_close(&self->work.sums);
    }
    return newest;
}

/// Moves the estimate by d (12), the heading left out: sum_up finds it.
static void move(jcal_center_point_t *point, const float *d, float share)
{
    point->place.r1 = jcal_vec3_add(point->place.r1, jcal_vec3_scale(jcal_vec3(d[0], d[1], d[2]), share));
    point->place.r2 = jcal_vec3_add(point->place.r2, jcal_vec3_scale(jcal_vec3(d[3], d[4], d[5]), share));
    if (!point->is_oriented) {
        point->b1 = jcal_vec3_add(point->b1, jcal_vec3_scale(jcal_vec3(d[6], d[7], d[8]), share));
        point->b2 = jcal_vec3_add(point->b2, jcal_vec3_scale(jcal_vec3(d[9], d[10], d[11]), share));
    }
}

static void judge(jcal_center_window_t *self)
{
    for (unsigned slice = JCAL_CENTER_SLICE_FACTOR + 1u; slice < JCAL_CENTER_JUDGE_SLICES; ++slice) {
        (void)jcal_center_judge(&self->cfg.center, &self->work, slice);
    }
    if (self->work.verdict.status == (uint8_t)JCAL_READY) {
        jcal_watch_start(&self->watch);
    }
}

/// One Gauss-Newton step, and a judgement when it is due.
static void iterate(jcal_center_window_t *self, float motion_s)
{
    const float newest = sum_up(self);
    if (newest >= 0.0f) {
        jcal_watch_add(&self->watch, 0u, newest / WATCH_SHARE, motion_s);
    }
    if (jcal_watch_alarm(&self->watch)) {
        begin_anew(self, JCAL_MOVED);
        return;
    }
    (void)jcal_center_judge(&self->cfg.center, &self->work, JCAL_CENTER_SLICE_SCALE);
    if (!jcal_center_judge(&self->cfg.center, &self->work, JCAL_CENTER_SLICE_FACTOR)) {
        return;
    }
    jcal_center_solve(&self->cfg.center, &self->work);
    const float *const d = self->work.as.inverse.step;
    const float length =
        sqrtf((d[0] * d[0]) + (d[1] * d[1]) + (d[2] * d[2]) + (d[3] * d[3]) + (d[4] * d[4]) + (d[5] * d[5]));
    if (self->unjudged >= JUDGE_EVERY) {
        self->unjudged = 0u;
        judge(self);
    }
    move(&self->work.sums.point, d, (length > STEP_MAX_M) ? (STEP_MAX_M / length) : 1.0f);
    self->has_point = true;
}

jcal_status_t jcal_center_window_step(jcal_center_window_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    jcal_kinematic_t sample;
    const jcal_center_input_event_t event = jcal_center_input_take(&self->input, &self->cfg.center, &sample);
    if (event == JCAL_CENTER_NONE) {
        return JCAL_IDLE;
    }
    if (event != JCAL_CENTER_SAMPLE) {
        return JCAL_OK;
    }
    samples_of(self)[self->next] = sample;
    self->next = (self->next + 1u) % self->cfg.n_max;
    self->count += (self->count < self->cfg.n_max) ? 1u : 0u;
    self->unjudged += 1u;
    self->t_us = sample.t_us;
    jcal_center_gravity_add(&self->work.gravity, &sample, &self->work.sums.point.place,
                            jcal_center_input_turns(&self->cfg.center));
    if (self->count >= FIRST_STEP) {
        iterate(self, sample.dt_s * jcal_watch_motion(sample.body1.rate2 + sample.body2.rate2));
    }
    return JCAL_OK;
}

jcal_status_t jcal_center_window_update(jcal_center_window_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (uint32_t left = jcal_ring_waiting(&self->input.inbox.ring); left > 0u; --left) {
        (void)jcal_center_window_step(self); /* pushed without a step */
    }
    const jcal_status_t status = jcal_center_window_push(self, pair);
    if (status >= JCAL_OK) {
        (void)jcal_center_window_step(self);
    }
    return status;
}

jcal_status_t jcal_center_window_get(const jcal_center_window_t *self, jcal_center_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    jcal_center_report(&self->cfg.center, &self->work, &self->input, self->has_point, out);
    out->head.engine = JCAL_ENGINE_WINDOW;
    out->head.t_us = self->t_us;
    return JCAL_OK;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Window engine of the hinge: storage, inbox, and the order of work per sample.
#include "jointcal/hinge_window.h"

#include "hinge/stream.h"
#include "hinge/window_cost.h"
#include "hinge/window_solve.h"
#include "joint/head.h"
#include "joint/hysteresis.h"
#include "joint/sign.h"
#include "jointcal/vec3.h"
#include "math/scalar.h"
#include "math/sphere.h"
#include "sample/ring.h"
#include "sample/select.h"

static const float us_per_s = 1e6f;

/* Layout of the storage: slots of the score window, gyroscope rows (n_max), accelerometer rows (n_max + 1). */

static size_t slot_count(const jcal_hinge_window_config_t *cfg)
{
    return (2u * (size_t)cfg->half_window) + 1u;
}

static jcal_score_slot_t *slots(const jcal_hinge_window_t *self)
{
    return (jcal_score_slot_t *)self->storage;
}

static jcal_row_t *gyr_rows(const jcal_hinge_window_t *self)
{
    void *const after = slots(self) + slot_count(&self->cfg);
    return (jcal_row_t *)after;
}

static jcal_row_t *acc_rows(const jcal_hinge_window_t *self)
{
    return gyr_rows(self) + self->cfg.n_max;
}

static bool storage_fits(const jcal_hinge_window_config_t *cfg, const void *storage, size_t bytes)
{
    return (((uintptr_t)storage % sizeof(float)) == 0u) && (bytes >= jcal_hinge_window_storage_bytes(cfg));
}

static jcal_hinge_rows_t selected(const jcal_hinge_window_t *self)
{
    const jcal_row_t *const gyr = gyr_rows(self);
    const jcal_hinge_rows_t rows = {
        {gyr, gyr + self->gyr.low_max},
        {self->gyr.low, self->gyr.high},
        acc_rows(self),
        self->acc.count,
        self->acc.ata,
        self->cfg.w0,
    };
    return rows;
}

size_t jcal_hinge_window_storage_bytes(const jcal_hinge_window_config_t *config)
{
    return (config == NULL) ? 0u : JCAL_HINGE_WINDOW_STORAGE_BYTES(config->n_max, config->half_window);
}

/* No samples are selected, and nothing is concluded from them. */
static void empty(jcal_hinge_window_t *self)
{
    const jcal_hinge_window_config_t *const cfg = &self->cfg;
    jcal_score_init(&self->score, cfg->half_window);
    jcal_select_gyr_init(&self->gyr, cfg->n_max);
    jcal_select_acc_init(&self->acc, cfg->n_max, cfg->acc_min, cfg->energy_max_rad2_s2);
    self->has_axes = false;
    jcal_hinge_window_solve_reset(self);
}

/* Everything but config and storage as it was at the beginning. */
static void forget(jcal_hinge_window_t *self)
{
    const jcal_hinge_window_config_t cfg = self->cfg;
    void *const storage = self->storage;
    *self = (jcal_hinge_window_t){0};
    self->cfg = cfg;
    self->storage = storage;
    jcal_hinge_start(&self->guard, &cfg.hinge);
    empty(self);
}

jcal_status_t jcal_hinge_window_init(jcal_hinge_window_t *self, const jcal_hinge_window_config_t *config, void *storage,
                                     size_t storage_bytes)
{
    if ((self == NULL) || (config == NULL) || (storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_hinge_window_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    if (!storage_fits(config, storage, storage_bytes)) {
        return JCAL_ERR_STORAGE;
    }
    self->cfg = *config;
    self->storage = storage;
    forget(self);
    return JCAL_OK;
}

jcal_status_t jcal_hinge_window_attach(jcal_hinge_window_t *self, void *storage, size_t storage_bytes)
{
    if ((self == NULL) || (storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (!storage_fits(&self->cfg, storage, storage_bytes)) {
        return JCAL_ERR_STORAGE;
    }
    self->storage = storage;
    return JCAL_OK;
}

jcal_status_t jcal_hinge_window_push(jcal_hinge_window_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_room(&self->guard.inbox.ring, &slot)) {
        return JCAL_ERR_FULL;
    }
    const uint32_t id = self->guard.gate.samples;
    if (jcal_gate_check(&self->guard.gate, &self->cfg.hinge.gate, pair) != JCAL_REJECT_NONE) {
        return JCAL_REJECTED;
    }
    self->inbox_ids[slot] = id;
    self->guard.inbox.slots[slot] = *pair;
    jcal_ring_publish(&self->guard.inbox.ring);
    return JCAL_OK;
}

/* Windows start anew after a gap; the time of the next full solve starts with the first sample. */
static void keep_time(jcal_hinge_window_t *self, uint64_t t_us)
{
    const uint64_t gap_us = (uint64_t)(self->cfg.hinge.gate.gap_s * us_per_s);
    if (!self->has_stepped) {
        self->has_stepped = true;
        self->solve_due_us = t_us + (uint64_t)(self->cfg.solve_period_s * us_per_s);
    } else if ((t_us - self->stepped_us) > gap_us) {
        jcal_score_restart(&self->score);
    } else {
        /* Continuous. */
    }
    const uint64_t period_us = (uint64_t)(self->cfg.solve_period_s * us_per_s);
    if (t_us < self->stepped_us) { /* a clock that began anew */
        self->solve_due_us = t_us + period_us;
    }
    self->stepped_us = t_us;
}

static void solve_when_due(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows, uint64_t t_us)
{
    if ((t_us >= self->solve_due_us) && jcal_hinge_window_solve_begin(self, rows)) {
        const uint64_t period_us = (uint64_t)(self->cfg.solve_period_s * us_per_s);
        const uint64_t due_us = self->solve_due_us + period_us;
        self->solve_due_us = (due_us > t_us) ? due_us : (t_us + period_us);
        /* The updates of A^T A since the last solve rounded a little each. */
        jcal_select_acc_refresh(&self->acc, acc_rows(self));
    }
}

/// A sample to both selections. Apart from the step, as is follow_status, so that what they hold shares its stack.
static void offer(jcal_hinge_window_t *self, const jcal_pair_t *pair, uint32_t id)
{
    jcal_scored_t scored;
    if (jcal_score_push(&self->score, slots(self), pair, id, &scored)) {
        jcal_select_gyr_offer(&self->gyr, gyr_rows(self), &scored.gyr);
        jcal_select_acc_offer(&self->acc, acc_rows(self), &scored.acc);
    }
}

/// Remembers whether the status is `ready`.
static void follow_status(jcal_hinge_window_t *self)
{
    jcal_hinge_result_t result;
    self->was_ready = (jcal_hinge_window_get(self, &result) == JCAL_OK) && (result.head.status == JCAL_READY);
}

jcal_status_t jcal_hinge_window_step(jcal_hinge_window_t *self)
{
    if ((self == NULL) || (self->storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    uint32_t slot;
    if (!jcal_ring_peek(&self->guard.inbox.ring, &slot)) {
        return JCAL_IDLE;
    }
    const jcal_pair_t pair = self->guard.inbox.slots[slot];
    const uint32_t id = self->inbox_ids[slot];
    jcal_ring_release(&self->guard.inbox.ring);
    keep_time(self, pair.t_us);
    offer(self, &pair, id);
    const jcal_hinge_rows_t rows = selected(self);
    jcal_hinge_window_follow(self, &rows);
    solve_when_due(self, &rows, pair.t_us);
    for (uint32_t slice = 0u; slice < JCAL_HINGE_WINDOW_SLICES; ++slice) {
        jcal_hinge_window_solve_slice(self, &rows);
    }
    const bool knew = self->guard.coarse.has_point;
    jcal_hinge_take(&self->guard, &pair);
    if (knew && !self->guard.coarse.has_point) { /* a sensor has moved: what was selected is of another joint */
        empty(self);
    }
    follow_status(self);
    return JCAL_OK;
}

jcal_status_t jcal_hinge_window_update(jcal_hinge_window_t *self, const jcal_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (uint32_t left = jcal_ring_waiting(&self->guard.inbox.ring); left > 0u; --left) {
        (void)jcal_hinge_window_step(self); /* pushed without a step */
    }
    const jcal_status_t status = jcal_hinge_window_push(self, pair);
    if (status == JCAL_OK) {
        (void)jcal_hinge_window_step(self);
    }
    return status;
}

/// The guard's verdict on this engine's axes: each bound grows by the angle between the two engines' axes, and the
/// status is `ready` only where both agree on the pairing and the bounds still hold.
static void judge_beside_guard(const jcal_hinge_window_t *self, jcal_hinge_result_t *result)
{
    const jcal_vec3_t guard1 = self->guard.refine.point.axis1.j;
    const jcal_vec3_t guard2 = self->guard.refine.point.axis2.j;
    const float apart1 = jcal_sphere_line_angle(guard1, result->axis1);
    const float apart2 = jcal_sphere_line_angle(guard2, result->axis2);
    result->uncertainty1_rad = jcal_min(result->uncertainty1_rad + apart1, JCAL_BOUND_UNKNOWN_RAD);
    result->uncertainty2_rad = jcal_min(result->uncertainty2_rad + apart2, JCAL_BOUND_UNKNOWN_RAD);
    if (result->head.status != JCAL_READY) {
        return;
    }
    const bool same_pairing = (jcal_vec3_dot(guard1, result->axis1) * jcal_vec3_dot(guard2, result->axis2)) > 0.0f;
    const float worst_rad = jcal_max(result->uncertainty1_rad, result->uncertainty2_rad);
    const float limit_rad = (self->was_ready ? JCAL_HYSTERESIS : 1.0f) * self->cfg.hinge.max_bound_rad;
    if (!same_pairing) {
        result->head.status = JCAL_AMBIGUOUS;
        result->head.reason = JCAL_REASON_SIGN_OPEN;
        result->head.weak = JCAL_WEAK_SIGN;
        result->head.hint = JCAL_HINT_TILT_AXIS;
    } else if (worst_rad > limit_rad) {
        result->head.status = JCAL_COLLECTING;
        result->head.reason = JCAL_REASON_UNCERTAIN;
        result->head.weak = (result->uncertainty1_rad >= worst_rad) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2;
        result->head.hint = JCAL_HINT_MOVE_JOINT;
    } else {
        /* Both engines agree. */
    }
}

/// This engine has no axes yet, whatever the guard knows of its own.
static void say_no_axes(jcal_hinge_result_t *result)
{
    result->axis1 = jcal_vec3(0.0f, 0.0f, 0.0f);
    result->axis2 = jcal_vec3(0.0f, 0.0f, 0.0f);
    result->uncertainty1_rad = JCAL_BOUND_UNKNOWN_RAD;
    result->uncertainty2_rad = JCAL_BOUND_UNKNOWN_RAD;
    result->head.status = (result->head.status == JCAL_MOVED) ? JCAL_MOVED : JCAL_COLLECTING;
    if (result->head.reason == JCAL_REASON_NONE) { /* the guard is ready: samples wait for the next full solve */
        result->head.reason = JCAL_REASON_NO_DATA;
        result->head.weak = JCAL_WEAK_AXIS1;
        result->head.hint = JCAL_HINT_MOVE_JOINT;
    }
}

jcal_status_t jcal_hinge_window_get(const jcal_hinge_window_t *self, jcal_hinge_result_t *out)
{
    jcal_hinge_result_t result;
    if ((self == NULL) || (out == NULL) || (jcal_hinge_get(&self->guard, &result) != JCAL_OK)) {
        return JCAL_ERR_ARG;
    }
    const float sign = jcal_sign_of(self->axes.j[0], self->cfg.hinge.axis1_toward, self->guard.kept_sign[0]);
    result.head.engine = JCAL_ENGINE_WINDOW;
    result.axis1 = jcal_vec3_scale(self->axes.j[0], sign);
    result.axis2 = jcal_vec3_scale(self->axes.j[1], sign);
    result.sign_margin = self->sign_margin;
    result.paper_accepted = self->accept.accepted;
    result.has_axes = result.has_axes && self->has_axes;
    if (result.has_axes) {
        judge_beside_guard(self, &result);
    } else {
        say_no_axes(&result);
    }
    result.progress_axis1 = jcal_head_progress(result.uncertainty1_rad, self->cfg.hinge.max_bound_rad);
    result.progress_axis2 = jcal_head_progress(result.uncertainty2_rad, self->cfg.hinge.max_bound_rad);
    *out = result;
    return JCAL_OK;
}

jcal_status_t jcal_hinge_window_reset(jcal_hinge_window_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    forget(self);
    return JCAL_OK;
}

static void copy_ids(const jcal_row_t *rows, size_t count, uint32_t *ids)
{
    for (size_t k = 0u; k < count; ++k) {
        ids[k] = rows[k].id;
    }
}

jcal_status_t jcal_hinge_window_selection(const jcal_hinge_window_t *self, uint32_t *gyr, size_t *n_gyr, uint32_t *acc,
                                          size_t *n_acc)
{
    if ((self == NULL) || (gyr == NULL) || (n_gyr == NULL) || (acc == NULL) || (n_acc == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_hinge_rows_t rows = selected(self);
    if ((*n_gyr < (rows.n_gyr[0] + rows.n_gyr[1])) || (*n_acc < rows.n_acc)) {
        return JCAL_ERR_ARG;
    }
    copy_ids(rows.gyr[0], rows.n_gyr[0], gyr);
    copy_ids(rows.gyr[1], rows.n_gyr[1], &gyr[rows.n_gyr[0]]);
    copy_ids(rows.acc, rows.n_acc, acc);
    *n_gyr = rows.n_gyr[0] + rows.n_gyr[1];
    *n_acc = rows.n_acc;
    return JCAL_OK;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Window engine of the 2-DoF joint: storage, and orientations into rows.
#include "jointcal/two_dof_window.h"

#include "jointcal/quat.h"
#include "math/clear.h"
#include "sample/rate.h"
#include "two_dof/result.h"
#include "two_dof/verdict.h"
#include "two_dof/window_solve.h"

#define MICROSECONDS 1e-6f

/// Orientations are kept this far apart, us: 20 Hz, section 4.4 of [LAI22].
#define KEEP_US 50000u
/// Two kept orientations further apart than this have no rate between them, s.
#define APART_MAX_S 0.12f

static jcal_two_dof_row_t *rows_of(const jcal_two_dof_window_t *self)
{
    return (jcal_two_dof_row_t *)self->storage;
}

static bool storage_fits(const jcal_two_dof_window_config_t *cfg, const void *storage, size_t bytes)
{
    return (((uintptr_t)storage % sizeof(uint64_t)) == 0u) && (bytes >= jcal_two_dof_window_storage_bytes(cfg));
}

size_t jcal_two_dof_window_storage_bytes(const jcal_two_dof_window_config_t *config)
{
    return JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(config->n_max);
}

/* Everything but config and storage as it was at the beginning. */
static void forget(jcal_two_dof_window_t *self)
{
    const jcal_two_dof_window_config_t cfg = self->cfg;
    void *const storage = self->storage;
    jcal_clear(self, sizeof *self);
    self->cfg = cfg;
    self->storage = storage;
    jcal_two_dof_verdict_begin(&self->verdict, JCAL_COLLECTING);
}

jcal_status_t jcal_two_dof_window_init(jcal_two_dof_window_t *self, const jcal_two_dof_window_config_t *config,
                                       void *storage, size_t storage_bytes)
{
    if ((self == NULL) || (config == NULL) || (storage == NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_two_dof_window_config_check(config) != NULL) {
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

jcal_status_t jcal_two_dof_window_attach(jcal_two_dof_window_t *self, void *storage, size_t storage_bytes)
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

jcal_status_t jcal_two_dof_window_reset(jcal_two_dof_window_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    forget(self);
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_window_push(jcal_two_dof_window_t *self, const jcal_orientation_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    const uint32_t at = self->written;
    if (at != self->taken) {
        return JCAL_ERR_FULL; /* the three before it are still needed */
    }
    if (jcal_orientation_gate_check(&self->gate, &self->cfg.two_dof.gate, pair) != JCAL_REJECT_NONE) {
        return JCAL_REJECTED;
    }
    if ((at > 0u) && ((pair->t_us - self->ring[(at - 1u) % JCAL_TWO_DOF_RING].t_us) < KEEP_US)) {
        return JCAL_OK;
    }
    jcal_orientation_pair_t *const slot = &self->ring[at % JCAL_TWO_DOF_RING];
    slot->t_us = pair->t_us;
    slot->q1 = jcal_quat_normalise(pair->q1);
    slot->q2 = jcal_quat_normalise(pair->q2);
    self->written = at + 1u;
    return JCAL_OK;
}

/// The row in the middle of the last three kept; false if there is none.
static bool middle(const jcal_two_dof_window_t *self, jcal_two_dof_row_t *row)
{
    if (self->taken < 3u) {
        return false;
    }
    const jcal_orientation_pair_t *const before = &self->ring[(self->taken - 3u) % JCAL_TWO_DOF_RING];
    const jcal_orientation_pair_t *const at = &self->ring[(self->taken - 2u) % JCAL_TWO_DOF_RING];
    const jcal_orientation_pair_t *const after = &self->ring[(self->taken - 1u) % JCAL_TWO_DOF_RING];
    const float to_s = (float)(at->t_us - before->t_us) * MICROSECONDS;
    const float on_s = (float)(after->t_us - at->t_us) * MICROSECONDS;
    if ((to_s > APART_MAX_S) || (on_s > APART_MAX_S)) {
        return false;
    }
    row->t_us = at->t_us;
    row->q1 = at->q1;
    row->q2 = at->q2;
    row->w1 = jcal_rate_between(before->q1, after->q1, to_s + on_s);
    row->w2 = jcal_rate_between(before->q2, after->q2, to_s + on_s);
    row->dt_s = 0.5f * (to_s + on_s);
    return true;
}

jcal_status_t jcal_two_dof_window_step(jcal_two_dof_window_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    if (self->written == self->taken) {
        return JCAL_IDLE;
    }
    self->taken = self->taken + 1u;
    jcal_two_dof_row_t *const newest = &rows_of(self)[self->next];
    if (!middle(self, newest)) {
        return JCAL_OK;
    }
    const uint16_t n_max = self->cfg.n_max;
    self->next = (uint16_t)((self->next + 1u) % n_max);
    self->count = (uint16_t)((self->count < n_max) ? (self->count + 1u) : n_max);
    if ((2u * (uint32_t)self->count) >= n_max) {
        const jcal_two_dof_rows_t rows = {rows_of(self), self->count, &self->cfg.two_dof, self->gate.bad_share};
        jcal_two_dof_window_work(&self->search, &self->verdict, &rows, newest);
    }
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_window_update(jcal_two_dof_window_t *self, const jcal_orientation_pair_t *pair)
{
    if ((self != NULL) && (pair != NULL) && (self->written != self->taken)) {
        (void)jcal_two_dof_window_step(self); /* a push without a step: make room */
    }
    const jcal_status_t status = jcal_two_dof_window_push(self, pair);
    if (status >= JCAL_OK) {
        (void)jcal_two_dof_window_step(self);
    }
    return status;
}

/// Row number `k`, oldest first.
static const jcal_two_dof_row_t *row_at(const jcal_two_dof_window_t *self, size_t k)
{
    const size_t first = (self->count < self->cfg.n_max) ? 0u : self->next;
    return &rows_of(self)[(first + k) % self->cfg.n_max];
}

jcal_status_t jcal_two_dof_window_get(const jcal_two_dof_window_t *self, jcal_two_dof_result_t *out)
{
    if ((self == NULL) || (out == NULL)) {
        return JCAL_ERR_ARG;
    }
    const jcal_two_dof_point_t *const point = self->search.has_best ? &self->search.best.point : NULL;
    jcal_two_dof_report(&self->verdict, &self->cfg.two_dof, point, out);
    jcal_two_dof_report_gate(&self->gate, out);
    out->head.engine = JCAL_ENGINE_WINDOW;
    out->head.t_us = (self->count > 0u) ? row_at(self, (size_t)self->count - 1u)->t_us : 0u;
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_window_kept(const jcal_two_dof_window_t *self, uint64_t *t_us, size_t *count)
{
    if ((self == NULL) || (t_us == NULL) || (count == NULL) || (*count < self->count)) {
        return JCAL_ERR_ARG;
    }
    for (size_t k = 0u; k < self->count; ++k) {
        t_us[k] = row_at(self, k)->t_us;
    }
    *count = self->count;
    return JCAL_OK;
}

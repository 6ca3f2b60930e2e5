/* SPDX-License-Identifier: MIT */
/// @file
/// Window engine of the 2-DoF joint: storage, and orientations into rows.
#include "jointcal/two_dof_window.h"

#include "math/clear.h"
#include "sample/clock.h"
#include "sample/ring.h"
#include "two_dof/kept.h"
#include "two_dof/result.h"
#include "two_dof/verdict.h"
#include "two_dof/window_solve.h"

/// Orientations are kept this far apart, us: 20 Hz, section 4.4 of [LAI22].
#define KEEP_US 50000u

/// False for null and for what init has never prepared: all zero, say.
static bool is_prepared(const jcal_two_dof_window_t *self)
{
    return (self != NULL) && (self->storage != NULL) && (self->cfg.n_max > 0u);
}

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
    return (config == NULL) ? 0u : JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(config->n_max);
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
    if ((self == NULL) || (self->cfg.n_max == 0u) || (storage == NULL)) {
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
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    forget(self);
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_window_push(jcal_two_dof_window_t *self, const jcal_orientation_pair_t *pair)
{
    if (!is_prepared(self) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    return jcal_two_dof_keep(&self->kept, &self->gate, &self->cfg.two_dof.gate, pair, KEEP_US);
}

/// After a clock that began anew the rows before it get times as if it had not: the newest of them is that much older than this one,
/// modulo 2^64 us, that their ages stay right.
static void keep_times(jcal_two_dof_window_t *self, uint64_t t_us)
{
    if (self->count == 0u) {
        return;
    }
    const uint64_t newest_us = rows_of(self)[((uint32_t)self->next + self->cfg.n_max - 1u) % self->cfg.n_max].t_us;
    const bool is_later = (t_us - newest_us) < (UINT64_MAX / 2u);
    for (uint32_t k = 0u; !is_later && (k < self->count); ++k) {
        rows_of(self)[k].t_us += t_us - newest_us - JCAL_CLOCK_ANEW_US;
    }
}

jcal_status_t jcal_two_dof_window_step(jcal_two_dof_window_t *self)
{
    if (!is_prepared(self)) {
        return JCAL_ERR_ARG;
    }
    unsigned pushes;
    if (!jcal_two_dof_take(&self->kept, &pushes)) {
        return JCAL_IDLE;
    }
    jcal_two_dof_middle_t middle;
    if (!jcal_two_dof_middle(&self->kept, &middle)) {
        return JCAL_OK;
    }
    keep_times(self, middle.at->t_us);
    jcal_two_dof_row_t *const newest = &rows_of(self)[self->next];
    const jcal_two_dof_row_t row = {.t_us = middle.at->t_us,
                                    .q1 = middle.at->q1,
                                    .q2 = middle.at->q2,
                                    .w1 = middle.w1,
                                    .w2 = middle.w2,
                                    .dt_s = middle.dt_s};
    *newest = row;
    const uint16_t n_max = self->cfg.n_max;
    self->next = (uint16_t)((self->next + 1u) % n_max);
    self->count = (uint16_t)((self->count < n_max) ? (self->count + 1u) : n_max);
    if ((2u * (uint32_t)self->count) >= n_max) {
        const jcal_two_dof_rows_t rows = {rows_of(self), self->count, &self->cfg.two_dof,
                                          jcal_orientation_gate_complaint(&self->gate)};
        jcal_two_dof_window_work(&self->search, &self->verdict, &rows, newest);
    }
    return JCAL_OK;
}

jcal_status_t jcal_two_dof_window_update(jcal_two_dof_window_t *self, const jcal_orientation_pair_t *pair)
{
    if ((self == NULL) || (pair == NULL)) {
        return JCAL_ERR_ARG;
    }
    for (uint32_t left = jcal_ring_waiting(&self->kept.ring); left > 0u; --left) {
        (void)jcal_two_dof_window_step(self); /* pushed without a step */
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
    out->head.overrun = self->kept.ring.overrun;
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

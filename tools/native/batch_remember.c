/* SPDX-License-Identifier: MIT */
/* Runs a remembered hinge over ticks. */
#include "batch_remember.h"

#include <string.h>

static jcal_vec3_t vector(const float *v)
{
    const jcal_vec3_t out = {v[0], v[1], v[2]};
    return out;
}

static jcal_tick_t tick_of(const float *row, uint64_t t_us)
{
    jcal_tick_t tick;
    memset(&tick, 0, sizeof(tick));
    tick.t_us = t_us;
    memcpy(tick.turn, row, sizeof(tick.turn));
    memcpy(tick.rate, row + 9, sizeof(tick.rate));
    memcpy(tick.lever, row + 18, sizeof(tick.lever));
    tick.velocity = vector(row + 27);
    tick.gyr = vector(row + 30);
    tick.acc_level_m_s2 = row[33];
    tick.dt_s = row[34];
    tick.since_s = row[35];
    tick.epoch = (uint32_t)row[36];
    return tick;
}

static jcal_kept_t kept_of(const float *v)
{
    jcal_kept_t kept;
    memset(&kept, 0, sizeof(kept));
    kept.kind = JCAL_KEPT_HINGE;
    kept.serial1 = 1;
    kept.serial2 = 2;
    kept.axis1 = vector(v);
    kept.axis2 = vector(v + 3);
    kept.bound1_rad = v[6];
    kept.bound2_rad = v[7];
    kept.lever1_m = vector(v + 8);
    kept.lever2_m = vector(v + 11);
    kept.has_levers = v[14] > 0.0F;
    kept.model = (v[15] > 0.0F) ? JCAL_MODEL_RIGID : JCAL_MODEL_FUNCTIONAL;
    return kept;
}

static void write_row(const jcal_remember_t *self, float row[static JCAL_BATCH_REMEMBER_COLUMNS])
{
    jcal_remember_result_t result;
    (void)jcal_remember_get(self, &result);
    const float all[JCAL_BATCH_REMEMBER_COLUMNS] = {
        (float)result.state, (float)result.reason, result.bound1_rad, result.bound2_rad, result.motion_s,
        self->off1_rad,      self->off2_rad,       self->sigma1_rad,  self->sigma2_rad,  self->lack,
        self->speed_m_s,     self->evidence,       self->bend_rad};
    memcpy(row, all, sizeof(all));
}

int32_t jcal_batch_remember(const jcal_batch_remember_in_t *in, float *rows)
{
    jcal_remember_t self;
    const jcal_kept_t kept = kept_of(in->kept);
    if (jcal_remember_init(&self, &kept, JCAL_KEPT_FITS) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    for (size_t k = 0; k < in->count; k++) {
        const jcal_tick_t tick1 = tick_of(in->ticks1 + k * JCAL_BATCH_TICK_COLUMNS, in->t_us[k]);
        const jcal_tick_t tick2 = tick_of(in->ticks2 + k * JCAL_BATCH_TICK_COLUMNS, in->t_us[k]);
        (void)jcal_remember_add(&self, &tick1, &tick2);
        while (jcal_remember_step(&self) == JCAL_OK) {
        }
        write_row(&self, rows + k * JCAL_BATCH_REMEMBER_COLUMNS);
        self.state = (in->goes_on != 0) ? (uint8_t)JCAL_REMEMBERED : self.state;
    }
    return JCAL_BATCH_DONE;
}

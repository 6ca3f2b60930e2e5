/* SPDX-License-Identifier: MIT */
/* A pair session of the hub. See hub_pair.h. */
#include "hub_pair.h"

#include <math.h>
#include <string.h>

bool hub_pair_begin(hub_pair_t *self, const message_start_t *start)
{
    memset(self, 0, sizeof *self);
    jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    self->config = *start;
    config.hinge.max_bound_rad = start->max_bound_rad;
    config.hinge.sign_hint = (jcal_sign_hint_t)start->sign_hint;
    self->status = JCAL_COLLECTING;
    self->running = jcal_hinge_auto_init(&self->hinge, &config) == JCAL_OK;
    return self->running;
}

/* A sample without a time becomes one without a rate, which the library counts as not finite. */
static bool push(hub_pair_t *self, const jcal_pair_t *pair)
{
    jcal_pair_t known = *pair;
    if (pair->t_us == MESSAGE_TIME_UNKNOWN) {
        known.t_us = self->pair_us;
        known.imu1.gyr_rad_s.x = NAN;
    }
    self->pair_us = known.t_us;
    return jcal_hinge_auto_push(&self->hinge, &known) == JCAL_OK;
}

void hub_pair_estimate(hub_pair_t *self, hub_out_t *out, uint8_t events, uint32_t token)
{
    message_estimate_t estimate = {
        .events = events, .token = token, .now_us = self->has_time ? self->latest_us : MESSAGE_TIME_UNKNOWN};
    frame_writer_t payload;
    (void)jcal_hinge_auto_get(&self->hinge, &estimate.result);
    message_write_estimate(&payload, &estimate);
    hub_out_put(out, FRAME_ESTIMATE, &payload);
}

void hub_pair_count(const hub_pair_t *self, message_counters_t *counters)
{
    jcal_hinge_auto_result_t all;
    (void)jcal_hinge_auto_get(&self->hinge, &all);
    counters->samples = all.hinge.head.samples;
    memcpy(counters->rejected_by, all.hinge.head.rejected_by, sizeof counters->rejected_by);
}

/* True once per period of sample time. */
static bool estimate_due(hub_pair_t *self, uint64_t t_us)
{
    const uint64_t every_us = self->config.every_us;
    if (t_us != MESSAGE_TIME_UNKNOWN) {
        if (!self->has_time) {
            self->has_time = true;
            self->latest_us = t_us;
            self->next_us = t_us + every_us;
        }
        self->latest_us = (t_us > self->latest_us) ? t_us : self->latest_us;
    }
    if (every_us == 0 || !self->has_time || self->latest_us < self->next_us) {
        return false;
    }
    self->next_us += every_us * (1u + (self->latest_us - self->next_us) / every_us);
    return true;
}

bool hub_pair_sample(hub_pair_t *self, hub_out_t *out, const jcal_pair_t *pair)
{
    jcal_hinge_auto_result_t result;
    if (push(self, pair)) {
        (void)jcal_hinge_auto_step(&self->hinge);
    }
    (void)jcal_hinge_auto_get(&self->hinge, &result);
    const jcal_calibration_t status = result.hinge.head.status;
    uint8_t events = 0;
    if (status != self->status && status == JCAL_READY) {
        events |= MESSAGE_EVENT_READY;
    }
    if (status != self->status && status == JCAL_MOVED) {
        events |= MESSAGE_EVENT_MOVED;
    }
    self->status = status;
    const bool due = estimate_due(self, pair->t_us);
    if (due) {
        events |= MESSAGE_EVENT_DUE;
    }
    if (events != 0) {
        hub_pair_estimate(self, out, events, 0);
    }
    return due;
}

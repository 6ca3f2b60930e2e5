/* SPDX-License-Identifier: MIT */
/* Rows of a recording as pairs of orientations. */
#include "orientations.h"

#include "message.h"

#ifdef JCAL_CLI_HAS_VQF
#include "jcal_vqf.h"
#endif

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Missing rows are filled in up to this many; more are a gap. */
#define FILL_MAX 50u

struct orientations {
    recording_t *recording;
    timeline_t timeline;
    bool from_columns;
    recording_row_t ahead[ORIENTATIONS_AHEAD];
    size_t ahead_count, ahead_at;
    recording_event_t ahead_end; /* why no more rows were held back */
    bool has_period;
    uint64_t period_us;
    uint64_t fed_us; /* the library's time of the last row that the filters have */
    jcal_gate_t gate;
    jcal_gate_config_t gate_config;
    jcal_pair_t last; /* the last reading that was accepted */
    bool has_last;
#ifdef JCAL_CLI_HAS_VQF
    jcal_vqf_t filters[2];
#endif
    jcal_quat_t q[2];
};

bool orientations_possible(const input_t *input, const recording_t *recording)
{
    if (recording->lacks[0] != '\0') {
        complain(input->name, 1, 0, "some columns of orientations are there, but not %s", recording->lacks);
        return false;
    }
#ifndef JCAL_CLI_HAS_VQF
    if (!recording->has_orientations) {
        complain(
            input->name, 1, 0,
            "missing columns q1_w ... q2_z, and this program was built without the filter VQF that would find them: "
            "run tools/vqf.sh and build again with a C++ compiler");
        return false;
    }
#endif
    return true;
}

orientations_t *orientations_open(recording_t *recording)
{
    orientations_t *self = calloc(1, sizeof *self);
    if (self != NULL) {
        self->recording = recording;
        self->from_columns = recording->has_orientations;
        recording->want_orientations = self->from_columns;
        self->gate_config = jcal_gate_config_default();
        jcal_gate_init(&self->gate);
        self->q[0] = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
        self->q[1] = self->q[0];
    }
    return self;
}

bool orientations_from_columns(const orientations_t *orientations)
{
    return orientations->from_columns;
}

void orientations_close(orientations_t *orientations)
{
    free(orientations);
}

static int compare(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

/* Median of the time steps of the rows held back; 0 if there are none. */
static uint64_t median_step(const orientations_t *self)
{
    int64_t steps[ORIENTATIONS_AHEAD];
    size_t count = 0;
    for (size_t k = 1; k < self->ahead_count; k++) {
        const recording_row_t *row = &self->ahead[k];
        if (row->has_time && row[-1].has_time && row->t_us > row[-1].t_us) {
            steps[count] = row->t_us - row[-1].t_us;
            count++;
        }
    }
    if (count == 0) {
        return 0;
    }
    qsort(steps, count, sizeof steps[0], compare);
    return (uint64_t)steps[count / 2];
}

#ifdef JCAL_CLI_HAS_VQF
/* False if VQF cannot work with this period. */
static bool start_filters(orientations_t *self)
{
    const float period_s = 1e-6f * (float)self->period_us;
    return jcal_vqf_init(&self->filters[0], period_s, period_s) == JCAL_OK &&
           jcal_vqf_init(&self->filters[1], period_s, period_s) == JCAL_OK;
}

static void feed_one(jcal_vqf_t *filter, const jcal_imu_t *imu, jcal_quat_t *q)
{
    const float gyr[3] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z};
    const float acc[3] = {imu->acc_m_s2.x, imu->acc_m_s2.y, imu->acc_m_s2.z};
    float quat[4];
    if (jcal_vqf_update(filter, gyr, acc, quat) == JCAL_OK) {
        *q = (jcal_quat_t){quat[0], quat[1], quat[2], quat[3]};
    }
}

static void feed(orientations_t *self, const jcal_pair_t *reading)
{
    feed_one(&self->filters[0], &reading->imu1, &self->q[0]);
    feed_one(&self->filters[1], &reading->imu2, &self->q[1]);
}
#else
static bool start_filters(orientations_t *self)
{
    (void)self;
    return false;
}

static void feed(orientations_t *self, const jcal_pair_t *reading)
{
    (void)self;
    (void)reading;
}
#endif

/* Holds the first rows back and finds their period. Says what is wrong in the recording's fault. */
static recording_event_t look_ahead(orientations_t *self)
{
    self->ahead_end = RECORDING_ROW;
    while (self->ahead_count < ORIENTATIONS_AHEAD) {
        self->ahead_end = recording_next(self->recording, &self->ahead[self->ahead_count]);
        if (self->ahead_end != RECORDING_ROW) {
            break;
        }
        self->ahead_count++;
    }
    self->has_period = true;
    self->period_us = median_step(self);
    if (self->period_us == 0) {
        return RECORDING_ROW; /* nothing that could be filtered: every row will be refused, or there is one at most */
    }
    if (!start_filters(self)) {
        recording_fault_t *fault = &self->recording->fault;
        fault->line = 0;
        fault->column = 0;
        (void)snprintf(fault->text, sizeof fault->text,
                       "a sample period of %g s: orientations can be found from 10 to 10000 samples a second",
                       1e-6 * (double)self->period_us);
        return RECORDING_BAD;
    }
    return RECORDING_ROW;
}

static recording_event_t next_row(orientations_t *self, recording_row_t *row)
{
    if (self->ahead_at < self->ahead_count) {
        *row = self->ahead[self->ahead_at];
        self->ahead_at++;
        return RECORDING_ROW;
    }
    if (self->ahead_end != RECORDING_ROW) {
        return self->ahead_end;
    }
    return recording_next(self->recording, row);
}

/* Gives the filters what they have missed since they were fed last, then this reading. */
static void filter(orientations_t *self, const jcal_pair_t *pair)
{
    if (self->period_us == 0) {
        return;
    }
    if (self->has_last) {
        const uint64_t missing = (pair->t_us - self->fed_us + self->period_us / 2) / self->period_us;
        for (uint64_t k = 1; k < missing && missing <= FILL_MAX; k++) {
            feed(self, &self->last);
        }
    }
    feed(self, pair);
    self->last = *pair;
    self->has_last = true;
    self->fed_us = pair->t_us;
}

recording_event_t orientations_next(orientations_t *orientations, oriented_row_t *out)
{
    orientations_t *self = orientations;
    if (!self->from_columns && !self->has_period) {
        const recording_event_t event = look_ahead(self);
        if (event != RECORDING_ROW) {
            return event;
        }
    }
    const recording_event_t event =
        self->from_columns ? recording_next(self->recording, &out->row) : next_row(self, &out->row);
    if (event != RECORDING_ROW) {
        return event;
    }
    recording_row_t *row = &out->row;
    jcal_pair_t reading = {timeline_advance(&self->timeline, row), row->imu1, row->imu2};
    out->timeline = self->timeline;
    out->pair.t_us = reading.t_us;
    if (self->from_columns) {
        out->reject = JCAL_REJECT_NONE;
        out->pair.q1 = row->q1;
        out->pair.q2 = row->q2;
        if (!row->has_time) {
            out->pair.q1.w = NAN; /* the library's time has no NaN; the sample has */
        }
        return RECORDING_ROW;
    }
    if (!row->has_time) {
        reading.imu1.gyr_rad_s.x = NAN;
    }
    out->reject = jcal_gate_check(&self->gate, &self->gate_config, &reading);
    if (out->reject == JCAL_REJECT_NONE || out->reject == JCAL_REJECT_GAP || out->reject == JCAL_REJECT_REPEATED) {
        filter(self, &reading);
    }
    out->pair.q1 = self->q[0];
    out->pair.q2 = self->q[1];
    return RECORDING_ROW;
}

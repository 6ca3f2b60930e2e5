/* SPDX-License-Identifier: MIT */
/* Orientations of the rows of a recording. */
#include "input/orientations.h"

#include "jointcal/vec3.h"

#ifdef JOINTCAL_HAS_VQF
#include "jcal_vqf.h"
#endif

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Longest time from sample to sample that is filled, and the period of a recording that shows none. */
#define BRIDGE_US 150000
#define USUAL_PERIOD_US 10000

/* What the gate says of a row; true if a filter may have it. */
static bool is_fed(orientations_t *self, oriented_row_t *out)
{
    const recording_row_t *row = &out->row;
    jcal_pair_t pair = {row_clock_advance(&self->clock, row), row->imu1, row->imu2};
    if (!row->has_time) {
        /* The library's time has no NaN; the sample has. */
        pair.imu1.gyr_rad_s.x = NAN;
    }
    out->reject = jcal_gate_check(&self->gate, &self->gate_config, &pair);
    if (self->recording->want_third) {
        const jcal_pair_t other = {pair.t_us, pair.imu1, row->imu3};
        const jcal_reject_t third = jcal_gate_check(&self->gate3, &self->gate_config, &other);
        out->reject = (third < out->reject) ? third : out->reject;
    }
    return out->reject == JCAL_REJECT_NONE || out->reject == JCAL_REJECT_SATURATED ||
           out->reject == JCAL_REJECT_REPEATED || out->reject == JCAL_REJECT_GAP;
}

/* A restart is told with the first row after it that is of use. */
static void tell_restart(orientations_t *self, oriented_row_t *out)
{
    out->restarted = self->restart_due && out->reject == JCAL_REJECT_NONE;
    self->restart_due = self->restart_due && !out->restarted;
}

/* A row for an engine that has filters of its own: holes are looked for as with a filter. */
static void pass_row(orientations_t *self, oriented_row_t *out)
{
    if (is_fed(self, out)) {
        self->restart_due = self->restart_due || (self->has_fed && out->row.t_us - self->fed_us > BRIDGE_US);
        self->has_fed = true;
        self->fed_us = out->row.t_us;
    }
    tell_restart(self, out);
}

#ifdef JOINTCAL_HAS_VQF

struct orientations_filter {
    jcal_vqf_t vqf;
    jcal_imu_t last;
    jcal_quat_t q;
};

static int compare(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

/* Median of the time steps that lead forward. */
static int64_t usual_step_us(const recording_row_t *rows, size_t count)
{
    int64_t steps[ORIENTATIONS_WAIT] = {USUAL_PERIOD_US}; /* stays where nothing leads forward */
    size_t n = 0;
    for (size_t k = 1; k < count; k++) {
        if (rows[k].has_time && rows[k - 1].has_time && rows[k].t_us > rows[k - 1].t_us) {
            steps[n++] = rows[k].t_us - rows[k - 1].t_us;
        }
    }
    qsort(steps, n, sizeof steps[0], compare);
    return steps[n / 2];
}

static bool start_filters(orientations_t *self)
{
    const float period_s = 1e-6f * (float)self->period_us;
    bool started = true;
    for (int k = 0; k < ORIENTATIONS_SENSORS; k++) {
        started = started && jcal_vqf_init(&self->filters[k].vqf, period_s, period_s) == JCAL_OK;
    }
    return started;
}

static jcal_vec3_t between(jcal_vec3_t from, jcal_vec3_t to, float share)
{
    return jcal_vec3_add(from, jcal_vec3_scale(jcal_vec3_sub(to, from), share));
}

/* Feeds `steps` samples that lead from the last one to this one; rates are multiplied by `scale`. */
static void feed(orientations_filter_t *filter, const jcal_imu_t *imu, int64_t steps, float scale)
{
    for (int64_t k = 1; k <= steps; k++) {
        const float share = (float)k / (float)steps;
        const jcal_vec3_t w = (k < steps) ? between(filter->last.gyr_rad_s, imu->gyr_rad_s, share) : imu->gyr_rad_s;
        const jcal_vec3_t a = (k < steps) ? between(filter->last.acc_m_s2, imu->acc_m_s2, share) : imu->acc_m_s2;
        const float gyr[3] = {scale * w.x, scale * w.y, scale * w.z};
        const float acc[3] = {a.x, a.y, a.z};
        float q[4] = {1.0f, 0.0f, 0.0f, 0.0f};
        /* The gate lets nothing pass that the filter would reject. */
        if (jcal_vqf_update(&filter->vqf, gyr, acc, q) == JCAL_OK) {
            filter->q = (jcal_quat_t){q[0], q[1], q[2], q[3]};
        }
    }
    filter->last = *imu;
}

/* Brings both filters to the time of a row. */
static void feed_row(orientations_t *self, const recording_row_t *row)
{
    int64_t steps = 1;
    float scale = 1.0f;
    const int64_t dt_us = row->t_us - self->fed_us;
    if (self->has_fed && dt_us > BRIDGE_US) {
        self->restart_due = true;
        (void)start_filters(self); /* worked before */
    } else if (self->has_fed) {
        steps = (dt_us + self->period_us / 2) / self->period_us;
        steps = (steps > 1) ? steps : 1;
        scale = (float)dt_us / (float)(steps * self->period_us);
    }
    feed(&self->filters[0], &row->imu1, steps, scale);
    feed(&self->filters[1], &row->imu2, steps, scale);
    if (self->recording->want_third) {
        feed(&self->filters[2], &row->imu3, steps, scale);
    }
    self->has_fed = true;
    self->fed_us = row->t_us;
}

static void filter_row(orientations_t *self, oriented_row_t *out)
{
    recording_row_t *row = &out->row;
    if (is_fed(self, out)) {
        feed_row(self, row);
        row->q1 = self->filters[0].q;
        row->q2 = self->filters[1].q;
        row->q3 = self->filters[2].q;
    }
    tell_restart(self, out);
}

static recording_event_t open_filters(orientations_t *self)
{
    self->filters = calloc(ORIENTATIONS_SENSORS, sizeof *self->filters);
    return (self->filters != NULL) ? RECORDING_ROW : RECORDING_FAILED;
}

/* Reads the rows that tell the sample period. */
static recording_event_t wait_for_period(orientations_t *self)
{
    self->waited = true;
    self->event = RECORDING_ROW;
    while (self->row_count < ORIENTATIONS_WAIT && self->event == RECORDING_ROW) {
        self->event = recording_next(self->recording, &self->rows[self->row_count]);
        self->row_count += (self->event == RECORDING_ROW) ? 1 : 0;
    }
    self->period_us = usual_step_us(self->rows, self->row_count);
    if (start_filters(self)) {
        return RECORDING_ROW;
    }
    return recording_refuse(self->recording,
                            "rows are %g s apart: orientations from rates need 10 to 10000 rows a second",
                            1e-6 * (double)self->period_us);
}

#else

struct orientations_filter {
    int none;
};

static void filter_row(orientations_t *self, oriented_row_t *out)
{
    (void)self;
    out->reject = JCAL_REJECT_NOT_FINITE;
}

static recording_event_t open_filters(orientations_t *self)
{
    return recording_refuse(self->recording,
                            "no columns q1_w ... q2_z, and this program was built without the filter that computes "
                            "orientations: install a C++ compiler (Debian: g++), run tools/vqf.sh and build again");
}

static recording_event_t wait_for_period(orientations_t *self)
{
    return open_filters(self);
}

#endif

/* Rows without orientations: weight of the newest in their share, and what may be lived with; as the library's own gate. */
#define MISSING_STEP 0.02f
#define MISSING_SHARE_MAX 0.2f

static bool finite_imu(const jcal_imu_t *imu)
{
    return jcal_vec3_is_finite(imu->gyr_rad_s) && jcal_vec3_is_finite(imu->acc_m_s2);
}

static bool finite_quat(jcal_quat_t q)
{
    return isfinite(q.w) && isfinite(q.x) && isfinite(q.y) && isfinite(q.z);
}

/* The library checks the orientations themselves; of rows that have none it never hears, so these are counted here. */
static void check_row(orientations_t *self, oriented_row_t *out)
{
    const recording_row_t *row = &out->row;
    const bool finite = row->has_time && finite_imu(&row->imu1) && finite_imu(&row->imu2) && finite_imu(&row->imu3) &&
                        finite_quat(row->q1) && finite_quat(row->q2) && finite_quat(row->q3);
    out->reject = finite ? JCAL_REJECT_NONE : JCAL_REJECT_NOT_FINITE;
    self->missing_share += MISSING_STEP * ((finite ? 0.0f : 1.0f) - self->missing_share);
}

recording_event_t orientations_open(orientations_t *self, recording_t *recording, bool joint_has_own)
{
    memset(self, 0, sizeof *self);
    self->recording = recording;
    self->gate_config = jcal_gate_config_default();
    jcal_gate_init(&self->gate);
    jcal_gate_init(&self->gate3);
    const recording_event_t event = recording_check_orientations(recording);
    if (event != RECORDING_ROW) {
        return event;
    }
    recording->want_orientations = recording->has_orientations;
    if (recording->has_orientations) {
        self->source = ORIENTATIONS_FROM_COLUMNS;
        return RECORDING_ROW;
    }
    self->source = joint_has_own ? ORIENTATIONS_FROM_JOINT : ORIENTATIONS_FROM_FILTER;
    return joint_has_own ? RECORDING_ROW : open_filters(self);
}

/* The next row of those that waited, else of the recording. */
static recording_event_t take_row(orientations_t *self, recording_row_t *row)
{
    if (self->row_at < self->row_count) {
        *row = self->rows[self->row_at++];
        return RECORDING_ROW;
    }
    return (self->event == RECORDING_ROW) ? recording_next(self->recording, row) : self->event;
}

recording_event_t orientations_next(orientations_t *self, oriented_row_t *row)
{
    *row = (oriented_row_t){.reject = JCAL_REJECT_NONE, .restarted = false};
    if (self->source == ORIENTATIONS_FROM_COLUMNS) {
        const recording_event_t event = recording_next(self->recording, &row->row);
        check_row(self, row);
        return event;
    }
    if (self->source == ORIENTATIONS_FROM_JOINT) {
        const recording_event_t event = recording_next(self->recording, &row->row);
        if (event == RECORDING_ROW) {
            pass_row(self, row);
        }
        return event;
    }
    if (!self->waited) {
        const recording_event_t event = wait_for_period(self);
        if (event != RECORDING_ROW) {
            return event;
        }
    }
    const recording_event_t event = take_row(self, &row->row);
    if (event == RECORDING_ROW) {
        filter_row(self, row);
    }
    return event;
}

jcal_reason_t orientations_complaint(const orientations_t *self)
{
    if (self->missing_share > MISSING_SHARE_MAX) {
        return JCAL_REASON_BAD_SAMPLES;
    }
    const jcal_reason_t complaint = jcal_gate_complaint(&self->gate);
    return (complaint != JCAL_REASON_NONE) ? complaint : jcal_gate_complaint(&self->gate3);
}

const char *orientations_words(const orientations_t *self)
{
    switch (self->source) {
    case ORIENTATIONS_FROM_COLUMNS:
        return "columns q1_w ... q2_z of the recording";
    case ORIENTATIONS_FROM_JOINT:
        return "computed from rates and specific forces";
    case ORIENTATIONS_FROM_FILTER:
    default:
        return "computed from rates and specific forces by VQF";
    }
}

void orientations_close(orientations_t *self)
{
    free(self->filters);
    self->filters = NULL;
}

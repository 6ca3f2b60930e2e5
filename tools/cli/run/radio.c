/* SPDX-License-Identifier: MIT */
/* Packets of a wireless sensor from the rows of a recording. */
#include "run/radio.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Rows further apart than this many periods have lost some between them; then a reading is the row within half a period of it. */
#define GAP_PERIODS 1.75

/* Times are rounded: a reading that is so near to a row, as a share of their distance, is that row. */
#define SNAP 1e-3

#define RAIL 32767.0f

/* ---- Random numbers ---- */

/* SplitMix64: 64 bits of state, any seed will do. */
static uint64_t next_random(uint64_t *state)
{
    *state += 0x9E3779B97F4A7C15u;
    uint64_t z = *state;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

/* 0 to below 1. */
static double next_share(uint64_t *state)
{
    return (double)(next_random(state) >> 11) * 0x1p-53;
}

/* A stream of its own for each sensor and use. */
static uint64_t stream_of(const radio_config_t *config, unsigned use)
{
    uint64_t state = config->seed;
    state = next_random(&state) + config->sensor;
    state = next_random(&state) + use;
    return next_random(&state);
}

/* ---- Rows ---- */

bool radio_add(radio_t *self, const radio_row_t *row)
{
    if (self->row_count > 0 && row->t_us <= self->rows[self->row_count - 1].t_us) {
        return true;
    }
    if (self->row_count == self->capacity) {
        const size_t capacity = (self->capacity == 0) ? 4096 : 2 * self->capacity;
        radio_row_t *rows = realloc(self->rows, capacity * sizeof *rows);
        if (rows == NULL) {
            return false;
        }
        self->rows = rows;
        self->capacity = capacity;
    }
    self->rows[self->row_count] = *row;
    self->row_count++;
    return true;
}

static int by_size(const void *left, const void *right)
{
    const int64_t a = *(const int64_t *)left;
    const int64_t b = *(const int64_t *)right;
    return (a > b) - (a < b);
}

/* 0 if there is no memory for it. */
static double median_distance(const radio_t *self)
{
    const size_t count = self->row_count - 1;
    int64_t *distances = malloc(count * sizeof *distances);
    if (distances == NULL) {
        return 0.0;
    }
    for (size_t k = 0; k < count; k++) {
        distances[k] = self->rows[k + 1].t_us - self->rows[k].t_us;
    }
    qsort(distances, count, sizeof *distances, by_size);
    const size_t middle = count / 2;
    const double median = (double)distances[middle];
    free(distances);
    return median;
}

/* Times in a file may be rounded, so the median alone is not the period: it tells how many periods there are between two rows, and
 * all of them tell the period. */
double radio_period_us(const radio_t *self)
{
    if (self->row_count < 2) {
        return 0.0;
    }
    double period = median_distance(self);
    const double span = (double)(self->rows[self->row_count - 1].t_us - self->rows[0].t_us);
    for (int pass = 0; pass < 2 && period > 0.0; pass++) {
        double count = 0.0;
        for (size_t k = 1; k < self->row_count; k++) {
            const double distance = (double)(self->rows[k].t_us - self->rows[k - 1].t_us);
            count += fmax(1.0, round(distance / period));
        }
        period = span / count;
    }
    return period;
}

/* ---- Readings ---- */

/* One component as the sensor sends it; true if it is beyond the range. */
static bool to_raw(float value, float step, int16_t *raw)
{
    const float steps = rintf(value / step);
    const bool clips = fabsf(steps) > RAIL;
    *raw = (int16_t)fmaxf(-RAIL, fminf(RAIL, steps));
    return clips;
}

/* The values at `t_us`, which is at or after rows[at]. False if the rows do not tell. */
static bool values_at(const radio_t *self, size_t at, double t_us, float values[static RADIO_VALUES])
{
    const radio_row_t *before = &self->rows[at];
    const radio_row_t *after = &self->rows[(at + 1 < self->row_count) ? at + 1 : at];
    const double distance = (double)(after->t_us - before->t_us);
    double share = (distance > 0.0) ? (t_us - (double)before->t_us) / distance : 0.0;
    share = (share < SNAP) ? 0.0 : ((share > 1.0 - SNAP) ? 1.0 : share);
    if (distance > GAP_PERIODS * self->period_us) {
        const double half = 0.5 * self->period_us / distance;
        if (share > half && share < 1.0 - half) {
            return false;
        }
        share = (share > 0.5) ? 1.0 : 0.0;
    }
    bool is_finite = true;
    for (size_t k = 0; k < RADIO_VALUES; k++) {
        /* A row that is met exactly needs no neighbour. */
        const double from = (share < 1.0) ? (1.0 - share) * (double)before->values[k] : 0.0;
        const double to = (share > 0.0) ? share * (double)after->values[k] : 0.0;
        values[k] = (float)(from + to);
        is_finite = is_finite && isfinite(values[k]);
    }
    return is_finite;
}

static void to_reading(radio_t *self, const radio_config_t *config, const float values[static RADIO_VALUES])
{
    bool clips = false;
    for (size_t k = 0; k < RADIO_VALUES; k++) {
        const float step = (k < 3) ? config->gyr_step : config->acc_step;
        clips = to_raw(values[k], step, &self->raw[self->readings][k]) || clips;
    }
    self->clipped += clips ? 1u : 0u;
    self->readings++;
}

/* ---- Packets ---- */

/* What goes on while packets are made. */
typedef struct {
    const radio_config_t *config;
    uint64_t random, burst_random;
    double burst_begin_us, burst_end_us; /* the next one, or the one that is on */
    radio_packet_t open;                 /* readings that wait for the packet to be full */
    int64_t last_us;                     /* arrival of the packet before */
} sending_t;

static void next_burst(sending_t *sending)
{
    const double after_s = RADIO_BURST_EVERY_S * (0.5 + next_share(&sending->burst_random));
    sending->burst_begin_us = sending->burst_end_us + 1e6 * after_s;
    sending->burst_end_us = sending->burst_begin_us + 1e6 * sending->config->burst_s;
}

/* The same draws whatever becomes of the packet, so that one setting does not change what another one does. */
static void send_open(radio_t *self, sending_t *sending, double now_us)
{
    const radio_config_t *config = sending->config;
    if (sending->open.count == 0) {
        return;
    }
    const bool is_lost = next_share(&sending->random) < config->loss;
    const double under_way_us = config->delay_us + config->jitter_us * next_share(&sending->random);
    while (config->burst_s > 0.0 && now_us > sending->burst_end_us) {
        next_burst(sending);
    }
    const bool is_unheard = config->burst_s > 0.0 && now_us >= sending->burst_begin_us;
    if (is_lost || is_unheard) {
        self->lost++;
    } else {
        /* A radio keeps the order of one sensor's packets. */
        const int64_t arrival_us = (int64_t)rint(now_us + under_way_us);
        sending->open.arrival_us = (arrival_us > sending->last_us) ? arrival_us : sending->last_us;
        sending->last_us = sending->open.arrival_us;
        self->packets[self->packet_count] = sending->open;
        self->packet_count++;
    }
    sending->open.count = 0;
}

bool radio_make(radio_t *self, const radio_config_t *config)
{
    self->period_us = radio_period_us(self);
    const double period_us = self->period_us * (1.0 + 1e-6 * config->clock_ppm);
    if (!(period_us > 0.0)) {
        return false;
    }
    const int64_t first_us = self->rows[0].t_us;
    const double span_us = (double)(self->rows[self->row_count - 1].t_us - first_us);
    /* Half a microsecond: times in a file are rounded. */
    const size_t ticks = (size_t)floor((span_us + 0.5) / period_us) + 1;
    self->raw = malloc(ticks * sizeof *self->raw);
    self->packets = malloc(ticks * sizeof *self->packets);
    if (self->raw == NULL || self->packets == NULL) {
        return false;
    }
    sending_t sending = {
        .config = config, .random = stream_of(config, 0), .burst_random = stream_of(config, 1), .last_us = INT64_MIN};
    const uint32_t counter = (uint32_t)next_random(&sending.random) & 0xFFFFu;
    sending.burst_end_us = (double)first_us;
    if (config->burst_s > 0.0) {
        next_burst(&sending);
    }
    size_t at = 0;
    double sent_us = 0.0;
    for (size_t k = 0; k < ticks; k++) {
        const double t_us = (double)first_us + (double)k * period_us;
        while (at + 2 < self->row_count && (double)self->rows[at + 1].t_us <= t_us) {
            at++;
        }
        float values[RADIO_VALUES];
        if (!values_at(self, at, t_us, values)) {
            self->missing++;
            send_open(self, &sending, sent_us);
            continue;
        }
        if (sending.open.count == 0) {
            sending.open.counter = (counter + (uint32_t)k) & 0xFFFFu;
            sending.open.first = self->readings;
        }
        to_reading(self, config, values);
        sending.open.count++;
        sent_us = t_us;
        if (sending.open.count == config->per_packet) {
            send_open(self, &sending, sent_us);
        }
    }
    send_open(self, &sending, sent_us);
    return true;
}

void radio_free(radio_t *self)
{
    free(self->rows);
    free(self->raw);
    free(self->packets);
    memset(self, 0, sizeof *self);
}

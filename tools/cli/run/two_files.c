/* SPDX-License-Identifier: MIT */
/* Two files of one sensor each as one recording of pairs. */
#include "run/two_files.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Time of sensor 1's first reading for the library: a common time of every pairing; readings of sensor 2 before it have one, too. */
#define ORIGIN_US INT64_C(1000000000000)

/* Overlap of two files of one clock, as a share of the shorter one. */
#define OVERLAP_SHARE 0.5

/* A point of the line: when its bound is so small, or so much time was spent on it. */
#define POINT_BOUND_S 0.004
#define POINT_TIME_S 20.0

/* Pairs are made where the lag is known to within this. A hinge bears a lag of 10 ms (docs/measurements/sensor_faults.md). */
#define BOUND_MOST_S 0.012

/* Motion that the estimator needs, s. */
#define MOTION_S 8.0

/* Lags that are tried: steps that the estimator reaches over, how many on either side, and for how much motion each, s. */
#define STEP_US INT64_C(400000)
#define STEPS 5
#define TRY_MOTION_S 60.0

/* Lags that are nearer than this are one; another one must leave so many times as much, beside a floor. */
#define SAME_US 50000
#define RIVAL_TIMES 2.0
#define LEFT_FLOOR 0.005

#define US_PER_S 1e6

/* A lag that fits, beyond base_us, and what it leaves. */
typedef struct {
    int64_t lag_us;
    double left;
} candidate_t;

/* First and last time of a file. */
typedef struct {
    int64_t first_us, last_us;
    bool has_any;
} span_t;

/* ---- Files ---- */

static void close_files(two_files_t *two)
{
    for (unsigned k = 0; k < 2u; k++) {
        sensor_file_close(&two->files[k]);
        two->has_head[k] = false;
    }
}

static recording_event_t open_file(two_files_t *two, unsigned k)
{
    const recording_event_t event =
        sensor_file_open(&two->files[k], two->config.names[k], (int)k + 1, two->config.sorted);
    two->files[k].recording.check.times_only = true;
    two->at_fault = (event == RECORDING_ROW) ? two->at_fault : k;
    return event;
}

static recording_event_t open_files(two_files_t *two)
{
    recording_event_t event = open_file(two, 0u);
    event = (event == RECORDING_ROW) ? open_file(two, 1u) : event;
    if (event == RECORDING_ROW && input_same(&two->files[0].input, &two->files[1].input)) {
        two->at_fault = 1u;
        return recording_refuse(&two->files[1].recording, "the same file twice: each sensor has its own");
    }
    for (unsigned k = 0; k < 2u && event == RECORDING_ROW && !two->config.has_lag; k++) {
        if (!two->files[k].input.again) {
            two->at_fault = k;
            return recording_refuse(
                &two->files[k].recording,
                "two files are read several times, which this one cannot be: give the lag by --lag");
        }
    }
    return event;
}

static recording_event_t read_span(two_files_t *two, unsigned k, span_t *span)
{
    sensor_file_t *file = &two->files[k];
    recording_row_t row;
    recording_event_t event = sensor_file_next(file, &row);
    for (; event == RECORDING_ROW; event = sensor_file_next(file, &row)) {
        span->first_us = span->has_any ? span->first_us : row.t_us;
        span->last_us = (span->has_any && span->last_us > row.t_us) ? span->last_us : row.t_us;
        span->has_any = true;
    }
    two->at_fault = k;
    two->checks[k] = file->recording.check;
    return event;
}

/* ---- Readings in the order of their times ---- */

/* Time of sensor 2's reading on sensor 1's clock, since start_us. */
static int64_t aligned_us(const two_files_t *two, int64_t t_us)
{
    const int64_t since_us = t_us - two->base_us - two->rough_us - two->start_us;
    return since_us - (int64_t)llround(US_PER_S * clock_line_at(&two->line, (double)since_us / US_PER_S));
}

/* Sees to it that the next reading of a file is there, if there is one. */
static recording_event_t fill_head(two_files_t *two, unsigned k)
{
    if (two->has_head[k]) {
        return RECORDING_ROW;
    }
    const recording_event_t event = sensor_file_next(&two->files[k], &two->heads[k]);
    two->has_head[k] = event == RECORDING_ROW;
    two->at_fault = (event == RECORDING_ROW) ? two->at_fault : k;
    return event;
}

/* The reading that is next of both files. RECORDING_END if either has come to its end: then there are no more pairs. */
static recording_event_t next_reading(two_files_t *two, unsigned *which, jcal_reading_t *reading)
{
    for (unsigned k = 0; k < 2u; k++) {
        const recording_event_t event = fill_head(two, k);
        if (event != RECORDING_ROW) {
            return event;
        }
    }
    if (!two->has_start) {
        two->has_start = true;
        two->start_us = two->heads[0].t_us;
    }
    const int64_t t1_us = two->heads[0].t_us - two->start_us;
    const int64_t t2_us = aligned_us(two, two->heads[1].t_us);
    const unsigned k = (t2_us < t1_us) ? 1u : 0u;
    two->has_head[k] = false;
    *which = k + 1u;
    reading->t_us = (uint64_t)(ORIGIN_US + ((k == 0u) ? t1_us : t2_us));
    reading->imu = two->heads[k].imu1;
    return RECORDING_ROW;
}

/* ---- The passes ---- */

/* How the times of the files belong together. */
static recording_event_t find_base(two_files_t *two)
{
    span_t spans[2] = {{0, 0, false}, {0, 0, false}};
    recording_event_t event = open_files(two);
    for (unsigned k = 0; k < 2u && (event == RECORDING_ROW || event == RECORDING_END); k++) {
        event = read_span(two, k, &spans[k]);
    }
    if (event != RECORDING_END) {
        return event;
    }
    close_files(two);
    const int64_t begin_us = (spans[0].first_us > spans[1].first_us) ? spans[0].first_us : spans[1].first_us;
    const int64_t end_us = (spans[0].last_us < spans[1].last_us) ? spans[0].last_us : spans[1].last_us;
    const double length1 = (double)(spans[0].last_us - spans[0].first_us);
    const double length2 = (double)(spans[1].last_us - spans[1].first_us);
    const bool overlap = (double)(end_us - begin_us) >= OVERLAP_SHARE * fmin(length1, length2);
    two->kind = overlap ? TWO_FILES_ONE_CLOCK : TWO_FILES_ONE_BEGINNING;
    two->base_us = overlap ? 0 : spans[1].first_us - spans[0].first_us;
    two->start_us = spans[0].first_us;
    two->has_start = spans[0].has_any;
    return RECORDING_ROW;
}

/* Looks for a lag around one of the steps; found->known is false if there is none. */
static recording_event_t try_step(two_files_t *two, int64_t step_us, lag_found_t *found)
{
    jcal_reading_t reading;
    unsigned which = 0u;
    two->rough_us = step_us;
    *found = (lag_found_t){.known = false};
    recording_event_t event = lag_watch_begin(&two->watch) ? open_files(two) : RECORDING_FAILED;
    while (event == RECORDING_ROW && !found->known && found->all_motion_s < TRY_MOTION_S) {
        event = next_reading(two, &which, &reading);
        if (event == RECORDING_ROW) {
            lag_watch_push(&two->watch, which, &reading);
            *found = lag_watch_found(&two->watch);
        }
    }
    if (event == RECORDING_BAD || event == RECORDING_FAILED) {
        return event;
    }
    two->moved = two->moved || found->motion_s >= MOTION_S;
    close_files(two);
    return RECORDING_ROW;
}

/* Puts a candidate beside the best one and the best other one. */
static void compare(candidate_t candidate, candidate_t *best, candidate_t *rival)
{
    const bool is_same = llabs(candidate.lag_us - best->lag_us) < SAME_US;
    if (candidate.left < best->left) {
        *rival = is_same ? *rival : *best;
        *best = candidate;
    } else if (!is_same && candidate.left < rival->left) {
        *rival = candidate;
    } else {
        /* nothing new */
    }
}

/* Finds the lag roughly. */
static recording_event_t find_rough(two_files_t *two)
{
    candidate_t best = {INT64_MAX / 2, HUGE_VAL};
    candidate_t rival = best;
    recording_event_t event = RECORDING_ROW;
    for (int64_t step = -STEPS; step <= STEPS && event == RECORDING_ROW; step++) {
        lag_found_t found;
        event = try_step(two, step * STEP_US, &found);
        if (event == RECORDING_ROW && found.known) {
            const int64_t lag_us = step * STEP_US + (int64_t)llround(US_PER_S * found.lag_s);
            compare((candidate_t){lag_us, found.left}, &best, &rival);
        }
    }
    two->found = best.left < HUGE_VAL;
    two->repeats = two->found && rival.left < RIVAL_TIMES * fmax(best.left, LEFT_FLOOR);
    two->rough_us = (two->found && !two->repeats) ? best.lag_us : 0;
    two->rival_us = rival.lag_us;
    two->best_us = best.lag_us;
    return event;
}

/* Makes a point of the line of what the estimator knows, if it is good enough or nothing better will come. */
static bool take_point(two_files_t *two, bool at_end)
{
    const lag_found_t found = lag_watch_found(&two->watch);
    two->moved = two->moved || found.motion_s >= MOTION_S;
    if (!found.known || !(at_end || found.bound_s <= POINT_BOUND_S || found.spent_s >= POINT_TIME_S)) {
        return true;
    }
    const double t_s = (double)((int64_t)found.at_us - ORIGIN_US) / US_PER_S;
    const clock_point_t point = {t_s, clock_line_at(&two->line, t_s) + found.lag_s, found.bound_s};
    return lag_watch_again(&two->watch) && clock_line_add(&two->line, point);
}

static recording_event_t find_line(two_files_t *two)
{
    recording_event_t event = lag_watch_begin(&two->watch) ? open_files(two) : RECORDING_FAILED;
    jcal_reading_t reading;
    unsigned which = 0u;
    while (event == RECORDING_ROW) {
        event = next_reading(two, &which, &reading);
        if (event == RECORDING_ROW) {
            lag_watch_push(&two->watch, which, &reading);
            event = take_point(two, false) ? event : RECORDING_FAILED;
        }
    }
    if (event != RECORDING_END) {
        return event;
    }
    close_files(two);
    return take_point(two, true) ? RECORDING_ROW : RECORDING_FAILED;
}

recording_event_t two_files_open(two_files_t *two, const two_files_config_t *config)
{
    memset(two, 0, sizeof *two);
    two->config = *config;
    two->base_us = config->lag_us;
    recording_event_t event = config->has_lag ? RECORDING_ROW : find_base(two);
    if (event == RECORDING_ROW && !config->has_lag) {
        event = find_rough(two);
    }
    if (event == RECORDING_ROW && two->found && !two->repeats) {
        event = find_line(two);
    }
    if (event == RECORDING_ROW) {
        event = open_files(two);
        two->files[0].recording.check.times_only = !config->watched;
        two->files[1].recording.check.times_only = !config->watched;
    }
    const jcal_pairing_config_t pairing = jcal_pairing_config_default();
    return (jcal_pairing_init(&two->pairing, &pairing) == JCAL_OK) ? event : RECORDING_FAILED;
}

/* True if a reading of sensor 2 is where the lag is known well enough. */
static bool may_pair(const two_files_t *two, const jcal_reading_t *reading)
{
    const double t_s = (double)((int64_t)reading->t_us - ORIGIN_US) / US_PER_S;
    return two->config.has_lag || two->line.count == 0 || clock_line_bound(&two->line, t_s) <= BOUND_MOST_S;
}

/* A reading that is equal in all six numbers to the one before is a lost packet; what is interpolated of such does not look like one. */
static void take_reading(two_files_t *two, unsigned which, const jcal_reading_t *reading)
{
    jcal_imu_t *last = &two->last[which - 1u];
    two->readings[which - 1u]++;
    if (two->readings[which - 1u] > 1u && lag_watch_same(last, &reading->imu)) {
        two->repeated[which - 1u]++;
    } else if (which == 2u && !may_pair(two, reading)) {
        two->left_out++;
    } else {
        (void)jcal_pairing_push(&two->pairing, which, reading); /* what it rejects makes no pair */
    }
    *last = reading->imu;
}

recording_event_t two_files_next(void *context, recording_row_t *row)
{
    two_files_t *two = context;
    jcal_pair_t pair;
    while (jcal_pairing_pull(&two->pairing, &pair) != JCAL_OK) {
        jcal_reading_t reading;
        unsigned which = 0u;
        const recording_event_t event = next_reading(two, &which, &reading);
        if (event != RECORDING_ROW) {
            return event;
        }
        take_reading(two, which, &reading);
    }
    two->pairs++;
    two->now_us = (int64_t)pair.t_us - ORIGIN_US;
    memset(row, 0, sizeof *row);
    row->has_time = true;
    row->t_us = two->start_us + two->now_us;
    row->t_s = (double)row->t_us / US_PER_S;
    row->imu1 = pair.imu1;
    row->imu2 = pair.imu2;
    return RECORDING_ROW;
}

void two_files_close(two_files_t *two)
{
    close_files(two);
    clock_line_free(&two->line);
}

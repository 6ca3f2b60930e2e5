/* SPDX-License-Identifier: MIT */
/// @file
/// Two files of one sensor each, with clocks of their own, as one recording of pairs.
///
/// Files are read several times. First for their spans: clocks whose times overlap for at least half of the shorter file are taken for one
/// clock that is a little off, others to begin at the same moment. Then for the lag, roughly: the estimator (run/lag_watch.h) looks at
/// steps of 0.4 s within 2 s, for 60 s of motion; motion that repeats itself, as gait, may fit at several of them, and then what is left
/// must tell. Then for the lag over time: each time the estimator knows it is a point of a line (run/clock_line.h), and it begins anew. Then
/// for the pairs, with the line taken off the times of sensor 2; where it is not known well enough there are none. If the lag is given
/// nothing has to be found, and once is enough.
///
/// Times of pairs are those of sensor 1's file, every 10 ms from its first one on.
#ifndef JCAL_CLI_RUN_TWO_FILES_H
#define JCAL_CLI_RUN_TWO_FILES_H

#include "input/check.h"
#include "jointcal/pairing.h"
#include "run/clock_line.h"
#include "run/lag_watch.h"
#include "run/sensor_file.h"

#include <stdio.h>

/// What was asked for.
typedef struct {
    const char *names[2];
    bool sorted;
    bool watched;    ///< What the sensors of both files do is of interest, at the rate of each: two_files_health.
    bool has_lag;    ///< The lag is given ...
    int64_t lag_us;  ///< ... and is this.
} two_files_config_t;

/// How times of the files belong together.
typedef enum {
    TWO_FILES_GIVEN,         ///< By the lag that was given.
    TWO_FILES_ONE_CLOCK,     ///< They are about the same.
    TWO_FILES_ONE_BEGINNING  ///< Both files begin at about the same moment.
} two_files_kind_t;

typedef struct {
    two_files_config_t config;
    two_files_kind_t kind;
    unsigned at_fault;          ///< Number of the file, 0 or 1, that could not be read on.
    int64_t base_us;            ///< Sensor 2's times less sensor 1's, by `kind`; what else there is of a lag is ...
    int64_t rough_us;           ///< ... what was found before the line was drawn ...
    clock_line_t line;          ///< ... and the line over seconds since sensor 1's first time.
    int64_t best_us, rival_us;  ///< Lags that fit best, beyond base_us, if any do.
    uint64_t readings[2];
    uint64_t repeated[2];  ///< Of these, those that repeat the one before.
    uint64_t pairs;
    uint64_t left_out;  ///< Readings of sensor 2 where the lag is not known well enough.
    bool found;         ///< A lag fits.
    bool repeats;       ///< Several lags fit, as in motion that repeats itself; then none is known.
    bool moved;         ///< There was motion from which the lag could be known.

    /* Private. */
    bool has_start;
    bool has_head[2];
    int64_t start_us; /* sensor 1's first time */
    int64_t now_us;   /* of the last pair, since start_us */
    sensor_file_t files[2];
    recording_row_t heads[2]; /* the next reading of each */
    check_t checks[2];
    jcal_imu_t last[2];
    lag_watch_t watch;
    jcal_pairing_t pairing;
} two_files_t;

/// What the lag is at the time of the last pair.
typedef struct {
    bool known;
    int64_t lag_us;      ///< Sensor 2's times, as in its file, less sensor 1's.
    int64_t beyond_us;   ///< The part of it beyond base_us.
    double bound_s;      ///< 95 %; 0 if the lag is given.
    bool has_drift;      ///< The lag was found more than once.
    double drift;        ///< Seconds a second; more than 0 if sensor 2's clock is fast.
    double drift_bound;  ///< 95 %.
} two_files_lag_t;

/// Opens both files and finds the lag. RECORDING_ROW: pairs can be read; else what is wrong is in the file `at_fault`.
recording_event_t two_files_open(two_files_t *two, const two_files_config_t *config);

/// The next pair: a recording_source_t, whose context is the two_files_t.
recording_event_t two_files_next(void *context, recording_row_t *row);

/// What the lag is.
two_files_lag_t two_files_lag(const two_files_t *two);

/// What the library says of the sensor of file `k`, 0 or 1, by its own readings; all unknown unless it was asked for.
jcal_health_result_t two_files_health(const two_files_t *two, unsigned k);

/// Adds what these say that the pairs do not show: of rates, gaps, and readings that are held.
void two_files_health_findings(const two_files_t *two, const check_t *pairs, check_findings_t *findings);

/// Adds to what there is to say of the pairs: what is wrong with the times of either file, and a lag that is not known. `reason` is what
/// the joint says.
void two_files_findings(const two_files_t *two, jcal_reason_t reason, check_findings_t *findings);

/// Writes the labelled lines of a summary: files, clocks, lag.
void two_files_print(const two_files_t *two, FILE *file);

/// Closes both.
void two_files_close(two_files_t *two);

#endif

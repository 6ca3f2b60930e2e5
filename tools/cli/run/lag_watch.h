/* SPDX-License-Identifier: MIT */
/// @file
/// The lag of two sensors from their readings: pairing, sensor stages and estimator as on the hub (jointcal/pairing.h, jointcal/lag.h).
#ifndef JCAL_CLI_RUN_LAG_WATCH_H
#define JCAL_CLI_RUN_LAG_WATCH_H

#include "input/row.h"
#include "output/report.h"

#include "jointcal/pairing.h"

/// All members are private.
typedef struct {
    jcal_pairing_t pairing;
    jcal_sensor_t sensor1, sensor2;
    jcal_lag_t lag;
    jcal_imu_t last[2]; /* a reading that comes again is a lost packet */
    bool has_last[2];
    float motion_s;      /* in the sums of the estimator */
    float most_motion_s; /* the most that there ever was */
    double weighted_us;  /* times, by motion, of what is in the sums */
    float bound_s;       /* of what is known, by which a new judgement is told */
    float left;          /* what no lag explains, by the last one */
    float all_motion_s;  /* that ever went into sums */
    uint64_t at_us;      /* the middle of the motion of the last one */
    uint64_t begun_us;   /* time of the first pair, of which those count */
    uint64_t anew_us;    /* time of the first pair since the estimator began anew */
    uint64_t now_us;
} lag_watch_t;

/// What is known of the lag.
typedef struct {
    bool known;
    double lag_s;  ///< Sensor 2's times are late by it.
    double bound_s;
    uint64_t at_us;       ///< The middle of the motion that it is from.
    double spent_s;       ///< Time since the estimator began anew.
    double left;          ///< Share of the motion of the joint's centre that it does not explain.
    double all_motion_s;  ///< Motion that was seen in all.
    double motion_s;      ///< Most motion that any estimate had.
} lag_found_t;

/// Prepares. False if the library refuses, which would be a mistake of this program.
bool lag_watch_begin(lag_watch_t *watch);

/// Forgets the lag and begins to look for it anew; the sensors' orientations stay. False as above.
bool lag_watch_again(lag_watch_t *watch);

/// True of two readings that are equal in all six numbers, as where a lost packet is written as the one before.
bool lag_watch_same(const jcal_imu_t *a, const jcal_imu_t *b);

/// Takes in a reading of sensor `which`, 1 or 2; both sensors' readings come about in the order of their times.
void lag_watch_push(lag_watch_t *watch, unsigned which, const jcal_reading_t *reading);

/// Takes in a row of a file that has both; `start_us` is the first time in it. Rows without a time are left out.
void lag_watch_row(lag_watch_t *watch, const recording_row_t *row, int64_t start_us);

/// What is known.
lag_found_t lag_watch_found(const lag_watch_t *watch);

/// The same of a file that has both, for a report; and what to do about it, to what there is to say of the rows that `check` saw.
report_lag_t lag_watch_report(const lag_watch_t *watch, const check_t *check, check_findings_t *findings);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What is wrong with a recording as a whole, whatever the joint: rows are watched as they stream by, in constant memory, and the
/// findings are sentences for a person.
///
/// Findings of three kinds. Some refuse: with these readings an answer would be wrong although it fits, so nothing may be called ready.
/// Some explain why it is not ready. The others are remarks.
#ifndef JCAL_CLI_INPUT_CHECK_H
#define JCAL_CLI_INPUT_CHECK_H

#include "input/check_health.h"
#include "input/check_sensor.h"
#include "input/check_time.h"

#include "jointcal/status.h"

#define CHECK_SENSORS 3
#define CHECK_PAIRS 3

/// Most sentences.
#define CHECK_SENTENCES 24

/// One row; see recording_row_t.
typedef struct {
    double t_s;     ///< As it stands in the file, in whatever unit; NaN if there is none.
    bool has_time;  ///< t_us is known.
    int64_t t_us;
    const jcal_imu_t *imu[CHECK_SENSORS];  ///< Null of a sensor that is not used.
} check_row_t;

/// Start from all zero.
typedef struct {
    bool times_only;  ///< Readings are not used, so they do not matter.

    /* Private. */
    uint64_t rows;
    check_time_t times;
    check_sensor_t sensors[CHECK_SENSORS];
    check_health_t health[CHECK_SENSORS];
    uint32_t pair_rows[CHECK_PAIRS];
    uint32_t same_gyr[CHECK_PAIRS];
    uint32_t same_acc[CHECK_PAIRS];
} check_t;

typedef struct {
    bool refuses;          ///< Nothing may be called ready.
    bool explains;         ///< The first sentence says why it is not ...
    jcal_reason_t reason;  ///< ... and this is the library's word for it.
    size_t count;
    sentence_t sentences[CHECK_SENTENCES];
} check_findings_t;

/// Adds a sentence, as far as there is room.
__attribute__((format(printf, 2, 3))) void check_say(check_findings_t *findings, const char *format, ...);

/// Puts what explains before all else.
void check_put_first(check_findings_t *findings, const check_findings_t *first, jcal_reason_t reason);

/// Takes in a row.
void check_push(check_t *check, const check_row_t *row);

/// What there is to say of the rows so far.
void check_findings(const check_t *check, check_findings_t *findings);

/// What was measured on the way.
typedef struct {
    double step_s;  ///< Usual time from row to row; 0 if it is not known.
    uint64_t out_of_order;
    double gravity_m_s2[CHECK_SENSORS];  ///< What gravity is in the accelerations; 0 if it is not known.
    double
        gravity_turns[CHECK_SENSORS];   ///< How many times as fast as the rates gravity turns; 0 if it is not known ...
    double gravity_fit[CHECK_SENSORS];  ///< ... and how much of its changes that explains, 0 to 1.
} check_measures_t;

void check_measures(const check_t *check, check_measures_t *measures);

/// What the library says of sensor `index` (0, 1, 2).
jcal_health_result_t check_health_of(const check_t *check, int index);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Rows of joint angles: zero and signs applied, as CSV or as an OpenSim storage file.
///
/// Rows are written as they come where that is possible. Where a pose or the range of the whole recording decides, or the
/// number of rows must stand in the header, they wait in a temporary file: memory does not grow with the recording.
#ifndef JCAL_CLI_OUTPUT_ANGLE_TABLE_H
#define JCAL_CLI_OUTPUT_ANGLE_TABLE_H

#include "output/message.h"

#include "jointcal/joint_angles.h"

#include <stdio.h>

/// Which pose has the reference angles.
typedef enum {
    ZERO_NONE,   ///< None: angles count from where the sensors' mounting happens to put zero.
    ZERO_FIRST,  ///< The first row with angles.
    ZERO_TIME,   ///< The first row with angles at or after a time.
    ZERO_RANGE   ///< The smallest flexion and the smallest pronation of the recording.
} zero_t;

/// Columns beside the time: flexion, pronation, carrying angle, heading offset, bound.
typedef enum {
    ANGLE_FLEXION,
    ANGLE_PRONATION,
    ANGLE_CARRYING,
    ANGLE_HEADING,
    ANGLE_BOUND,
    ANGLE_TABLE_COLUMNS
} angle_column_t;

typedef struct {
    const char *out;  ///< File name, or null for standard output.
    bool hinge;       ///< Else two axes, or
    bool ball;        ///< none: flexion, rotation and adduction of a hip
    bool shoulder;    ///< or elevation, axial rotation and plane of elevation of a shoulder, in these places.
    bool sto;         ///< `out` is to be an OpenSim storage file.
    zero_t zero;
    int64_t zero_us;                ///< With ZERO_TIME, as in the recording.
    jcal_joint_angles_t reference;  ///< Angles of the reference pose, flexion and pronation positive.
    bool signs_by_range;
    jcal_positive_t positive;
    bool has_bound;                          ///< There is a column with the bound of each row's calibration.
    const char *names[ANGLE_TABLE_COLUMNS];  ///< Columns of a storage file, time left out; null for the default.
} angle_table_config_t;

/// One row of the recording.
typedef struct {
    int64_t t_us;  ///< As in the recording.
    bool has_time;
    bool known;  ///< The angles are.
    jcal_joint_angles_t angles;
    float heading_rad;
    float bound_rad;  ///< 95 % bound of the calibration.
} angles_row_t;

typedef struct {
    const angle_table_config_t *config;
    FILE *file;
    const char *name;
    FILE *waiting;  ///< Rows that wait for the end, or null.
    /* Private: what is done to each row. */
    bool zeroed;
    jcal_joint_angles_t zero; /* angles of the reference pose, as they come */
    float sign_flexion, sign_pronation;
    bool has_last; /* a row with angles was written, and what it said, deg */
    jcal_joint_angles_t last_deg;
} angle_table_t;

/// Opens the file. EXIT_READY, or another status after a message.
exit_status_t angle_table_open(angle_table_t *table, const angle_table_config_t *config);

/// Takes in one row.
exit_status_t angle_table_row(angle_table_t *table, const angles_row_t *row);

/// Writes what waits.
exit_status_t angle_table_end(angle_table_t *table);

/// Closes files; a file that is not complete is removed.
void angle_table_close(angle_table_t *table);

#endif

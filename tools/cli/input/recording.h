/* SPDX-License-Identifier: MIT */
/// @file
/// A recording of two or three IMUs as CSV: one header line, columns found by name, one sample pair per row.
#ifndef JCAL_CLI_INPUT_RECORDING_H
#define JCAL_CLI_INPUT_RECORDING_H

#include "input/check.h"
#include "input/csv.h"
#include "jointcal/types.h"

/// t_s and twelve sensor components.
#define RECORDING_COLUMNS 13
/// Two quaternions, which need not be there.
#define RECORDING_ORIENTATION_COLUMNS 8
/// A third sensor, for those who ask for it, and its quaternion.
#define RECORDING_THIRD_COLUMNS 6
#define RECORDING_ALL_COLUMNS (RECORDING_COLUMNS + RECORDING_ORIENTATION_COLUMNS + RECORDING_THIRD_COLUMNS + 4)

typedef enum {
    RECORDING_ROW,    ///< A row was read.
    RECORDING_END,    ///< There are no more rows.
    RECORDING_BAD,    ///< The file is no recording: see fault.
    RECORDING_FAILED  ///< It could not be read to the end, or memory ran out.
} recording_event_t;

/// What is wrong and where; line and column count from 1, and 0 means that there is none to name.
typedef struct {
    uint64_t line;
    uint64_t column;
    char text[1024];
} recording_fault_t;

/// One row. Empty cells are NaN; cells that are not finite, or too large for a float, are NaN or infinite.
typedef struct {
    bool has_time;  ///< False if the time is empty or not finite.
    int64_t t_us;   ///< As in the file, from whatever origin.
    double t_s;     ///< The same in double, without limits; NaN if the time is empty or not finite.
    jcal_imu_t imu1;
    jcal_imu_t imu2;
    jcal_imu_t imu3;  ///< All zero unless wanted.
    jcal_quat_t q1;   ///< Sensor to earth; all zero unless wanted.
    jcal_quat_t q2;
    jcal_quat_t q3;  ///< Zero unless the third sensor is wanted too.
} recording_row_t;

/// Rows that wait to be handed out in order. Private.
typedef struct {
    recording_row_t row;
    size_t number;
} recording_kept_t;

typedef struct {
    csv_t csv;
    recording_fault_t fault;
    size_t header_cells;
    uint64_t header_line;
    bool has_orientations;   ///< The header names all of q1_w ... q2_z; with a third sensor those of q3 too.
    bool want_orientations;  ///< Set after recording_open: read them, and complain about text in them.
    check_t check;           ///< Watches the rows.
    bool want_third;         /* set by recording_want_third */
    bool want_sorted;        /* set by recording_want_sorted */
    recording_kept_t *kept;  /* rows in order, and the event after the last one */
    size_t kept_count;
    size_t kept_capacity;
    size_t kept_at;
    recording_event_t kept_event;
    bool found[RECORDING_ALL_COLUMNS];
    size_t index[RECORDING_ALL_COLUMNS]; /* cell of each column we want */
} recording_t;

/// Reads the header. RECORDING_ROW if all columns are there, else RECORDING_BAD or RECORDING_FAILED.
recording_event_t recording_open(recording_t *recording, csv_read_t *read, void *context);

/// Asks for rows in the order of their times; those without one come last. All of them are held in memory.
void recording_want_sorted(recording_t *recording);

/// True if the header names a third sensor's columns.
bool recording_has_third(const recording_t *recording);

/// Asks for the third sensor. RECORDING_BAD if its columns are missing, else RECORDING_ROW. Between open and all others only.
recording_event_t recording_want_third(recording_t *recording);

/// RECORDING_BAD if a sensor has some of its four orientation columns but not all, else RECORDING_ROW. Between open and next only.
recording_event_t recording_check_orientations(recording_t *recording);

/// Puts a fault of the whole file in words. Returns RECORDING_BAD.
__attribute__((format(printf, 2, 3))) recording_event_t recording_refuse(recording_t *recording, const char *format,
                                                                         ...);

/// Reads one row.
recording_event_t recording_next(recording_t *recording, recording_row_t *row);

/// Shows a row to a check, as recording_next does to the recording's own.
void recording_watch(check_t *check, const recording_row_t *row, bool third);

/// Releases memory.
void recording_close(recording_t *recording);

#endif

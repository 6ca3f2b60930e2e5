/* SPDX-License-Identifier: MIT */
/// @file
/// A recording of two or three IMUs as CSV: one header line, columns found by name, one sample pair per row.
#ifndef JCAL_CLI_INPUT_RECORDING_H
#define JCAL_CLI_INPUT_RECORDING_H

#include "input/check.h"
#include "input/csv.h"
#include "input/kept_rows.h"
#include "input/row.h"

/// t_s and twelve sensor components.
#define RECORDING_COLUMNS 13
/// t_s and the six components of a file that has one sensor.
#define RECORDING_ONE_COLUMNS 7
/// Two quaternions, which need not be there.
#define RECORDING_ORIENTATION_COLUMNS 8
/// A third sensor, for those who ask for it, and its quaternion.
#define RECORDING_THIRD_COLUMNS 6
#define RECORDING_ALL_COLUMNS (RECORDING_COLUMNS + RECORDING_ORIENTATION_COLUMNS + RECORDING_THIRD_COLUMNS + 4)

/// What is wrong and where; line and column count from 1, and 0 means that there is none to name.
typedef struct {
    uint64_t line;
    uint64_t column;
    char text[1024];
} recording_fault_t;

/// Reads a row from somewhere else than a file of all sensors, as recording_next.
typedef kept_rows_read_t recording_source_t;

typedef struct {
    csv_t csv;
    recording_fault_t fault;
    size_t header_cells;
    uint64_t header_line;
    bool has_orientations;      ///< The header names all of q1_w ... q2_z; with a third sensor those of q3 too.
    bool want_orientations;     ///< Set after recording_open: read them, and complain about text in them.
    check_t check;              ///< Watches the rows.
    bool want_third;            /* set by recording_want_third */
    bool want_sorted;           /* set by recording_want_sorted */
    kept_rows_t kept;           /* with want_sorted */
    int one;                    /* of a file with one sensor: whose it is, 1 or 2; else 0 */
    recording_source_t *source; /* of rows that no file of all sensors has; or null */
    void *source_context;
    bool found[RECORDING_ALL_COLUMNS];
    size_t index[RECORDING_ALL_COLUMNS]; /* cell of each column we want */
} recording_t;

/// Reads the header. RECORDING_ROW if all columns are there, else RECORDING_BAD or RECORDING_FAILED.
recording_event_t recording_open(recording_t *recording, csv_read_t *read, void *context);

/// The same of a file that has one sensor, in the columns t_s, gyr_x ... acc_z; its readings are imu1 of each row. For its checks it is
/// sensor `which`, 1 or 2.
recording_event_t recording_open_one(recording_t *recording, csv_read_t *read, void *context, int which);

/// A recording whose rows come from `source`: two sensors without orientations. Sorting is the source's.
void recording_open_source(recording_t *recording, recording_source_t *source, void *context);

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

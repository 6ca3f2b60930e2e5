/* SPDX-License-Identifier: MIT */
/// @file
/// A file of one sensor, reading by reading.
#ifndef JCAL_CLI_RUN_SENSOR_FILE_H
#define JCAL_CLI_RUN_SENSOR_FILE_H

#include "input/input.h"
#include "input/recording.h"

typedef struct {
    input_t input;
    recording_t recording;
    uint64_t rows;  ///< Rows read, whatever stands in them.

    /* Private. */
    recording_row_t ahead;  /* the row after the one that was handed out */
    recording_event_t next; /* whether there is one */
    int64_t last_us;        /* of the row that was handed out */
    bool has_last;
} sensor_file_t;

/// Opens the file of sensor `which`, 1 or 2, and reads its header; "-" is standard input.
recording_event_t sensor_file_open(sensor_file_t *file, const char *name, int which, bool sorted);

/// The next row that has a time. A time that is far ahead of those before and after it is wrong, and that row is left out: else the
/// other file would be read to its end to catch up.
recording_event_t sensor_file_next(sensor_file_t *file, recording_row_t *row);

/// Closes it; also after a failed open.
void sensor_file_close(sensor_file_t *file);

#endif

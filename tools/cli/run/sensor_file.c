/* SPDX-License-Identifier: MIT */
/* A file of one sensor. */
#include "run/sensor_file.h"

#include <string.h>

/* A time that is so much later than the one before and than the one after is wrong. */
#define AHEAD_US 1000000

/* The next row with a time, wherever it lies. */
static void look_ahead(sensor_file_t *file)
{
    do {
        file->next = recording_next(&file->recording, &file->ahead);
        file->rows += (file->next == RECORDING_ROW) ? 1u : 0u;
    } while (file->next == RECORDING_ROW && !file->ahead.has_time);
}

recording_event_t sensor_file_open(sensor_file_t *file, const char *name, int which, bool sorted)
{
    memset(file, 0, sizeof *file);
    if (input_open(&file->input, name) != 0) {
        return RECORDING_FAILED;
    }
    const recording_event_t event = recording_open_one(&file->recording, input_read, &file->input, which);
    if (event != RECORDING_ROW) {
        return event;
    }
    if (sorted) {
        recording_want_sorted(&file->recording);
    }
    look_ahead(file);
    return RECORDING_ROW;
}

recording_event_t sensor_file_next(sensor_file_t *file, recording_row_t *row)
{
    while (file->next == RECORDING_ROW) {
        *row = file->ahead;
        look_ahead(file);
        const bool jumps = file->has_last && row->t_us - file->last_us > AHEAD_US;
        if (jumps && file->next == RECORDING_ROW && row->t_us - file->ahead.t_us > AHEAD_US) {
            continue;
        }
        file->last_us = row->t_us;
        file->has_last = true;
        return RECORDING_ROW;
    }
    return file->next;
}

void sensor_file_close(sensor_file_t *file)
{
    recording_close(&file->recording);
    input_close(&file->input);
    file->input.descriptor = 0;
}

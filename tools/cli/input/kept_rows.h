/* SPDX-License-Identifier: MIT */
/// @file
/// Rows that are held in memory to be handed out in the order of their times.
#ifndef JCAL_CLI_INPUT_KEPT_ROWS_H
#define JCAL_CLI_INPUT_KEPT_ROWS_H

#include "input/row.h"

#include <stddef.h>

/// Reads a row, as recording_next.
typedef recording_event_t kept_rows_read_t(void *context, recording_row_t *row);

/// A row and where it stood. Private.
typedef struct {
    recording_row_t row;
    size_t number;
} kept_row_t;

/// Start from all zero; all members are private.
typedef struct {
    kept_row_t *rows;
    size_t count;
    size_t capacity;
    size_t at;
    recording_event_t event; /* after the last one; RECORDING_ROW: nothing was read yet */
} kept_rows_t;

/// The next row in order; the first call reads them all. Rows of one time come as they stood, those without a time at the end.
recording_event_t kept_rows_next(kept_rows_t *kept, kept_rows_read_t *read, void *context, recording_row_t *row);

/// Releases memory.
void kept_rows_free(kept_rows_t *kept);

#endif

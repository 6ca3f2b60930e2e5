/* SPDX-License-Identifier: MIT */
/* Rows in the order of their times. */
#include "input/kept_rows.h"

#include <stdlib.h>

static bool keep(kept_rows_t *kept, const recording_row_t *row)
{
    if (kept->count == kept->capacity) {
        const size_t capacity = (kept->capacity == 0) ? 1024 : 2 * kept->capacity;
        kept_row_t *rows = realloc(kept->rows, capacity * sizeof *rows);
        if (rows == NULL) {
            return false;
        }
        kept->rows = rows;
        kept->capacity = capacity;
    }
    kept->rows[kept->count] = (kept_row_t){*row, kept->count};
    kept->count++;
    return true;
}

/* By time, rows of one time as they came, rows without one at the end. */
static int compare(const void *a, const void *b)
{
    const kept_row_t *x = a;
    const kept_row_t *y = b;
    const bool timed = x->row.has_time && y->row.has_time;
    if (timed && x->row.t_us != y->row.t_us) {
        return (x->row.t_us > y->row.t_us) ? 1 : -1;
    }
    if (!timed && x->row.has_time != y->row.has_time) {
        return x->row.has_time ? -1 : 1;
    }
    return (x->number > y->number) - (x->number < y->number);
}

/* Reads all rows and sorts them. */
static void keep_all(kept_rows_t *kept, kept_rows_read_t *read, void *context)
{
    recording_row_t row;
    recording_event_t event = read(context, &row);
    while (event == RECORDING_ROW) {
        event = keep(kept, &row) ? read(context, &row) : RECORDING_FAILED;
    }
    kept->event = event;
    if (kept->count > 0) {
        qsort(kept->rows, kept->count, sizeof *kept->rows, compare);
    }
}

recording_event_t kept_rows_next(kept_rows_t *kept, kept_rows_read_t *read, void *context, recording_row_t *row)
{
    if (kept->at == 0 && kept->event == RECORDING_ROW) {
        keep_all(kept, read, context);
    }
    if (kept->event != RECORDING_END || kept->at == kept->count) {
        return kept->event;
    }
    *row = kept->rows[kept->at++].row;
    return RECORDING_ROW;
}

void kept_rows_free(kept_rows_t *kept)
{
    free(kept->rows);
    kept->rows = NULL;
}

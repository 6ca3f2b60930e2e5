/* SPDX-License-Identifier: MIT */
/* A recording of two or three IMUs as CSV. */
#include "input/recording.h"

#include "input/header_help.h"
#include "input/number.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ALL_COLUMNS RECORDING_ALL_COLUMNS
#define FIRST_THIRD (RECORDING_COLUMNS + RECORDING_ORIENTATION_COLUMNS)
#define FIRST_THIRD_ORIENTATION (FIRST_THIRD + RECORDING_THIRD_COLUMNS)

static const char *const COLUMN_NAMES[ALL_COLUMNS] = {
    "t_s",    "gyr1_x", "gyr1_y", "gyr1_z", "acc1_x", "acc1_y", "acc1_z", "gyr2_x", "gyr2_y", "gyr2_z", "acc2_x",
    "acc2_y", "acc2_z", "q1_w",   "q1_x",   "q1_y",   "q1_z",   "q2_w",   "q2_x",   "q2_y",   "q2_z",   "gyr3_x",
    "gyr3_y", "gyr3_z", "acc3_x", "acc3_y", "acc3_z", "q3_w",   "q3_x",   "q3_y",   "q3_z"};

/* Of a file that has one sensor. */
static const char *const ONE_NAMES[RECORDING_ONE_COLUMNS] = {"t_s",   "gyr_x", "gyr_y", "gyr_z",
                                                             "acc_x", "acc_y", "acc_z"};

static const char *const *names_of(const recording_t *recording)
{
    return (recording->one != 0) ? ONE_NAMES : COLUMN_NAMES;
}

/* Columns that must be there, which stand first. */
static size_t needed(const recording_t *recording)
{
    return (recording->one != 0) ? RECORDING_ONE_COLUMNS : RECORDING_COLUMNS;
}

__attribute__((format(printf, 4, 5))) static recording_event_t bad(recording_t *recording, uint64_t line,
                                                                   uint64_t column, const char *format, ...)
{
    recording_fault_t *fault = &recording->fault;
    fault->line = line;
    fault->column = column;
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(fault->text, sizeof fault->text, format, arguments);
    va_end(arguments);
    return RECORDING_BAD;
}

/* The reader's own errors in our terms. */
static recording_event_t csv_trouble(recording_t *recording, csv_event_t event)
{
    const csv_t *csv = &recording->csv;
    if (event == CSV_BAD) {
        return bad(recording, csv->error_line, csv->error_column, "%s", csv->error);
    }
    return RECORDING_FAILED;
}

/* The beginning of a cell, fit for a message: bytes that do not print become '?'. */
static const char *shown(const char *text, char buffer[static 32])
{
    (void)snprintf(buffer, 32, "%.28s%s", text, (strlen(text) > 28) ? "..." : "");
    for (char *at = buffer; *at != '\0'; at++) {
        *at = isprint((unsigned char)*at) ? *at : '?';
    }
    return buffer;
}

/* Number of our column that is called so, or ALL_COLUMNS. */
static size_t column_named(const recording_t *recording, const char *name)
{
    const size_t count = (recording->one != 0) ? RECORDING_ONE_COLUMNS : ALL_COLUMNS;
    size_t k = 0;
    while (k < count && strcmp(name, names_of(recording)[k]) != 0) {
        k++;
    }
    return (k < count) ? k : ALL_COLUMNS;
}

static const char ONE_SENSOR[] =
    "the columns of one sensor: the file of the other sensor is missing, or gyr1_x ... acc2_z of both in this one";
static const char TWO_SENSORS[] =
    "the columns of two sensors: of two files each has one, in the columns t_s, gyr_x ... acc_z";

/* The header has all of these. */
static bool has_all(const recording_t *recording, const char *const *names, size_t count)
{
    const csv_t *csv = &recording->csv;
    size_t found = 0;
    for (size_t k = 0; k < csv->cell_count; k++) {
        for (size_t j = 0; j < count; j++) {
            found += (strcmp(csv->cells[k].text, names[j]) == 0) ? 1u : 0u;
        }
    }
    return found >= count;
}

/* Names every column that is missing, of those from `first` to before `end`. */
static recording_event_t check_missing(recording_t *recording, size_t first_column, size_t end)
{
    char names[192] = "";
    size_t length = 0;
    size_t count = 0;
    for (size_t k = first_column; k < end; k++) {
        if (!recording->found[k]) {
            /* All names together are shorter than the buffer. */
            length += (size_t)snprintf(names + length, sizeof names - length, "%s%s", (count == 0) ? "" : ", ",
                                       names_of(recording)[k]);
            count++;
        }
    }
    if (count == 0) {
        return RECORDING_ROW;
    }
    const uint64_t line = recording->csv.cells[0].line;
    const bool one = recording->one != 0;
    if (first_column == 0 &&
        has_all(recording, one ? COLUMN_NAMES : ONE_NAMES, one ? RECORDING_COLUMNS : RECORDING_ONE_COLUMNS)) {
        return bad(recording, line, 0, "%s", one ? TWO_SENSORS : ONE_SENSOR);
    }
    const header_names_t ours = {names_of(recording),
                                 one ? RECORDING_ONE_COLUMNS : ALL_COLUMNS,
                                 recording->found,
                                 end,
                                 one ? "t_s, gyr_x ... acc_z" : "t_s, gyr1_x ... acc2_z",
                                 one ? "one sensor in each file" : "both sensors in one file"};
    char help[HEADER_HELP_MAX];
    if (header_help(&recording->csv, &ours, help)) {
        return bad(recording, line, 0, "%s", help);
    }
    return bad(recording, line, 0, "missing column%s %s%s", (count == 1) ? "" : "s", names, help);
}

static bool all_found(const recording_t *recording, size_t first, size_t end)
{
    bool all = true;
    for (size_t k = first; k < end; k++) {
        all = all && recording->found[k];
    }
    return all;
}

static recording_event_t read_header(recording_t *recording)
{
    const csv_event_t event = csv_next(&recording->csv);
    if (event == CSV_END) {
        return bad(recording, 0, 0, "the file is empty");
    }
    if (event != CSV_ROW) {
        return csv_trouble(recording, event);
    }
    bool *const found = recording->found;
    recording->header_cells = recording->csv.cell_count;
    recording->header_line = recording->csv.cells[0].line;
    for (size_t k = 0; k < recording->header_cells; k++) {
        const csv_cell_t *cell = &recording->csv.cells[k];
        const size_t column = column_named(recording, cell->text);
        if (column == ALL_COLUMNS) {
            continue;
        }
        if (found[column]) {
            return bad(recording, cell->line, cell->column, "column %s appears twice", cell->text);
        }
        found[column] = true;
        recording->index[column] = k;
    }
    recording->has_orientations = recording->one == 0 && all_found(recording, RECORDING_COLUMNS, FIRST_THIRD);
    return check_missing(recording, 0, needed(recording));
}

bool recording_has_third(const recording_t *recording)
{
    return all_found(recording, FIRST_THIRD, FIRST_THIRD_ORIENTATION);
}

recording_event_t recording_want_third(recording_t *recording)
{
    recording->want_third = true;
    recording->has_orientations =
        recording->has_orientations && all_found(recording, FIRST_THIRD_ORIENTATION, ALL_COLUMNS);
    return check_missing(recording, FIRST_THIRD, FIRST_THIRD_ORIENTATION);
}

/* As many cells as the header has; more only if they are empty: many programs write a comma at the end of a line. */
static recording_event_t check_length(recording_t *recording)
{
    const csv_t *csv = &recording->csv;
    if (csv->cell_count < recording->header_cells) {
        return bad(recording, csv->cells[0].line, 0, "short line: %zu of %zu cells", csv->cell_count,
                   recording->header_cells);
    }
    for (size_t k = recording->header_cells; k < csv->cell_count; k++) {
        if (csv->cells[k].text[0] != '\0') {
            const bool decimals = csv->cell_count + 1 >= 2 * recording->header_cells;
            return bad(recording, csv->cells[k].line, csv->cells[k].column,
                       "long line: %zu cells where the header has %zu%s", csv->cell_count, recording->header_cells,
                       decimals ? ": are these decimal commas? Write points" : "");
        }
    }
    return RECORDING_ROW;
}

/* No cell of our columns begins like a number. */
static bool all_text(const recording_t *recording)
{
    for (size_t k = 0; k < needed(recording); k++) {
        const char *text = recording->csv.cells[recording->index[k]].text;
        if (text[0] == '\0' || strchr("+-.0123456789", text[0]) != NULL) {
            return false;
        }
    }
    return true;
}

static recording_event_t not_a_number(recording_t *recording, size_t column)
{
    const csv_cell_t *cell = &recording->csv.cells[recording->index[column]];
    if (column_named(recording, cell->text) != ALL_COLUMNS) {
        return bad(recording, cell->line, 0, "a second header line");
    }
    char buffer[32];
    if (recording->csv.cells[0].line <= recording->header_line + 1 && all_text(recording)) {
        return bad(recording, cell->line, 0, "a line of units or of names below the header: take it out");
    }
    return bad(recording, cell->line, cell->column, "%s: '%s' is not a number%s", names_of(recording)[column],
               shown(cell->text, buffer), number_help(cell->text, column == 0));
}

recording_event_t recording_open(recording_t *recording, csv_read_t *read, void *context)
{
    memset(recording, 0, sizeof *recording);
    csv_open(&recording->csv, read, context);
    return read_header(recording);
}

recording_event_t recording_open_one(recording_t *recording, csv_read_t *read, void *context, int which)
{
    memset(recording, 0, sizeof *recording);
    recording->one = which;
    csv_open(&recording->csv, read, context);
    return read_header(recording);
}

void recording_open_source(recording_t *recording, recording_source_t *source, void *context)
{
    memset(recording, 0, sizeof *recording);
    recording->source = source;
    recording->source_context = context;
}

/* Names the columns of one sensor's orientation that are missing, at the leftmost one that is there. */
static recording_event_t part_missing(recording_t *recording, size_t first)
{
    char names[64] = "";
    size_t length = 0;
    size_t leftmost = recording->header_cells;
    for (size_t k = first; k < first + 4; k++) {
        if (!recording->found[k]) {
            length += (size_t)snprintf(names + length, sizeof names - length, "%s%s", (length == 0) ? "" : ", ",
                                       COLUMN_NAMES[k]);
        } else if (recording->index[k] < leftmost) {
            leftmost = recording->index[k];
        }
    }
    const csv_cell_t *there = &recording->csv.cells[leftmost];
    return bad(recording, there->line, there->column, "%s without %s: an orientation has four columns", there->text,
               names);
}

recording_event_t recording_check_orientations(recording_t *recording)
{
    const size_t firsts[] = {RECORDING_COLUMNS, RECORDING_COLUMNS + 4, FIRST_THIRD_ORIENTATION};
    const size_t sensors = recording->want_third ? 3 : 2;
    for (size_t sensor = 0; sensor < sensors; sensor++) {
        const size_t first = firsts[sensor];
        size_t count = 0;
        for (size_t k = first; k < first + 4; k++) {
            count += recording->found[k] ? 1 : 0;
        }
        if (count != 0 && count != 4) {
            return part_missing(recording, first);
        }
    }
    return RECORDING_ROW;
}

recording_event_t recording_refuse(recording_t *recording, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    recording->fault.line = 0;
    recording->fault.column = 0;
    (void)vsnprintf(recording->fault.text, sizeof recording->fault.text, format, arguments);
    va_end(arguments);
    return RECORDING_BAD;
}

/* Columns that nobody asked for may hold anything. */
static bool is_wanted(const recording_t *recording, size_t column)
{
    if (column < needed(recording) || recording->one != 0) {
        return column < needed(recording);
    }
    if (column < FIRST_THIRD) {
        return recording->want_orientations;
    }
    return recording->want_third && (column < FIRST_THIRD_ORIENTATION || recording->want_orientations);
}

void recording_watch(check_t *check, const recording_row_t *row, bool third)
{
    const check_row_t shown_row = {.t_s = row->t_s,
                                   .has_time = row->has_time,
                                   .t_us = row->t_us,
                                   .imu = {&row->imu1, &row->imu2, third ? &row->imu3 : NULL}};
    check_push(check, &shown_row);
}

static recording_event_t read_row(void *self, recording_row_t *row)
{
    recording_t *recording = self;
    const csv_event_t event = csv_next(&recording->csv);
    if (event == CSV_END) {
        return RECORDING_END;
    }
    if (event != CSV_ROW) {
        return csv_trouble(recording, event);
    }
    const recording_event_t length = check_length(recording);
    if (length != RECORDING_ROW) {
        return length;
    }
    const csv_cell_t *cells = recording->csv.cells;
    const number_kind_t time = number_to_us(cells[recording->index[0]].text, &row->t_us);
    if (time == NUMBER_NOT_A_NUMBER) {
        return not_a_number(recording, 0);
    }
    row->has_time = time == NUMBER_FINITE;
    /* A time in another unit may be too large for us and still tell what unit it is in. */
    const char *text = cells[recording->index[0]].text;
    row->t_s = (text[0] == '\0') ? (double)NAN : strtod(text, NULL);
    float values[ALL_COLUMNS] = {0.0f};
    for (size_t k = 1; k < ALL_COLUMNS; k++) {
        if (is_wanted(recording, k) &&
            number_to_float(cells[recording->index[k]].text, &values[k]) == NUMBER_NOT_A_NUMBER) {
            return not_a_number(recording, k);
        }
    }
    row->imu1 = (jcal_imu_t){{values[1], values[2], values[3]}, {values[4], values[5], values[6]}};
    row->imu2 = (jcal_imu_t){{values[7], values[8], values[9]}, {values[10], values[11], values[12]}};
    /* Without orientations these are zero, which is no quaternion either. */
    row->q1 = (jcal_quat_t){values[13], values[14], values[15], values[16]};
    row->q2 = (jcal_quat_t){values[17], values[18], values[19], values[20]};
    row->imu3 = (jcal_imu_t){{values[21], values[22], values[23]}, {values[24], values[25], values[26]}};
    row->q3 = (jcal_quat_t){values[27], values[28], values[29], values[30]};
    return RECORDING_ROW;
}

void recording_want_sorted(recording_t *recording)
{
    recording->want_sorted = true;
}

static recording_event_t next_row(recording_t *recording, recording_row_t *row)
{
    if (recording->source != NULL) {
        return recording->source(recording->source_context, row);
    }
    return recording->want_sorted ? kept_rows_next(&recording->kept, read_row, recording, row)
                                  : read_row(recording, row);
}

static void watch_one(recording_t *recording, const recording_row_t *row)
{
    const bool first = recording->one == 1;
    const check_row_t shown_row = {.t_s = row->t_s,
                                   .has_time = row->has_time,
                                   .t_us = row->t_us,
                                   .imu = {first ? &row->imu1 : NULL, first ? NULL : &row->imu1, NULL}};
    check_push(&recording->check, &shown_row);
}

recording_event_t recording_next(recording_t *recording, recording_row_t *row)
{
    const recording_event_t event = next_row(recording, row);
    if (event == RECORDING_ROW && recording->one == 0) {
        recording_watch(&recording->check, row, recording->want_third);
    } else if (event == RECORDING_ROW) {
        watch_one(recording, row);
    }
    return event;
}

void recording_close(recording_t *recording)
{
    csv_close(&recording->csv);
    kept_rows_free(&recording->kept);
}

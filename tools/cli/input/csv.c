/* SPDX-License-Identifier: MIT */
/* Rows and cells of comma-separated text. */
#include "input/csv.h"

#include "input/file_kind.h"

#include <stdlib.h>
#include <string.h>

#define END_OF_TEXT (-1)

/* Stands in `error` for trouble that has no place in the text: reading failed, or memory ran out. */
static const char FAILED[] = "";

/* What ended a cell. */
typedef enum { CELL_COMMA, CELL_LINE, CELL_TEXT_END, CELL_BAD } cell_end_t;

static void fail(csv_t *csv, const char *what, uint64_t line, uint64_t column)
{
    /* The first error is the cause of those that follow it. */
    if (csv->error == NULL) {
        csv->error = what;
        csv->error_line = line;
        csv->error_column = column;
    }
}

/* Appends what the source has to the chunk. */
static void fill(csv_t *csv)
{
    const long got = csv->read(csv->context, csv->chunk + csv->chunk_size, sizeof csv->chunk - csv->chunk_size);
    if (got < 0) {
        fail(csv, FAILED, 0, 0);
    }
    csv->ended = got <= 0;
    csv->chunk_size += (got > 0) ? (size_t)got : 0;
}

/* The byte that comes next, which stays; END_OF_TEXT after the last one and after a failure. */
static int peek(csv_t *csv)
{
    if (csv->chunk_at == csv->chunk_size && !csv->ended) {
        csv->chunk_at = 0;
        csv->chunk_size = 0;
        fill(csv);
    }
    return (csv->chunk_at < csv->chunk_size) ? (unsigned char)csv->chunk[csv->chunk_at] : END_OF_TEXT;
}

/* Takes the byte that peek showed. */
static void skip(csv_t *csv)
{
    csv->chunk_at++;
    csv->bytes++;
    csv->column++;
}

/* Takes a line end of any kind, if there is one. */
static bool skip_line_end(csv_t *csv)
{
    const int c = peek(csv);
    if (c != '\n' && c != '\r') {
        return false;
    }
    skip(csv);
    if (c == '\r' && peek(csv) == '\n') {
        skip(csv);
    }
    csv->line++;
    csv->column = 1;
    return true;
}

static void skip_blanks(csv_t *csv)
{
    while (peek(csv) == ' ' || peek(csv) == '\t') {
        skip(csv);
    }
}

/* Appends a byte to the texts of this row. */
static bool append(csv_t *csv, char c)
{
    if (csv->text_size == CSV_ROW_MAX) {
        fail(csv, "a row of more than a million bytes: this is not a recording", csv->line, 0);
        return false;
    }
    if (csv->text_size == csv->text_capacity) {
        const size_t capacity = (csv->text_capacity == 0) ? 1024 : 2 * csv->text_capacity;
        char *text = realloc(csv->text, capacity);
        if (text == NULL) {
            fail(csv, FAILED, 0, 0);
            return false;
        }
        csv->text = text;
        csv->text_capacity = capacity;
    }
    csv->text[csv->text_size++] = c;
    return true;
}

/* Appends a byte of a cell. */
static bool keep(csv_t *csv, int c)
{
    if (c == '\0') {
        fail(csv, "a zero byte: this is not a text file", csv->line, csv->column);
        return false;
    }
    return append(csv, (char)c);
}

/* The text between quotes; a doubled quote stands for one; line ends are part of it. */
static bool read_quoted(csv_t *csv)
{
    const uint64_t line = csv->line;
    const uint64_t column = csv->column;
    skip(csv);
    for (;;) {
        const int c = peek(csv);
        if (c == END_OF_TEXT) {
            fail(csv, "a quote that is never closed", line, column);
            return false;
        }
        if (skip_line_end(csv)) {
            if (!keep(csv, '\n')) {
                return false;
            }
            continue;
        }
        if (c == '"') {
            skip(csv);
            if (peek(csv) != '"') {
                return true;
            }
        }
        if (!keep(csv, c)) {
            return false;
        }
        skip(csv);
    }
}

/* The text up to the next comma or line end. */
static bool read_plain(csv_t *csv)
{
    for (;;) {
        const int c = peek(csv);
        if (c == END_OF_TEXT || c == ',' || c == '\n' || c == '\r') {
            return true;
        }
        if (!keep(csv, c)) {
            return false;
        }
        skip(csv);
    }
}

/* Takes what stands after a cell. */
static cell_end_t read_cell_end(csv_t *csv)
{
    skip_blanks(csv);
    const int c = peek(csv);
    if (c == ',') {
        skip(csv);
        return CELL_COMMA;
    }
    if (c == END_OF_TEXT) {
        return CELL_TEXT_END;
    }
    if (!skip_line_end(csv)) {
        fail(csv, (c == '\0') ? "a zero byte: this is not a text file" : "text after a closing quote", csv->line,
             csv->column);
        return CELL_BAD;
    }
    return CELL_LINE;
}

/* Room for one more cell. */
static bool grow_cells(csv_t *csv)
{
    if (csv->cell_count < csv->cell_capacity) {
        return true;
    }
    const size_t capacity = (csv->cell_capacity == 0) ? 64 : 2 * csv->cell_capacity;
    csv_cell_t *cells = realloc(csv->cells, capacity * sizeof *cells);
    if (cells == NULL) {
        fail(csv, FAILED, 0, 0);
        return false;
    }
    csv->cells = cells;
    csv->cell_capacity = capacity;
    return true;
}

static cell_end_t read_cell(csv_t *csv)
{
    if (!grow_cells(csv)) {
        return CELL_BAD;
    }
    skip_blanks(csv);
    const size_t start = csv->text_size;
    csv->cells[csv->cell_count++] = (csv_cell_t){.offset = start, .line = csv->line, .column = csv->column};
    const bool quoted = peek(csv) == '"';
    if (!(quoted ? read_quoted(csv) : read_plain(csv))) {
        return CELL_BAD;
    }
    while (!quoted && csv->text_size > start && strchr(" \t", csv->text[csv->text_size - 1]) != NULL) {
        csv->text_size--;
    }
    return append(csv, '\0') ? read_cell_end(csv) : CELL_BAD;
}

static csv_event_t read_row(csv_t *csv)
{
    csv->cell_count = 0;
    csv->text_size = 0;
    cell_end_t end = CELL_COMMA;
    while (end == CELL_COMMA) {
        end = read_cell(csv);
    }
    if (csv->error != NULL) {
        return (csv->error == FAILED) ? CSV_FAILED : CSV_BAD;
    }
    /* Only now, because the texts move while they grow. */
    for (size_t k = 0; k < csv->cell_count; k++) {
        csv->cells[k].text = csv->text + csv->cells[k].offset;
    }
    return CSV_ROW;
}

/* Skips blank lines. */
static void skip_blank_lines(csv_t *csv)
{
    do {
        skip_blanks(csv);
    } while (skip_line_end(csv));
}

void csv_open(csv_t *csv, csv_read_t *read, void *context)
{
    memset(csv, 0, sizeof *csv);
    csv->read = read;
    csv->context = context;
    csv->line = 1;
    csv->column = 1;
    static const char mark[3] = {'\xEF', '\xBB', '\xBF'};
    /* A pipe may hand over single bytes. */
    while (csv->chunk_size < FILE_KIND_BYTES && !csv->ended) {
        fill(csv);
    }
    const char *kind = file_kind(csv->chunk, csv->chunk_size);
    if (kind != NULL) {
        fail(csv, kind, 0, 0);
        return;
    }
    if (csv->chunk_size >= sizeof mark && memcmp(csv->chunk, mark, sizeof mark) == 0) {
        csv->chunk_at = sizeof mark;
        csv->bytes = sizeof mark;
    }
}

csv_event_t csv_next(csv_t *csv)
{
    if (csv->error != NULL) {
        return (csv->error == FAILED) ? CSV_FAILED : CSV_BAD;
    }
    skip_blank_lines(csv);
    if (peek(csv) == END_OF_TEXT) {
        return (csv->error == NULL) ? CSV_END : CSV_FAILED;
    }
    return read_row(csv);
}

void csv_close(csv_t *csv)
{
    free(csv->text);
    free(csv->cells);
    csv->text = NULL;
    csv->cells = NULL;
}

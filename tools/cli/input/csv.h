/* SPDX-License-Identifier: MIT */
/// @file
/// Rows and cells of comma-separated text [RFC 4180], read in one pass with bounded memory.
///
/// Own code and not libcsv, because error messages need the line and column of a cell, which libcsv does not know, and
/// because its cells may grow without limit on a file that is no CSV.
#ifndef JCAL_CLI_INPUT_CSV_H
#define JCAL_CLI_INPUT_CSV_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Longest row in bytes: far more than any recording has, little enough to hold.
#define CSV_ROW_MAX ((size_t)1 << 20)

/// Where bytes come from: fills `buffer`, returns the number of bytes, 0 at the end, -1 on failure.
typedef long csv_read_t(void *context, char *buffer, size_t size);

/// A cell: text without quotes and surrounding blanks, ended by a NUL; and where it starts, both counted from 1.
typedef struct {
    const char *text;
    uint64_t line;
    uint64_t column;  ///< In bytes.
    size_t offset;    /* private: of the text among the row's texts */
} csv_cell_t;

typedef enum {
    CSV_ROW,    ///< A row was read.
    CSV_END,    ///< There are no more rows.
    CSV_BAD,    ///< The text is no CSV: see error, error_line, error_column.
    CSV_FAILED  ///< Reading failed, or memory ran out: see error.
} csv_event_t;

typedef struct {
    csv_cell_t *cells;  ///< Cells of the row, valid until the next call.
    size_t cell_count;
    const char *error;
    uint64_t error_line;
    uint64_t error_column;
    uint64_t bytes;  ///< Bytes taken from the source so far.

    /* Private. */
    csv_read_t *read;
    void *context;
    size_t cell_capacity;
    char *text; /* texts of the cells, one after the other */
    size_t text_size;
    size_t text_capacity;
    char chunk[65536];
    size_t chunk_size;
    size_t chunk_at;
    uint64_t line; /* of the byte that comes next */
    uint64_t column;
    bool ended;
} csv_t;

/// Prepares `csv`. A byte order mark at the beginning is skipped.
void csv_open(csv_t *csv, csv_read_t *read, void *context);

/// Reads the next row that is not blank. Lines may end in LF, CR LF or CR; the last one may lack its end.
csv_event_t csv_next(csv_t *csv);

/// Releases memory.
void csv_close(csv_t *csv);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What a file without our columns is, and what was probably meant: names written in another way, another separator, lines before the
/// header, exports of other makers, no header at all.
#ifndef JCAL_CLI_INPUT_HEADER_HELP_H
#define JCAL_CLI_INPUT_HEADER_HELP_H

#include "input/csv.h"

/// Names that a column must have.
typedef struct {
    const char *const *names;
    size_t count;
    const bool *found;    ///< Those that are there.
    size_t needed;        ///< The first so many must be.
    const char *columns;  ///< Those in short ...
    const char *where;    ///< ... and in which file they stand.
} header_names_t;

#define HEADER_HELP_MAX 640

/// Looks at the first row, which `csv` has just read, and at the lines after it. Writes what helps, to be put after "missing columns ...",
/// and begins with a separator; or writes what the file is instead, and returns true. `text` is empty if there is nothing to say.
bool header_help(csv_t *csv, const header_names_t *names, char text[static HEADER_HELP_MAX]);

/// What helps with a cell that should hold a number and holds this text; begins with a separator, or is empty. `is_time` of t_s.
const char *number_help(const char *text, bool is_time);

#endif

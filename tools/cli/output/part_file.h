/* SPDX-License-Identifier: MIT */
/// @file
/// A file that appears under its name only when it is complete: until then it is NAME.part, which is removed if the program ends early,
/// by a signal too.
#ifndef JCAL_CLI_OUTPUT_PART_FILE_H
#define JCAL_CLI_OUTPUT_PART_FILE_H

#include <stdbool.h>
#include <stdio.h>

/// Opens `name`.part for writing, or `name` itself where that is no plain file (a device, a pipe). Null with errno set. One at a time.
FILE *part_file_open(const char *name);

/// Closes the file and gives it its name. False with errno set.
bool part_file_finish(FILE *file, const char *name);

/// Closes the file and removes it.
void part_file_drop(FILE *file);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Exit statuses and error messages of the program.
#ifndef JCAL_CLI_OUTPUT_MESSAGE_H
#define JCAL_CLI_OUTPUT_MESSAGE_H

#include <stdint.h>

/// Exit statuses.
typedef enum {
    EXIT_READY = 0,     ///< Read to the end, ready.
    EXIT_TROUBLE = 1,   ///< Anything that is not the input's fault: memory, full disk, closed pipe.
    EXIT_INPUT = 2,     ///< The command line or the recording is wrong.
    EXIT_NOT_READY = 3  ///< Read to the end, not ready.
} exit_status_t;

/// Writes `FILE:LINE:COLUMN: text` to standard error. A line or column of 0 is left out.
__attribute__((format(printf, 4, 5))) void complain(const char *file, uint64_t line, uint64_t column,
                                                    const char *format, ...);

/// Says why standard output or a file could not be written, from errno; nothing of a pipe that its reader has closed, as `| head` does.
/// Returns EXIT_TROUBLE.
exit_status_t complain_output(const char *name);

#endif

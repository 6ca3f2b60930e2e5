/* SPDX-License-Identifier: MIT */
/// @file
/// Times of rows, from whatever origin, as times for the library.
#ifndef JCAL_CLI_INPUT_ROW_CLOCK_H
#define JCAL_CLI_INPUT_ROW_CLOCK_H

#include "input/recording.h"

/// Start from all zero.
typedef struct {
    bool has_time;       ///< False while no row had a time.
    int64_t start_us;    ///< First time in the file.
    int64_t t_us;        ///< Largest time so far, as in the file.
    uint64_t pushed_us;  ///< Time of the row before, in the library's time.
} row_clock_t;

/// Takes note of a row's time. Returns the row's time for the library; a row without one gets that of the row before.
uint64_t row_clock_advance(row_clock_t *clock, const recording_row_t *row);

#endif

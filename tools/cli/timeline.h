/* SPDX-License-Identifier: MIT */
/// @file
/// The library's time of rows: microseconds from an origin of their own, so that times in a file may start anywhere.
#ifndef JCAL_CLI_TIMELINE_H
#define JCAL_CLI_TIMELINE_H

#include "recording.h"

typedef struct {
    bool has_time;      ///< False while no row had a time.
    int64_t start_us;   ///< First time in the file.
    int64_t latest_us;  ///< Largest time so far, as in the file.
    uint64_t now_us;    ///< The library's time of the last row.
} timeline_t;

/// Takes note of a row's time; returns the library's time of it, that of the row before if it has none.
uint64_t timeline_advance(timeline_t *timeline, const recording_row_t *row);

#endif

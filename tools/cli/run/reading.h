/* SPDX-License-Identifier: MIT */
/// @file
/// A recording that is being read from a file or from standard input, with progress, and what is said when that fails.
#ifndef JCAL_CLI_RUN_READING_H
#define JCAL_CLI_RUN_READING_H

#include "input/input.h"
#include "input/recording.h"
#include "output/message.h"
#include "output/progress.h"

typedef struct {
    input_t input;
    recording_t recording;
    progress_t progress;
} reading_t;

/// Opens a recording and reads its header; "-" is standard input. Rows come in the order of their times if `sorted`. EXIT_READY, or another status after a message.
exit_status_t reading_open(reading_t *reading, const char *name, bool sorted);

/// Draws progress from here on.
void reading_begin(reading_t *reading);

/// Shows how far the reading has come.
void reading_advance(reading_t *reading);

/// Says why the recording could not be read on; the status that this makes.
exit_status_t reading_give_up(reading_t *reading, recording_event_t event);

/// Closes it; also after a failed open.
void reading_close(reading_t *reading);

#endif

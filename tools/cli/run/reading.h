/* SPDX-License-Identifier: MIT */
/// @file
/// A recording that is being read from a file or from standard input, with progress, and what is said when that fails.
#ifndef JCAL_CLI_RUN_READING_H
#define JCAL_CLI_RUN_READING_H

#include "input/input.h"
#include "input/recording.h"
#include "options/common.h"
#include "output/message.h"
#include "output/progress.h"
#include "run/lag_watch.h"
#include "run/two_files.h"

typedef struct {
    input_t input;
    recording_t recording;
    progress_t progress;
    two_files_t *two;  ///< If the recording is in two files; else null.
} reading_t;

/// Opens a recording and reads its header; "-" is standard input. Rows come in the order of their times if `sorted`. EXIT_READY, or another status after a message.
exit_status_t reading_open(reading_t *reading, const char *name, bool sorted);

/// The same of what the command line says, which may be two files with one sensor each.
/// `watched`: what the sensors of two files do is of interest (two_files.h).
exit_status_t reading_open_given(reading_t *reading, const common_options_t *options, bool watched);

/// What there is to say of the recording as a whole; `reason` is what the joint says.
void reading_findings(const reading_t *reading, jcal_reason_t reason, check_findings_t *findings);

/// What is known of the lag: of two files it is taken off; of one, `watch` saw its rows, and what to do is added to what there is to say.
report_lag_t reading_lag(const reading_t *reading, const lag_watch_t *watch, check_findings_t *findings);

/// Draws progress from here on.
void reading_begin(reading_t *reading);

/// Shows how far the reading has come.
void reading_advance(reading_t *reading);

/// Says why the recording could not be read on; the status that this makes.
exit_status_t reading_give_up(reading_t *reading, recording_event_t event);

/// Closes it; also after a failed open.
void reading_close(reading_t *reading);

#endif

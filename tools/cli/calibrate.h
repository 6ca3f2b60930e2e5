/* SPDX-License-Identifier: MIT */
/// @file
/// The run of a calibration, whatever the joint: rows in, events out.
#ifndef JCAL_CLI_CALIBRATE_H
#define JCAL_CLI_CALIBRATE_H

#include "message.h"
#include "recording.h"
#include "report.h"

/// What every calibration can be asked for.
typedef struct {
    const char *recording;  ///< File name, "-" for standard input.
    bool json;
    int64_t every_us;  ///< 0 if not asked for.
} calibrate_options_t;

/// A joint; `self` is its own state.
typedef struct {
    /// Prepares for a recording whose header has been read; as recording_open.
    recording_event_t (*open)(void *self, recording_t *recording);
    /// Next row; as recording_next.
    recording_event_t (*next)(void *self, recording_t *recording, recording_row_t *row);
    /// Takes in the row that `next` gave; false if the library refuses the call itself.
    bool (*push)(void *self, const recording_row_t *row, uint64_t t_us);
    /// Fetches the result.
    finding_t (*get)(void *self);
    void (*write_json)(const void *self, FILE *file, const char *event, const report_t *report);
    void (*print_summary)(const void *self, FILE *file, const report_t *report);
    void (*close)(void *self);
    const report_words_t *words;
} calibrate_joint_t;

/// Runs over a recording; `max_bound` in rad or m. Errors are told on standard error.
exit_status_t calibrate(const calibrate_options_t *options, const calibrate_joint_t *joint, void *self,
                        float max_bound);

#endif

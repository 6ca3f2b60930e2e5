/* SPDX-License-Identifier: MIT */
/// @file
/// The run of a calibration, whatever the joint: rows in, events out.
#ifndef JCAL_CLI_RUN_CALIBRATE_H
#define JCAL_CLI_RUN_CALIBRATE_H

#include "input/recording.h"
#include "options/common.h"
#include "output/message.h"
#include "output/report.h"

/// A joint; `self` is its own state.
typedef struct {
    const report_words_t *words;
    bool third;          ///< It has three sensors.
    bool uses_readings;  ///< It looks at rates and accelerations even where orientations are in the recording.
    /// Takes in a row; false if the library refuses the call itself. Rows without a time come with rates that are NaN, rows whose
    /// orientations are of no use do not come.
    bool (*push)(void *self, const recording_row_t *row, uint64_t t_us);
    /// Forgets all data, counters included: headings have nothing to do any more with those of before. Null if it uses none.
    void (*reset)(void *self);
    /// Fetches the result into `self` and returns its head.
    const jcal_head_t *(*get)(void *self);
    /// What a line about an event tells of the result that was fetched last.
    report_bounds_t (*bounds)(const void *self);
    /// Adds what there is to say of the result that was fetched last, once it is ready. Null if there never is anything.
    void (*advise)(const void *self, check_findings_t *findings);
    /// Writes the keys that only this joint has.
    void (*write_json)(const void *self, json_t *json);
    void (*print_summary)(const void *self, FILE *file, const report_t *report);
} calibrate_joint_t;

/// Runs over a recording, with `oriented` rows or with readings alone. Errors are told on standard error.
exit_status_t calibrate(const common_options_t *options, const calibrate_joint_t *joint, void *self, bool oriented);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// The run of a calibration, whatever the joint: rows in, events out.
#ifndef JCAL_CLI_RUN_CALIBRATE_H
#define JCAL_CLI_RUN_CALIBRATE_H

#include "input/recording.h"
#include "options/common.h"
#include "output/message.h"
#include "output/report.h"

/// What the state of every joint begins with.
typedef struct {
    jcal_engine_t engine;  ///< Which was asked for; set before `start`.
    void *storage;         ///< Of the window engine, from malloc by `start`; calibrate frees it.
    bool oriented;         ///< `start` says so: rows come with orientations.
    report_lag_t lag;      ///< Of sensor 2, for write_json.
} calibrate_state_t;

/// A joint; `self` is its own state.
typedef struct {
    const report_words_t *words;
    size_t size;         ///< Of its state, which begins with a calibrate_state_t and is all zero before `start`.
    bool third;          ///< It has three sensors.
    bool uses_readings;  ///< It looks at rates and accelerations even where orientations are in the recording.
    /// Starts the engine. False if memory ran out: `options` of the command have been checked before.
    bool (*start)(void *self, const void *options);
    /// Takes in a row; false if the library refuses the call itself. Rows without a time come with rates that are NaN, rows whose
    /// orientations are of no use do not come.
    bool (*push)(void *self, const recording_row_t *row, uint64_t t_us);
    /// Forgets all data, counters included: headings have nothing to do any more with those of before. Null if it uses none.
    void (*reset)(void *self);
    /// Fetches the result into `self` and returns its head.
    const jcal_head_t *(*get)(void *self);
    /// The axes of the result that was fetched last; null if the joint has none.
    report_axes_t (*axes)(const void *self);
    /// What a line about an event tells of the result that was fetched last. Null if it is the bounds of the axes.
    report_bounds_t (*bounds)(const void *self);
    /// Writes the keys that only this joint has.
    void (*write_json)(const void *self, json_t *json);
    void (*print_summary)(const void *self, FILE *file, const report_t *report);
} calibrate_joint_t;

/// Runs over a recording; `own` are the options of the command for `start`. Errors are told on standard error.
exit_status_t calibrate(const common_options_t *options, const calibrate_joint_t *joint, const void *own);

#endif

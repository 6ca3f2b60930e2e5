/* SPDX-License-Identifier: MIT */
/* `jointcal center`: the engines of the joint centre in the run of a calibration. */
#include "center_command.h"

#include "calibrate.h"
#include "calibration_file.h"
#include "center_engine.h"
#include "center_options.h"
#include "center_output.h"
#include "orientations.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    center_engine_t engine;
    center_setting_t setting;
    orientations_t orientations; /* in use if setting.has_heading */
    oriented_row_t row;
    jcal_center_result_t result;
    uint32_t samples; /* rows */
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} center_run_t;

static recording_event_t open_recording(void *self, recording_t *recording)
{
    center_run_t *run = self;
    if (!run->setting.has_heading) {
        return RECORDING_ROW;
    }
    const recording_event_t event = orientations_open(&run->orientations, recording);
    run->setting.orientations = orientations_words(&run->orientations);
    return event;
}

static recording_event_t next_row(void *self, recording_t *recording, recording_row_t *row)
{
    center_run_t *run = self;
    if (!run->setting.has_heading) {
        return recording_next(recording, row);
    }
    const recording_event_t event = orientations_next(&run->orientations, &run->row);
    *row = run->row.row;
    return event;
}

/* Hands a pair to the engine; counts the cause if it rejects it. */
static bool push_pair(center_run_t *run, const jcal_pair_t *pair, const jcal_attitudes_t *attitudes)
{
    jcal_center_result_t before;
    center_engine_get(&run->engine, &before);
    if (!center_engine_update(&run->engine, pair, attitudes)) {
        return false;
    }
    center_engine_get(&run->engine, &run->result);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        run->rejected_by[k] += run->result.head.rejected_by[k] - before.head.rejected_by[k];
    }
    return true;
}

static bool push_row(void *self, const recording_row_t *row, uint64_t t_us)
{
    center_run_t *run = self;
    jcal_pair_t pair = {t_us, row->imu1, row->imu2};
    run->samples++;
    if (!row->has_time) {
        /* The library's time has no NaN; the sample has. */
        pair.imu1.gyr_rad_s.x = NAN;
    }
    if (!run->setting.has_heading) {
        return push_pair(run, &pair, NULL);
    }
    if (run->row.restarted) {
        /* The heading offset is another one now. */
        center_engine_reset(&run->engine);
    }
    if (run->row.reject != JCAL_REJECT_NONE) {
        run->rejected_by[run->row.reject]++;
        return true;
    }
    const jcal_attitudes_t attitudes = {row->q1, row->q2};
    return push_pair(run, &pair, &attitudes);
}

/* Readings that are wrong as a whole do not reach the engine if they have no orientations. */
static void add_complaint(const center_run_t *run, finding_t *finding)
{
    const jcal_reason_t complaint =
        run->setting.has_heading ? orientations_complaint(&run->orientations) : JCAL_REASON_NONE;
    if (complaint != JCAL_REASON_NONE) {
        finding->status = (finding->status == JCAL_READY) ? JCAL_COLLECTING : finding->status;
        finding->reason = complaint;
        finding->hint = JCAL_HINT_CHECK_SENSORS;
    }
}

static finding_t get_finding(void *self)
{
    center_run_t *run = self;
    center_engine_get(&run->engine, &run->result);
    finding_t finding = center_finding(&run->result);
    finding.samples = run->samples;
    finding.rejected = 0;
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        finding.rejected_by[k] = run->rejected_by[k];
        finding.rejected += run->rejected_by[k];
    }
    add_complaint(run, &finding);
    return finding;
}

static void write_json(const void *self, FILE *file, const char *event, const report_t *report)
{
    const center_run_t *run = self;
    center_write_json(file, event, report, &run->result, &run->setting);
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const center_run_t *run = self;
    center_print_summary(file, report, &run->result, &run->setting);
}

static void close_recording(void *self)
{
    center_run_t *run = self;
    if (run->setting.has_heading) {
        orientations_close(&run->orientations);
    }
}

static const calibrate_joint_t CENTER = {open_recording, next_row,      push_row,        get_finding,
                                         write_json,     print_summary, close_recording, &CENTER_WORDS};

/* Takes the axes of a hinge into the config. False after a message. */
static bool set_axes(center_options_t *options)
{
    calibration_t calibration;
    if (options->calibration == NULL) {
        return true;
    }
    if (!calibration_load(options->calibration, true, &calibration)) {
        return false;
    }
    options->engine.config.center.hinge_axis1 = calibration.axis1;
    options->engine.config.center.hinge_axis2 = calibration.axis2;
    return true;
}

int center_command(int argc, char **argv)
{
    center_options_t options = center_options(argc, argv);
    if (!set_axes(&options)) {
        return EXIT_INPUT;
    }
    center_run_t *run = calloc(1, sizeof *run);
    exit_status_t status = EXIT_TROUBLE;
    if (run == NULL || !center_engine_start(&run->engine, &options.engine)) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    } else {
        run->setting.is_hinge = options.calibration != NULL;
        run->setting.has_heading = options.engine.config.center.method == JCAL_CENTER_LS;
        status = calibrate(&options.common, &CENTER, run, options.engine.config.center.max_bound_m);
    }
    if (run != NULL) {
        center_engine_stop(&run->engine);
    }
    free(run);
    return (int)status;
}

/* SPDX-License-Identifier: MIT */
/* `jointcal chain`: hip and knee in the run of a calibration. */
#include "chain_command.h"

#include "calibrate.h"
#include "calibration_file.h"
#include "chain_options.h"
#include "chain_output.h"
#include "orientations.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    jcal_chain_t chain;
    bool is_oriented;
    const char *orientation_words;
    orientations_t orientations; /* in use if is_oriented */
    oriented_row_t row;
    jcal_chain_result_t result;
    uint32_t samples; /* rows */
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} chain_run_t;

static recording_event_t open_recording(void *self, recording_t *recording)
{
    chain_run_t *run = self;
    recording_event_t event = recording_want_third(recording);
    if (event == RECORDING_ROW && run->is_oriented) {
        event = orientations_open(&run->orientations, recording);
        run->orientation_words = orientations_words(&run->orientations);
    }
    return event;
}

static recording_event_t next_row(void *self, recording_t *recording, recording_row_t *row)
{
    chain_run_t *run = self;
    if (!run->is_oriented) {
        return recording_next(recording, row);
    }
    const recording_event_t event = orientations_next(&run->orientations, &run->row);
    *row = run->row.row;
    return event;
}

/* Hands a sample to the chain; counts the cause if it is rejected. */
static bool push_triple(chain_run_t *run, const jcal_triple_t *triple, const jcal_triple_attitudes_t *attitudes)
{
    uint32_t before[JCAL_REJECT_COUNT];
    memcpy(before, run->chain.rejected_by, sizeof before);
    if (jcal_chain_push(&run->chain, triple, attitudes) < JCAL_OK || jcal_chain_step(&run->chain) < JCAL_OK) {
        return false;
    }
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        run->rejected_by[k] += run->chain.rejected_by[k] - before[k];
    }
    return true;
}

static bool push_row(void *self, const recording_row_t *row, uint64_t t_us)
{
    chain_run_t *run = self;
    jcal_triple_t triple = {t_us, row->imu1, row->imu2, row->imu3};
    run->samples++;
    if (!row->has_time) {
        /* The library's time has no NaN; the sample has. */
        triple.imu2.gyr_rad_s.x = NAN;
    }
    if (!run->is_oriented) {
        return push_triple(run, &triple, NULL);
    }
    if (run->row.restarted) {
        /* The heading offsets are others now. */
        (void)jcal_chain_reset(&run->chain);
    }
    if (run->row.reject != JCAL_REJECT_NONE) {
        run->rejected_by[run->row.reject]++;
        return true;
    }
    const jcal_triple_attitudes_t attitudes = {row->q1, row->q2, row->q3};
    return push_triple(run, &triple, &attitudes);
}

/* Readings that are wrong as a whole do not reach the chain if they have no orientations. */
static void add_complaint(const chain_run_t *run, finding_t *finding)
{
    const jcal_reason_t complaint = run->is_oriented ? orientations_complaint(&run->orientations) : JCAL_REASON_NONE;
    if (complaint != JCAL_REASON_NONE) {
        finding->status = (finding->status == JCAL_READY) ? JCAL_COLLECTING : finding->status;
        finding->reason = complaint;
        finding->hint = JCAL_HINT_CHECK_SENSORS;
    }
}

static finding_t get_finding(void *self)
{
    chain_run_t *run = self;
    (void)jcal_chain_get(&run->chain, &run->result); /* the only error is a null pointer */
    finding_t finding = chain_finding(&run->result);
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
    const chain_run_t *run = self;
    chain_write_json(file, event, report, &run->result);
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const chain_run_t *run = self;
    chain_print_summary(file, report, &run->result, run->orientation_words);
}

static void close_recording(void *self)
{
    chain_run_t *run = self;
    if (run->is_oriented) {
        orientations_close(&run->orientations);
    }
}

static const calibrate_joint_t CHAIN = {open_recording, next_row,      push_row,        get_finding,
                                        write_json,     print_summary, close_recording, &CHAIN_WORDS};

/* Takes the axes of the knee into the config. False after a message. */
static bool set_axes(chain_options_t *options)
{
    calibration_t calibration;
    if (options->calibration == NULL) {
        return true;
    }
    if (!calibration_load(options->calibration, true, &calibration)) {
        return false;
    }
    options->config.knee_axis2 = calibration.axis1;
    options->config.knee_axis3 = calibration.axis2;
    return true;
}

int chain_command(int argc, char **argv)
{
    chain_options_t options = chain_options(argc, argv);
    if (!set_axes(&options)) {
        return EXIT_INPUT;
    }
    chain_run_t *run = calloc(1, sizeof *run);
    exit_status_t status = EXIT_TROUBLE;
    if (run == NULL || jcal_chain_init(&run->chain, &options.config) != JCAL_OK) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    } else {
        run->is_oriented = options.config.center.method == JCAL_CENTER_LS;
        status = calibrate(&options.common, &CHAIN, run, options.config.center.max_bound_m);
    }
    free(run);
    return (int)status;
}

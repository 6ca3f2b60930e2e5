/* SPDX-License-Identifier: MIT */
/* `jointcal two-dof`: orientations and their engine in the run of a calibration. */
#include "two_dof_command.h"

#include "calibrate.h"
#include "orientations.h"
#include "two_dof_engine.h"
#include "two_dof_options.h"
#include "two_dof_output.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    orientations_t orientations;
    oriented_row_t row;
    two_dof_engine_t engine;
    jcal_two_dof_result_t result;
    uint32_t samples; /* rows */
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} two_dof_run_t;

static recording_event_t open_recording(void *self, recording_t *recording)
{
    two_dof_run_t *run = self;
    return orientations_open(&run->orientations, recording);
}

static recording_event_t next_row(void *self, recording_t *recording, recording_row_t *row)
{
    two_dof_run_t *run = self;
    (void)recording; /* the orientations have it */
    const recording_event_t event = orientations_next(&run->orientations, &run->row);
    *row = run->row.row;
    return event;
}

/* Hands the orientations to the engine; counts the cause if it rejects them. */
static bool push_orientations(two_dof_run_t *run, uint64_t t_us)
{
    const jcal_orientation_pair_t pair = {t_us, run->row.row.q1, run->row.row.q2};
    jcal_two_dof_result_t before;
    two_dof_engine_get(&run->engine, &before);
    if (!two_dof_engine_update(&run->engine, &pair)) {
        return false;
    }
    two_dof_engine_get(&run->engine, &run->result);
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        run->rejected_by[k] += run->result.head.rejected_by[k] - before.head.rejected_by[k];
    }
    return true;
}

static bool push_row(void *self, const recording_row_t *row, uint64_t t_us)
{
    two_dof_run_t *run = self;
    (void)row; /* the run has it, with more */
    run->samples++;
    if (run->row.restarted) {
        /* What was learnt refers to headings that are gone. */
        two_dof_engine_reset(&run->engine);
    }
    if (run->row.reject != JCAL_REJECT_NONE) {
        run->rejected_by[run->row.reject]++;
        return true;
    }
    return push_orientations(run, t_us);
}

/* Readings that are wrong as a whole give the engine no orientations, so it cannot know. */
static void add_complaint(const two_dof_run_t *run, finding_t *finding)
{
    const jcal_reason_t complaint = orientations_complaint(&run->orientations);
    if (complaint != JCAL_REASON_NONE) {
        finding->status = (finding->status == JCAL_READY) ? JCAL_COLLECTING : finding->status;
        finding->reason = complaint;
        finding->hint = JCAL_HINT_CHECK_SENSORS;
    }
}

static finding_t get_finding(void *self)
{
    two_dof_run_t *run = self;
    two_dof_engine_get(&run->engine, &run->result);
    finding_t finding = two_dof_finding(&run->result);
    finding.samples = run->samples;
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        finding.rejected_by[k] = run->rejected_by[k];
        finding.rejected += run->rejected_by[k];
    }
    add_complaint(run, &finding);
    return finding;
}

static void write_json(const void *self, FILE *file, const char *event, const report_t *report)
{
    const two_dof_run_t *run = self;
    two_dof_write_json(file, event, report, &run->result);
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const two_dof_run_t *run = self;
    two_dof_print_summary(file, report, &run->result, orientations_words(&run->orientations));
}

static void close_recording(void *self)
{
    two_dof_run_t *run = self;
    orientations_close(&run->orientations);
}

static const calibrate_joint_t TWO_DOF = {open_recording, next_row,      push_row,        get_finding,
                                          write_json,     print_summary, close_recording, &TWO_DOF_WORDS};

int two_dof_command(int argc, char **argv)
{
    const two_dof_options_t options = two_dof_options(argc, argv);
    two_dof_run_t *run = calloc(1, sizeof *run);
    exit_status_t status = EXIT_TROUBLE;
    if (run == NULL || !two_dof_engine_start(&run->engine, &options.engine)) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    } else {
        status = calibrate(&options.common, &TWO_DOF, run, options.engine.config.two_dof.max_bound_rad);
    }
    if (run != NULL) {
        two_dof_engine_stop(&run->engine);
    }
    free(run);
    return (int)status;
}

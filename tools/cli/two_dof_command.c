/* SPDX-License-Identifier: MIT */
/* `jointcal two-dof`: rows in, events out. */
#include "two_dof_command.h"

#include "input.h"
#include "message.h"
#include "orientations.h"
#include "progress.h"
#include "recording.h"
#include "run.h"
#include "two_dof_options.h"
#include "two_dof_report.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    two_dof_options_t options;
    input_t input;
    recording_t recording;
    orientations_t *orientations;
    jcal_two_dof_t engine;
    progress_t progress;
    two_dof_report_t report;
    int64_t next_us; /* when the next estimate is due, as in the file */
    bool has_next;
} session_t;

static exit_status_t emit(session_t *session, const char *event)
{
    progress_clear(&session->progress);
    if (session->options.json) {
        two_dof_write_json(stdout, event, &session->report);
    } else if (strcmp(event, "end") == 0) {
        two_dof_print_summary(stdout, &session->report);
    } else if (session->options.every_us > 0) {
        two_dof_print_event(stdout, event, &session->report);
    }
    return run_flush();
}

/* Counts a row once, by the first cause that refused it. */
static void count(two_dof_report_t *report, jcal_reject_t reject)
{
    report->samples++;
    if (reject != JCAL_REJECT_NONE) {
        report->rejected++;
        report->rejected_by[reject]++;
    }
}

/* The cause that the engine's gate has counted since. */
static jcal_reject_t counted_since(const uint32_t *before, const uint32_t *now)
{
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        if (now[k] != before[k]) {
            return (jcal_reject_t)k;
        }
    }
    return JCAL_REJECT_NONE;
}

/* False if the library refuses the call itself. */
static bool push(session_t *session, const oriented_row_t *row)
{
    jcal_two_dof_result_t *result = &session->report.result;
    const jcal_two_dof_result_t before = *result;
    jcal_reject_t reject = row->reject;
    /* The engine must hear of a gap; of other rows that are refused there is nothing that it could use. */
    if (reject == JCAL_REJECT_NONE || reject == JCAL_REJECT_GAP) {
        if (jcal_two_dof_update(&session->engine, &row->pair) < 0 ||
            jcal_two_dof_get(&session->engine, result) != JCAL_OK) {
            return false;
        }
        if (reject == JCAL_REJECT_NONE) {
            reject = counted_since(before.rejected_by, result->rejected_by);
        }
    }
    count(&session->report, reject);
    session->report.timeline = row->timeline;
    return true;
}

/* True once per period of --every. */
static bool estimate_due(session_t *session)
{
    const int64_t every_us = session->options.every_us;
    const timeline_t *timeline = &session->report.timeline;
    if (every_us == 0 || !timeline->has_time) {
        return false;
    }
    if (!session->has_next) {
        session->has_next = true;
        session->next_us = timeline->start_us + every_us;
    }
    if (timeline->latest_us < session->next_us) {
        return false;
    }
    session->next_us += every_us * (1 + (timeline->latest_us - session->next_us) / every_us);
    return true;
}

/* Reports what the last row changed. */
static exit_status_t report_changes(session_t *session, jcal_calibration_t before)
{
    two_dof_report_t *report = &session->report;
    const jcal_calibration_t now = report->result.status;
    if (now != before && (now == JCAL_READY || now == JCAL_MOVED)) {
        if (now == JCAL_READY && !report->was_ready) {
            report->was_ready = true;
            report->ready_us = report->timeline.latest_us;
        }
        if (emit(session, jcal_calibration_string(now)) != EXIT_READY) {
            return EXIT_TROUBLE;
        }
    }
    return estimate_due(session) ? emit(session, "estimate") : EXIT_READY;
}

static exit_status_t run_rows(session_t *session)
{
    oriented_row_t row;
    recording_event_t event = orientations_next(session->orientations, &row);
    for (; event == RECORDING_ROW; event = orientations_next(session->orientations, &row)) {
        const jcal_calibration_t before = session->report.result.status;
        if (!push(session, &row)) {
            complain("jointcal", 0, 0, "the library refused a sample; please report this");
            return EXIT_TROUBLE;
        }
        const exit_status_t status = report_changes(session, before);
        if (status != EXIT_READY) {
            return status;
        }
        progress_show(&session->progress, session->recording.csv.bytes);
    }
    if (event != RECORDING_END) {
        progress_clear(&session->progress);
        return run_give_up(&session->input, &session->recording, event);
    }
    const exit_status_t status = emit(session, "end");
    if (status != EXIT_READY) {
        return status;
    }
    return (session->report.result.status == JCAL_READY) ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t run_recording(session_t *session)
{
    if (jcal_two_dof_init(&session->engine, &session->options.config) != JCAL_OK ||
        jcal_two_dof_get(&session->engine, &session->report.result) != JCAL_OK) {
        complain("jointcal", 0, 0, "the library refused its settings; please report this");
        return EXIT_TROUBLE;
    }
    session->report.max_bound_rad = session->options.config.max_bound_rad;
    const recording_event_t event = recording_open(&session->recording, input_read, &session->input);
    exit_status_t status = EXIT_INPUT;
    if (event != RECORDING_ROW) {
        status = run_give_up(&session->input, &session->recording, event);
    } else if (!orientations_possible(&session->input, &session->recording)) {
        /* it has said why */
    } else if ((session->orientations = orientations_open(&session->recording)) == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        status = EXIT_TROUBLE;
    } else {
        session->report.from_columns = orientations_from_columns(session->orientations);
        progress_start(&session->progress, session->input.size);
        status = run_rows(session);
        orientations_close(session->orientations);
    }
    recording_close(&session->recording);
    return status;
}

int two_dof_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    session->options = two_dof_options(argc, argv);
    exit_status_t status = EXIT_INPUT;
    if (input_open(&session->input, session->options.recording) != 0) {
        complain(session->options.recording, 0, 0, "%s", strerror(session->input.error));
    } else {
        status = run_recording(session);
        input_close(&session->input);
    }
    free(session);
    return (int)status;
}

/* SPDX-License-Identifier: MIT */
/* `jointcal hinge`: rows in, events out. */
#include "hinge_command.h"

#include "engine.h"
#include "hinge_json.h"
#include "hinge_options.h"
#include "hinge_summary.h"
#include "input.h"
#include "message.h"
#include "number.h"
#include "progress.h"
#include "recording.h"
#include "run.h"
#include "timeline.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    hinge_options_t options;
    input_t input;
    recording_t recording;
    engine_t engine;
    progress_t progress;
    hinge_report_t report;
    timeline_t timeline;
    int64_t next_us; /* when the next estimate is due, as in the file */
} session_t;

static exit_status_t emit(session_t *session, const char *event)
{
    progress_clear(&session->progress);
    if (session->options.json) {
        hinge_write_json(stdout, event, &session->report);
    } else if (strcmp(event, "end") == 0) {
        hinge_print_summary(stdout, &session->report);
    } else if (session->options.every_us > 0) {
        hinge_print_event(stdout, event, &session->report);
    }
    return run_flush();
}

/* Takes note of a row's time; gives the row its time for the library. */
static uint64_t advance_time(session_t *session, const recording_row_t *row)
{
    hinge_report_t *report = &session->report;
    timeline_t *timeline = &session->timeline;
    const bool first = !timeline->has_time;
    const uint64_t now_us = timeline_advance(timeline, row);
    report->has_time = timeline->has_time;
    report->start_us = timeline->start_us;
    report->t_us = timeline->latest_us;
    if (first) {
        session->next_us = timeline->start_us + session->options.every_us;
    }
    return now_us;
}

static bool push(session_t *session, const recording_row_t *row)
{
    jcal_pair_t pair = {advance_time(session, row), row->imu1, row->imu2};
    if (!row->has_time) {
        /* The library's time has no NaN; the sample has. */
        pair.imu1.gyr_rad_s.x = NAN;
    }
    return engine_update(&session->engine, &pair);
}

/* True once per period of --every. */
static bool estimate_due(session_t *session)
{
    const int64_t every_us = session->options.every_us;
    const hinge_report_t *report = &session->report;
    if (every_us == 0 || !report->has_time || report->t_us < session->next_us) {
        return false;
    }
    session->next_us += every_us * (1 + (report->t_us - session->next_us) / every_us);
    return true;
}

/* Reports what the last row changed. */
static exit_status_t report_changes(session_t *session)
{
    hinge_report_t *report = &session->report;
    const jcal_calibration_t before = report->result.status;
    engine_get(&session->engine, &report->result);
    const jcal_calibration_t now = report->result.status;
    if (now != before && (now == JCAL_READY || now == JCAL_MOVED)) {
        if (now == JCAL_READY && !report->was_ready) {
            report->was_ready = true;
            report->ready_us = report->t_us;
        }
        if (emit(session, jcal_calibration_string(now)) != EXIT_READY) {
            return EXIT_TROUBLE;
        }
    }
    return estimate_due(session) ? emit(session, "estimate") : EXIT_READY;
}

static exit_status_t run_rows(session_t *session)
{
    recording_row_t row;
    recording_event_t event = recording_next(&session->recording, &row);
    for (; event == RECORDING_ROW; event = recording_next(&session->recording, &row)) {
        if (!push(session, &row)) {
            complain("jointcal", 0, 0, "the library refused a sample; please report this");
            return EXIT_TROUBLE;
        }
        const exit_status_t status = report_changes(session);
        if (status != EXIT_READY) {
            return status;
        }
        progress_show(&session->progress, session->recording.csv.bytes);
    }
    if (event != RECORDING_END) {
        progress_clear(&session->progress);
        return run_give_up(&session->input, &session->recording, event);
    }
    engine_get(&session->engine, &session->report.result);
    const exit_status_t status = emit(session, "end");
    if (status != EXIT_READY) {
        return status;
    }
    return (session->report.result.status == JCAL_READY) ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t run_recording(session_t *session)
{
    if (!engine_start(&session->engine, &session->options.engine)) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        engine_stop(&session->engine);
        return EXIT_TROUBLE;
    }
    const recording_event_t event = recording_open(&session->recording, input_read, &session->input);
    progress_start(&session->progress, session->input.size);
    engine_get(&session->engine, &session->report.result);
    session->report.max_bound_rad = session->options.engine.config.hinge.max_bound_rad;
    const exit_status_t status =
        (event == RECORDING_ROW) ? run_rows(session) : run_give_up(&session->input, &session->recording, event);
    recording_close(&session->recording);
    engine_stop(&session->engine);
    return status;
}

int hinge_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    session->options = hinge_options(argc, argv);
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

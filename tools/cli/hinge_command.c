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

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The library's time of the first row that has one. Rows before it in time must still get a smaller one. */
#define ORIGIN_US ((uint64_t)1 << 62)

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    hinge_options_t options;
    input_t input;
    recording_t recording;
    engine_t engine;
    progress_t progress;
    hinge_report_t report;
    uint64_t pushed_us; /* time of the row before, in the library's time */
    int64_t next_us;    /* when the next estimate is due, as in the file */
} session_t;

/* Each event is flushed, so that readers of a pipe get it at once. */
static exit_status_t flush(void)
{
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        complain("standard output", 0, 0, "%s", strerror(errno));
        return EXIT_TROUBLE;
    }
    return EXIT_READY;
}

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
    return flush();
}

/* Takes note of a row's time; gives the row its time for the library. */
static uint64_t advance_time(session_t *session, const recording_row_t *row)
{
    hinge_report_t *report = &session->report;
    if (!row->has_time) {
        return session->pushed_us;
    }
    if (!report->has_time) {
        report->has_time = true;
        report->start_us = row->t_us;
        report->t_us = row->t_us;
        session->next_us = row->t_us + session->options.every_us;
    }
    if (row->t_us > report->t_us) {
        report->t_us = row->t_us;
    }
    session->pushed_us = ORIGIN_US + (uint64_t)row->t_us - (uint64_t)report->start_us;
    return session->pushed_us;
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

/* Says why the recording could not be read on. */
static exit_status_t give_up(session_t *session, recording_event_t event)
{
    const recording_fault_t *fault = &session->recording.fault;
    progress_clear(&session->progress);
    if (event == RECORDING_BAD) {
        complain(session->input.name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(session->input.name, 0, 0, "%s", strerror((session->input.error != 0) ? session->input.error : ENOMEM));
    return EXIT_TROUBLE;
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
        return give_up(session, event);
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
    const exit_status_t status = (event == RECORDING_ROW) ? run_rows(session) : give_up(session, event);
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

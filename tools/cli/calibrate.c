/* SPDX-License-Identifier: MIT */
/* The run of a calibration: rows in, events out. */
#include "calibrate.h"

#include "input.h"
#include "progress.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    calibrate_options_t options;
    const calibrate_joint_t *joint;
    void *self; /* the joint's */
    input_t input;
    recording_t recording;
    progress_t progress;
    report_t report;
    int64_t next_us; /* when the next estimate is due, as in the file */
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
        session->joint->write_json(session->self, stdout, event, &session->report);
    } else if (strcmp(event, "end") == 0) {
        session->joint->print_summary(session->self, stdout, &session->report);
    } else if (session->options.every_us > 0) {
        report_print_event(stdout, event, &session->report);
    }
    return flush();
}

static bool push(session_t *session, const recording_row_t *row)
{
    row_clock_t *clock = &session->report.clock;
    const bool had_time = clock->has_time;
    const uint64_t t_us = row_clock_advance(clock, row);
    if (clock->has_time && !had_time) {
        session->next_us = clock->start_us + session->options.every_us;
    }
    return session->joint->push(session->self, row, t_us);
}

/* True once per period of --every. */
static bool estimate_due(session_t *session)
{
    const int64_t every_us = session->options.every_us;
    const row_clock_t *clock = &session->report.clock;
    if (every_us == 0 || !clock->has_time || clock->t_us < session->next_us) {
        return false;
    }
    session->next_us += every_us * (1 + (clock->t_us - session->next_us) / every_us);
    return true;
}

/* Reports what the last row changed. */
static exit_status_t report_changes(session_t *session)
{
    report_t *report = &session->report;
    const jcal_calibration_t before = report->finding.status;
    report->finding = session->joint->get(session->self);
    const jcal_calibration_t now = report->finding.status;
    if (now != before && (now == JCAL_READY || now == JCAL_MOVED)) {
        if (now == JCAL_READY && !report->was_ready) {
            report->was_ready = true;
            report->ready_us = report->clock.t_us;
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
    recording_event_t event = session->joint->next(session->self, &session->recording, &row);
    for (; event == RECORDING_ROW; event = session->joint->next(session->self, &session->recording, &row)) {
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
    session->report.finding = session->joint->get(session->self);
    const exit_status_t status = emit(session, "end");
    if (status != EXIT_READY) {
        return status;
    }
    return (session->report.finding.status == JCAL_READY) ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t run_recording(session_t *session)
{
    recording_event_t event = recording_open(&session->recording, input_read, &session->input);
    if (event == RECORDING_ROW) {
        event = session->joint->open(session->self, &session->recording);
    }
    progress_start(&session->progress, session->input.size);
    session->report.finding = session->joint->get(session->self);
    const exit_status_t status = (event == RECORDING_ROW) ? run_rows(session) : give_up(session, event);
    session->joint->close(session->self);
    recording_close(&session->recording);
    return status;
}

exit_status_t calibrate(const calibrate_options_t *options, const calibrate_joint_t *joint, void *self, float max_bound)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    session->options = *options;
    session->joint = joint;
    session->self = self;
    session->report.words = joint->words;
    session->report.max_bound = max_bound;
    exit_status_t status = EXIT_INPUT;
    if (input_open(&session->input, options->recording) != 0) {
        complain(options->recording, 0, 0, "%s", strerror(session->input.error));
    } else {
        status = run_recording(session);
        input_close(&session->input);
    }
    free(session);
    return status;
}

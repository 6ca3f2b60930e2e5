/* SPDX-License-Identifier: MIT */
/* The run of a calibration: rows in, events out. */
#include "run/calibrate.h"

#include "input/orientations.h"
#include "run/lag_watch.h"
#include "run/reading.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* How often the findings of the recording are looked up while ready: they change slowly and cost as much as some tens of rows. */
#define LOOK_EVERY_ROWS 100u

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    common_options_t options;
    const calibrate_joint_t *joint;
    bool sign_is_chosen;     /* by --axis1-toward */
    calibrate_state_t *self; /* the joint's */
    reading_t reading;
    orientations_t orientations;      /* in use if rows come with them */
    uint32_t seen[JCAL_REJECT_COUNT]; /* what the joint's counters were */
    uint32_t samples;                 /* rows */
    uint32_t looked_at;               /* rows when the recording was last looked at as a whole */
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    report_t report;
    lag_watch_t lag;
    int64_t next_us; /* when the next estimate is due, as in the file */
} session_t;

/* Each event is flushed, so that readers of a pipe get it at once. */
static exit_status_t flush(void)
{
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        return complain_output("standard output");
    }
    return EXIT_READY;
}

/* Asks what there is to say of the recording as a whole. */
static void look_at_recording(session_t *session)
{
    reading_findings(&session->reading, session->report.head.reason, &session->report.findings);
    session->self->lag = reading_lag(&session->reading, &session->lag, &session->report.findings);
    if (session->joint->axes != NULL && !session->sign_is_chosen && session->report.head.status == JCAL_READY) {
        const report_axes_t axes = session->joint->axes(session->self);
        report_advise_sign(&axes, &session->report.findings);
    }
    session->looked_at = session->samples;
    report_apply_findings(&session->report);
}

static exit_status_t emit(session_t *session, const char *event)
{
    look_at_recording(session);
    progress_clear(&session->reading.progress);
    if (session->options.json) {
        json_t json = report_json_begin(stdout, event, &session->report);
        session->joint->write_json(session->self, &json);
        report_json_end(&json, &session->report);
    } else if (strcmp(event, "end") == 0) {
        session->joint->print_summary(session->self, stdout, &session->report);
    } else if (session->options.every_us > 0) {
        report_print_event(stdout, event, &session->report);
    }
    return flush();
}

/* Ready is told only if the recording as a whole allows it: asked when ready would be entered, and now and then while it stays. */
static void check_ready(session_t *session, bool was_ready)
{
    if (session->report.head.status != JCAL_READY) {
        return;
    }
    if (!was_ready || session->samples - session->looked_at >= LOOK_EVERY_ROWS) {
        look_at_recording(session);
    } else {
        report_apply_findings(&session->report);
    }
}

static report_bounds_t bounds(const session_t *session)
{
    if (session->joint->bounds != NULL) {
        return session->joint->bounds(session->self);
    }
    const report_axes_t axes = session->joint->axes(session->self);
    return (report_bounds_t){axes.known, axes.bound1, axes.bound2};
}

/* Takes over what the joint says now. Its counters are of what it was given and since when it was reset; a report counts rows. */
static void look(session_t *session)
{
    report_t *report = &session->report;
    const bool was_ready = report->head.status == JCAL_READY;
    report->head = *session->joint->get(session->self);
    report->bounds = bounds(session);
    report->head.samples = session->samples;
    report->head.rejected = 0;
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        const uint32_t counted = report->head.rejected_by[k];
        session->rejected_by[k] += counted - session->seen[k];
        session->seen[k] = counted;
        report->head.rejected_by[k] = session->rejected_by[k];
        report->head.rejected += session->rejected_by[k];
    }
    /* Readings that are wrong as a whole give the joint no orientations, so it cannot know. */
    const jcal_reason_t complaint =
        session->self->oriented ? orientations_complaint(&session->orientations) : JCAL_REASON_NONE;
    if (complaint != JCAL_REASON_NONE) {
        report->head.status = (report->head.status == JCAL_READY) ? JCAL_COLLECTING : report->head.status;
        report->head.reason = complaint;
        report->head.hint = JCAL_HINT_CHECK_SENSORS;
    }
    check_ready(session, was_ready);
}

/* The next row, with its orientations if the joint needs them. */
static recording_event_t next_row(session_t *session, oriented_row_t *row)
{
    if (session->self->oriented) {
        return orientations_next(&session->orientations, row);
    }
    row->reject = JCAL_REJECT_NONE;
    row->restarted = false;
    return recording_next(&session->reading.recording, &row->row);
}

static bool push(session_t *session, oriented_row_t *oriented)
{
    recording_row_t *row = &oriented->row;
    row_clock_t *clock = &session->report.clock;
    const bool had_time = clock->has_time;
    const uint64_t t_us = row_clock_advance(clock, row);
    if (clock->has_time && !had_time) {
        session->next_us = clock->start_us + session->options.every_us;
    }
    session->samples++;
    if (session->reading.two == NULL) {
        lag_watch_row(&session->lag, row, clock->start_us);
    }
    if (oriented->restarted) {
        session->joint->reset(session->self);
        memset(session->seen, 0, sizeof session->seen);
    }
    if (oriented->reject != JCAL_REJECT_NONE) {
        if (session->orientations.source != ORIENTATIONS_FROM_COLUMNS) {
            session->rejected_by[oriented->reject]++;
            return true;
        }
        row->q1.w = NAN; /* so that the library sees how many of the orientations that it needs are missing */
    }
    if (!row->has_time) {
        /* The library's time has no NaN; the sample has. */
        row->imu1.gyr_rad_s.x = NAN;
        row->imu2.gyr_rad_s.x = NAN;
        row->imu3.gyr_rad_s.x = NAN;
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
    const jcal_calibration_t before = report->head.status;
    look(session);
    const jcal_calibration_t now = report->head.status;
    if (now != before && (now == JCAL_READY || now == JCAL_MOVED)) {
        if (now == JCAL_READY && !report->was_ready) {
            report->was_ready = true;
            report->ready_us = report->clock.t_us;
        }
        report->has_moved = now == JCAL_MOVED;
        report->moved_us = report->clock.t_us;
        if (emit(session, jcal_calibration_string(now)) != EXIT_READY) {
            return EXIT_TROUBLE;
        }
    }
    return estimate_due(session) ? emit(session, "estimate") : EXIT_READY;
}

static exit_status_t refused(void)
{
    complain("jointcal", 0, 0, "the library refused a sample; please report this");
    return EXIT_TROUBLE;
}

static exit_status_t run_rows(session_t *session)
{
    oriented_row_t row;
    recording_event_t event = next_row(session, &row);
    for (; event == RECORDING_ROW; event = next_row(session, &row)) {
        if (!push(session, &row)) {
            return refused();
        }
        const exit_status_t status = report_changes(session);
        if (status != EXIT_READY) {
            return status;
        }
        reading_advance(&session->reading);
    }
    if (event != RECORDING_END) {
        return reading_give_up(&session->reading, event);
    }
    look(session);
    const exit_status_t status = emit(session, "end");
    if (status != EXIT_READY) {
        return status;
    }
    return (session->report.head.status == JCAL_READY) ? EXIT_READY : EXIT_NOT_READY;
}

/* Asks the recording for what the joint needs of it. */
static recording_event_t prepare(session_t *session)
{
    recording_t *recording = &session->reading.recording;
    const recording_event_t event = session->joint->third ? recording_want_third(recording) : RECORDING_ROW;
    if (event != RECORDING_ROW || !session->self->oriented) {
        return event;
    }
    const recording_event_t opened = orientations_open(&session->orientations, recording, false);
    session->report.orientations = orientations_words(&session->orientations);
    recording->check.times_only =
        session->orientations.source == ORIENTATIONS_FROM_COLUMNS && !session->joint->uses_readings;
    return opened;
}

static exit_status_t run_recording(session_t *session)
{
    const recording_event_t event = prepare(session);
    reading_begin(&session->reading);
    look(session);
    const exit_status_t status =
        (event == RECORDING_ROW) ? run_rows(session) : reading_give_up(&session->reading, event);
    orientations_close(&session->orientations);
    return status;
}

static void print_files(const void *two, FILE *file)
{
    two_files_print(two, file);
}

static exit_status_t run(session_t *session, const common_options_t *options, const calibrate_joint_t *joint)
{
    const jcal_vec3_t toward = options->axis1_toward;
    session->options = *options;
    session->joint = joint;
    session->sign_is_chosen = toward.x != 0.0f || toward.y != 0.0f || toward.z != 0.0f;
    session->report.words = joint->words;
    session->report.max_bound = options->max_bound;
    exit_status_t status = reading_open_given(&session->reading, options, false);
    if (status == EXIT_READY && !lag_watch_begin(&session->lag)) {
        status = refused();
    }
    if (status == EXIT_READY) {
        session->report.print_more = (session->reading.two != NULL) ? print_files : NULL;
        session->report.more = session->reading.two;
        status = run_recording(session);
    }
    reading_close(&session->reading);
    return status;
}

exit_status_t calibrate(const common_options_t *options, const calibrate_joint_t *joint, const void *own)
{
    calibrate_state_t *self = calloc(1, joint->size);
    session_t *session = calloc(1, sizeof *session);
    exit_status_t status = EXIT_TROUBLE;
    if (self != NULL) {
        self->engine = options->engine;
    }
    if (self == NULL || session == NULL || !joint->start(self, own)) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    } else {
        session->self = self;
        status = run(session, options, joint);
    }
    if (self != NULL) {
        free(self->storage);
    }
    free(session);
    free(self);
    return status;
}

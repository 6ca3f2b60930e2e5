/* SPDX-License-Identifier: MIT */
/* `jointcal stream`: its options, rows to a hub, the hub's estimates out. */
#include "commands/commands.h"
#include "commands/hinge.h"
#include "commands/stream_body.h"
#include "options/common.h"
#include "options/values.h"
#include "output/report.h"
#include "run/hub_session.h"
#include "run/lag_watch.h"
#include "run/reading.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* The hub's time of the first row that has one, as in `jointcal hinge`. */
#define ORIGIN_US ((uint64_t)1 << 62)

/* Rows that can be under way to the hub; more than any credit. */
#define ROWS_UNDER_WAY 256u

/* ---- Options ---- */

enum { KEY_TO = OPTION_OWN, KEY_BAUD, KEY_SPEED, KEY_TIMEOUT, KEY_COUNTERS };

static const struct argp_option OPTIONS[] = {
    {"to", KEY_TO, "HUB", 0, "Where the hub is: unix:PATH, tcp:HOST:PORT, or a serial device like /dev/ttyACM0", 0},
    {"baud", KEY_BAUD, "RATE", 0, "Rate of a serial device, 9600 to 230400 (default 115200)", 0},
    {"speed", KEY_SPEED, "X", 0,
     "How fast: 1 (default) is real time, 10 ten times that, max as fast as the hub can take it", 0},
    {"timeout", KEY_TIMEOUT, "S", 0, "Give up when the hub has been silent for S seconds (default 5)", 0},
    {"counters", KEY_COUNTERS, NULL, 0,
     "At the end, tell on standard error what became of the frames, even if none was lost or damaged", 0},
    STREAM_BODY_OPTIONS,
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    stream_options_t *options = self;
    switch (key) {
    case KEY_TO:
        options->hub.target = argument;
        if (!hub_link_target_ok(argument)) {
            argp_error(state, "--to: '%s' is none of unix:PATH, tcp:HOST:PORT, /dev/NAME", argument);
        }
        return 0;
    case KEY_BAUD:
        options->hub.baud = (unsigned long)option_positive(state, "baud", argument);
        return 0;
    case KEY_SPEED:
        options->speed = (strcmp(argument, "max") == 0) ? 0.0f : option_positive(state, "speed", argument);
        return 0;
    case KEY_TIMEOUT:
        options->hub.timeout_us = option_duration(state, "timeout", argument);
        return 0;
    case KEY_COUNTERS:
        options->counters = true;
        return 0;
    default:
        return stream_body_parse(key, argument, state, &options->body);
    }
}

static void take_file(struct argp_state *state, const char *name, void *self)
{
    stream_options_t *options = self;
    if (options->body.file_count == BODY_FILES_MAX) {
        argp_error(state, "%d files at the most, one of each sensor", BODY_FILES_MAX);
    }
    options->body.files[options->body.file_count] = name;
    options->body.file_count++;
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    const stream_options_t *options = self;
    if (options->hub.target == NULL) {
        argp_error(state, "where is the hub? Give --to unix:PATH, --to tcp:HOST:PORT or --to /dev/NAME");
    }
    stream_body_settle(state, common, &options->body);
    if (options->body.joint_count > 0) {
        return; /* every kind of joint has a bound of its own: the library's, unless one is given */
    }
    jcal_hinge_config_t config = jcal_hinge_config_default();
    config.max_bound_rad = (common->max_bound > 0.0f) ? common->max_bound : config.max_bound_rad;
    common->max_bound = config.max_bound_rad;
    const common_limit_t limits[] = {
        {"max_bound_rad", "max-bound", common->max_bound / RAD_PER_DEG, "a number of degrees from 0.06 to 28"}};
    common_check(state, jcal_hinge_config_check(&config), limits, 1);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv --to HUB\nFILE.csv... --to HUB --joint NAME:KIND:PROXIMAL:DISTAL...",
    .doc =
        "Plays a recording to a hub and writes what the hub finds as JSON Lines.\v"
        "Without --joint: one hinge. The recording and the lines are those of 'jointcal hinge --json'; as long as no frame is lost, so is "
        "every byte of the output.\n"
        "\n"
        "With --joint: a whole body, as wireless sensors would send it. There is a file for each sensor, in the columns t_s, gyr_x, gyr_y, "
        "gyr_z, acc_x, acc_y, acc_z, or one recording of two or three sensors. Each sensor sends packets, which the options below delay and lose; "
        "the same files, options and seed make the same packets. docs/PROGRAM.md has the lines that come.\n"
        "\n"
        "Exit status: 0 ready at the end, all joints of a body; 3 read to the end but not ready; 2 the command line or the recording is "
        "wrong; 1 anything else, such as a hub that does not answer.",
    .offers = {[COMMON_EVERY] = {.help = COMMON_EVERY_HELP},
               [COMMON_MAX_BOUND] =
                   {.help = "Ready when both axes are known to within DEG degrees with 95 % confidence (default 3)"},
               [COMMON_SORT] = {.help = COMMON_SORT_HELP},
               [COMMON_SIGN_HINT] = {.help = COMMON_SIGN_HELP},
               [COMMON_JSON] = {.help = "Write JSON Lines, which is what this subcommand does anyway"}},
    .bound_unit = BOUND_IN_DEG,
    .own = OPTIONS,
    .parse = parse,
    .take_file = take_file,
    .settle = settle,
};

/* ---- The command ---- */

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    common_options_t common;
    stream_options_t options;
    reading_t reading;
    hub_session_t hub;
    recording_row_t under_way[ROWS_UNDER_WAY]; /* rows that the hub has not told of yet */
    uint64_t sent;
    uint64_t answered;
    check_t check;   /* of the rows that the hub has told of, so that lines are those of `jointcal hinge` */
    lag_watch_t lag; /* of the same rows */
    bool output_failed;
    bool has_start;
    int64_t start_us; /* first time in the file */
    int64_t began_us; /* by the clock, when that row was sent */
} session_t;

/* Shows the rows that the hub has told of to the check and to the estimator of the lag. */
static void check_answered(session_t *session, uint64_t until)
{
    for (; session->answered < until && session->answered < session->sent; session->answered++) {
        const recording_row_t *row = &session->under_way[session->answered % ROWS_UNDER_WAY];
        recording_watch(&session->check, row, false);
        lag_watch_row(&session->lag, row, session->start_us);
    }
}

/* A hub_event_t. Each event is flushed, so that readers of a pipe get it at once. */
static void emit(void *context, const char *event, const message_estimate_t *estimate)
{
    session_t *session = context;
    report_t report = {.head = estimate->result.hinge.head,
                       .clock.has_time = estimate->now_us != MESSAGE_TIME_UNKNOWN,
                       .clock.t_us = (int64_t)(estimate->now_us - ORIGIN_US + (uint64_t)session->start_us)};
    check_answered(session, report.head.samples);
    check_findings(&session->check, &report.findings);
    const report_lag_t lag = lag_watch_report(&session->lag, &session->check, &report.findings);
    report_apply_findings(&report);
    if (strcmp(event, "ready") == 0 && report.head.status != JCAL_READY) {
        return; /* the hub cannot know what is wrong with the recording as a whole */
    }
    progress_clear(&session->reading.progress);
    json_t json = report_json_begin(stdout, event, &report);
    hinge_write_keys(&json, &estimate->result, &lag);
    report_json_end(&json, &report);
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        session->output_failed = true;
    }
}

static exit_status_t output_trouble(session_t *session)
{
    progress_clear(&session->reading.progress);
    return complain_output("standard output");
}

/* Until the row is due, if the recording is played at its own pace. */
static exit_status_t wait_due(session_t *session, int64_t row_us)
{
    if (session->options.speed <= 0.0f) {
        return EXIT_READY;
    }
    const double after_us = (double)(row_us - session->start_us) / (double)session->options.speed;
    const int64_t due_us = session->began_us + (int64_t)after_us;
    exit_status_t status = EXIT_READY;
    for (int64_t left_us = due_us - hub_link_clock_us(); left_us > 0 && status == EXIT_READY;
         left_us = due_us - hub_link_clock_us()) {
        status = hub_session_wait(&session->hub, left_us);
    }
    return status;
}

static exit_status_t send_row(session_t *session, const recording_row_t *row)
{
    jcal_pair_t pair = {MESSAGE_TIME_UNKNOWN, row->imu1, row->imu2};
    exit_status_t status = EXIT_READY;
    if (row->has_time) {
        if (!session->has_start) {
            session->has_start = true;
            session->start_us = row->t_us;
            session->began_us = hub_link_clock_us();
        }
        pair.t_us = ORIGIN_US + (uint64_t)row->t_us - (uint64_t)session->start_us;
        status = wait_due(session, row->t_us);
    }
    if (session->sent - session->answered == ROWS_UNDER_WAY) {
        check_answered(session, session->answered + 1);
    }
    session->under_way[session->sent % ROWS_UNDER_WAY] = *row;
    session->sent++;
    status = (status == EXIT_READY) ? hub_session_send(&session->hub, &pair) : status;
    return (status == EXIT_READY && session->output_failed) ? output_trouble(session) : status;
}

/* The end: estimate and counters of all that arrived. */
static exit_status_t finish(session_t *session)
{
    const exit_status_t status = hub_session_ask(&session->hub);
    if (status != EXIT_READY) {
        return status;
    }
    check_answered(session, session->sent);
    emit(session, "end", &session->hub.estimate);
    if (session->output_failed) {
        return output_trouble(session);
    }
    hub_session_tell_counters(&session->hub, session->options.counters);
    check_findings_t findings;
    check_findings(&session->check, &findings);
    return (session->hub.estimate.result.hinge.head.status == JCAL_READY && !findings.refuses) ? EXIT_READY
                                                                                               : EXIT_NOT_READY;
}

static exit_status_t run_rows(session_t *session)
{
    recording_t *recording = &session->reading.recording;
    recording_row_t row;
    recording_event_t event = recording_next(recording, &row);
    for (; event == RECORDING_ROW; event = recording_next(recording, &row)) {
        const exit_status_t status = send_row(session, &row);
        if (status != EXIT_READY) {
            return status;
        }
        reading_advance(&session->reading);
    }
    return (event == RECORDING_END) ? finish(session) : reading_give_up(&session->reading, event);
}

static exit_status_t run_recording(session_t *session)
{
    exit_status_t status = hub_session_open(&session->hub, &session->options.hub, &session->reading.progress);
    if (status != EXIT_READY) {
        return status;
    }
    hub_session_listen(&session->hub, emit, session);
    const message_start_t start = {.every_us = (uint64_t)session->common.every_us,
                                   .max_bound_rad = session->common.max_bound,
                                   .sign_hint = (uint8_t)session->common.sign_hint};
    status = hub_session_greet(&session->hub, start);
    if (status == EXIT_READY && !lag_watch_begin(&session->lag)) {
        complain("jointcal", 0, 0, "the library refused a call; please report this");
        status = EXIT_TROUBLE;
    }
    if (status == EXIT_READY) {
        reading_begin(&session->reading);
        status = run_rows(session);
    }
    hub_session_close(&session->hub);
    return status;
}

int stream_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    session->options = (stream_options_t){.hub = {.baud = 115200, .timeout_us = 5000000}, .speed = 1.0f};
    stream_body_defaults(&session->options.body);
    common_parse(&LINE, argc, argv, &session->common, &session->options);
    if (session->options.body.joint_count > 0) {
        const exit_status_t body = stream_body(&session->common, &session->options);
        free(session);
        return (int)body;
    }
    exit_status_t status = reading_open(&session->reading, session->common.recording, session->common.sort);
    status = (status == EXIT_READY) ? run_recording(session) : status;
    reading_close(&session->reading);
    free(session);
    return (int)status;
}

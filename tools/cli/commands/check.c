/* SPDX-License-Identifier: MIT */
/* `jointcal check`: what the sensors of a recording do, whatever the joint. */
#include "commands/commands.h"
#include "input/row_clock.h"
#include "options/common.h"
#include "output/report.h"
#include "output/report_health.h"
#include "run/lag_watch.h"
#include "run/reading.h"

#include "jointcal/jointcal.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Options ---- */

static void settle(struct argp_state *state, common_options_t *common, void *options)
{
    (void)state;
    (void)common;
    (void)options;
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv\nSENSOR1.csv SENSOR2.csv",
    .two_files = true,
    .doc =
        "Says what the sensors of a recording do, and what is wrong with it as a whole: units, gravity, frames, times.\v"
        "The recording is as for 'jointcal hinge', with or without a third sensor. Gravity is in m/s^2 if the accelerations are. It "
        "turns against a sensor as fast as the rates say if they are in rad/s, t_s is in seconds, and both stand in one right-handed "
        "frame: 1.0 times. Both are unknown where the sensor hardly turns.\n"
        "\n"
        "A lag of sensor 2 is told where the motion shows it; one of more than 20 ms is wrong, since all other commands go wrong by it.\n"
        "\n" COMMON_TWO_FILES
        "Exit status: 0 nothing is wrong as a whole; 3 something is; 2 the command line or the recording is wrong; 1 anything "
        "else." COMMON_PICTURE,
    .offers = {[COMMON_JSON] = {.help = COMMON_JSON_HELP},
               [COMMON_SORT] = {.help = COMMON_SORT_HELP},
               [COMMON_LAG] = {.help = COMMON_LAG_HELP}},
    .settle = settle,
};

/* ---- What is written ---- */

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    common_options_t common;
    reading_t reading;
    row_clock_t clock;
    jcal_gate_t gate;
    jcal_gate_config_t gate_config;
    uint32_t rows;
    uint32_t rejected;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    int sensors;
    lag_watch_t watch; /* of sensors 1 and 2 of one file */
    report_lag_t lag;
    check_findings_t findings;
    check_measures_t measures;
} session_t;

static void numbers(json_t *json, const char *key, const double *values, int count)
{
    json_key(json, key);
    for (int k = 0; k < count; k++) {
        (void)fputs((k == 0) ? "[" : ", ", json->file);
        if (values[k] > 0.0 || values[k] < 0.0) {
            (void)fprintf(json->file, "%.4g", values[k]);
        } else {
            (void)fputs("null", json->file);
        }
    }
    (void)fputc(']', json->file);
}

/* What the library says of a sensor, by its own readings. */
static jcal_health_result_t health_of(const session_t *session, int k)
{
    const two_files_t *two = session->reading.two;
    return (two != NULL) ? two_files_health(two, (unsigned)k) : check_health_of(&session->reading.recording.check, k);
}

static void write_sensors(json_t *json, const session_t *session)
{
    json_key(json, "sensors");
    for (int k = 0; k < session->sensors; k++) {
        (void)fputs((k == 0) ? "[" : ", ", json->file);
        const jcal_health_result_t result = health_of(session, k);
        json_t sensor = json_begin(json->file);
        report_health_json(&sensor, &result);
        json_end(&sensor);
    }
    (void)fputc(']', json->file);
}

static void write_json(const session_t *session)
{
    const check_measures_t *measures = &session->measures;
    json_t json = json_begin(stdout);
    json_word(&json, "event", "check");
    json_count(&json, "samples", session->rows);
    json_number(&json, "rate_hz", (measures->step_s > 0.0) ? (float)(1.0 / measures->step_s) : NAN);
    json_count(&json, "out_of_order", (uint32_t)measures->out_of_order);
    numbers(&json, "gravity_m_s2", measures->gravity_m_s2, session->sensors);
    numbers(&json, "gravity_turns", measures->gravity_turns, session->sensors);
    const report_lag_t *lag = &session->lag;
    json_time(&json, "lag_s", lag->known, lag->lag_us);
    json_number(&json, "lag_bound_s", lag->known ? lag->bound_s : NAN);
    if (lag->two_files) {
        json_number(&json, "drift_ppm", lag->known ? 1e6f * lag->drift : NAN);
    }
    write_sensors(&json, session);
    json_count(&json, "rejected", session->rejected);
    json_rejected(&json, session->rejected_by);
    json_sentences(&json, "advice", session->findings.sentences, session->findings.count);
    json_end(&json);
    (void)fputc('\n', stdout);
}

static void print(const session_t *session)
{
    const check_measures_t *measures = &session->measures;
    (void)printf("Recording: %s\n", session->findings.explains ? "something is wrong" : "nothing is wrong as a whole");
    if (measures->step_s > 0.0) {
        (void)printf("  %-18s %.4g rows a second\n", "rate", 1.0 / measures->step_s);
    }
    if (session->lag.two_files) {
        two_files_print(session->reading.two, stdout);
    } else if (session->lag.known) {
        (void)printf("  %-18s sensor 2 is late by %ld ms, to within %.0f\n", "lag",
                     lround(1e-3 * (double)session->lag.lag_us),
                     1e3 * (double)session->lag.bound_s); /* a whole number has no -0 */
    } else {
        (void)printf("  %-18s not known: lively motion of one joint tells it\n", "lag");
    }
    for (int k = 0; k < session->sensors; k++) {
        const jcal_health_result_t result = health_of(session, k);
        report_health_print(stdout, k + 1, &result);
    }
    report_print_samples(stdout, session->rows, session->rejected, session->rejected_by);
    for (size_t k = 0; k < session->findings.count; k++) {
        report_print_words(stdout, "about the data", session->findings.sentences[k]);
    }
}

/* ---- The command ---- */

static void take(session_t *session, const recording_row_t *row)
{
    jcal_pair_t pair = {row_clock_advance(&session->clock, row), row->imu1, row->imu2};
    if (!row->has_time) {
        pair.imu1.gyr_rad_s.x = NAN; /* the library's time has no NaN; the sample has */
    }
    if (session->reading.two == NULL) {
        lag_watch_row(&session->watch, row, session->clock.start_us);
    }
    const jcal_reject_t reject = jcal_gate_check(&session->gate, &session->gate_config, &pair);
    session->rows++;
    if (reject != JCAL_REJECT_NONE) {
        session->rejected++;
        session->rejected_by[reject]++;
    }
}

static exit_status_t run_rows(session_t *session)
{
    recording_t *recording = &session->reading.recording;
    session->sensors = recording_has_third(recording) ? 3 : 2;
    if (session->sensors == 3) {
        (void)recording_want_third(recording); /* they are there */
    }
    recording_row_t row;
    recording_event_t event = recording_next(recording, &row);
    for (; event == RECORDING_ROW; event = recording_next(recording, &row)) {
        take(session, &row);
        reading_advance(&session->reading);
    }
    if (event != RECORDING_END) {
        return reading_give_up(&session->reading, event);
    }
    progress_clear(&session->reading.progress);
    reading_findings(&session->reading, JCAL_REASON_NONE, &session->findings);
    session->lag = reading_lag(&session->reading, &session->watch, &session->findings);
    if (session->reading.two != NULL) {
        two_files_health_findings(session->reading.two, &recording->check, &session->findings);
    }
    check_measures(&recording->check, &session->measures);
    if (session->common.json) {
        write_json(session);
    } else {
        print(session);
    }
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        return complain_output("standard output");
    }
    return session->findings.explains ? EXIT_NOT_READY : EXIT_READY;
}

int check_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    common_parse(&LINE, argc, argv, &session->common, NULL);
    session->gate_config = jcal_gate_config_default();
    jcal_gate_init(&session->gate);
    (void)lag_watch_begin(&session->watch); /* its parts are ours, and so are their settings */
    exit_status_t status = reading_open_given(&session->reading, &session->common, true);
    if (status == EXIT_READY) {
        reading_begin(&session->reading);
        status = run_rows(session);
    }
    reading_close(&session->reading);
    free(session);
    return (int)status;
}

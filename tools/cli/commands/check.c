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
    .args_doc = "RECORDING.csv",
    .doc =
        "Says what the sensors of a recording do, and what is wrong with it as a whole: units, gravity, frames, times.\v"
        "The recording is as for 'jointcal hinge', with or without a third sensor. Gravity is in m/s^2 if the accelerations are. It "
        "turns against a sensor as fast as the rates say if they are in rad/s, t_s is in seconds, and both stand in one right-handed "
        "frame: 1.0 times. Both are unknown where the sensor hardly turns.\n"
        "\n"
        "Exit status: 0 nothing is wrong as a whole; 3 something is; 2 the command line or the recording is wrong; 1 anything "
        "else." COMMON_PICTURE,
    .offers = {[COMMON_JSON] = {.help = COMMON_JSON_HELP}, [COMMON_SORT] = {.help = COMMON_SORT_HELP}},
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
    lag_watch_t lag; /* of sensors 1 and 2 */
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

static void write_sensors(json_t *json, const session_t *session)
{
    json_key(json, "sensors");
    for (int k = 0; k < session->sensors; k++) {
        (void)fputs((k == 0) ? "[" : ", ", json->file);
        const jcal_health_result_t result = check_health_of(&session->reading.recording.check, k);
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
    const lag_found_t lag = lag_watch_found(&session->lag);
    json_number(&json, "lag_s", lag.known ? (float)lag.lag_s : NAN);
    json_number(&json, "lag_bound_s", lag.known ? (float)lag.bound_s : NAN);
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
    const lag_found_t lag = lag_watch_found(&session->lag);
    if (lag.known) {
        (void)printf("  %-18s sensor 2 is late by %ld ms, to within %.0f\n", "lag", lround(1e3 * lag.lag_s),
                     1e3 * lag.bound_s); /* a whole number has no -0 */
    }
    for (int k = 0; k < session->sensors; k++) {
        const jcal_health_result_t result = check_health_of(&session->reading.recording.check, k);
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
    lag_watch_row(&session->lag, row, session->clock.start_us);
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
    check_findings(&recording->check, &session->findings);
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
    (void)lag_watch_begin(&session->lag); /* its parts are ours, and so are their settings */
    exit_status_t status = reading_open(&session->reading, session->common.recording, session->common.sort);
    if (status == EXIT_READY) {
        reading_begin(&session->reading);
        status = run_rows(session);
    }
    reading_close(&session->reading);
    free(session);
    return (int)status;
}

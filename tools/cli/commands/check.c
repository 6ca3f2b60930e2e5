/* SPDX-License-Identifier: MIT */
/* `jointcal check`: what the sensors of a recording do, whatever the joint. */
#include "commands/commands.h"
#include "input/row_clock.h"
#include "options/common.h"
#include "output/report.h"
#include "output/report_health.h"
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
    jcal_pairing_t pairing; /* of sensors 1 and 2, for the lag between them */
    jcal_sensor_t stage[2];
    jcal_lag_t lag;
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

static jcal_lag_result_t lag_of(const session_t *session)
{
    jcal_lag_result_t lag = {0};
    (void)jcal_lag_get(&session->lag, &lag);
    return lag;
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
    const jcal_lag_result_t lag = lag_of(session);
    json_number(&json, "lag_s", lag.lag_known ? lag.lag_s : NAN);
    json_number(&json, "lag_bound_s", lag.lag_known ? lag.bound_s : NAN);
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
    const jcal_lag_result_t lag = lag_of(session);
    if (lag.lag_known) {
        (void)printf("  %-18s sensor 2 is late by %.0f ms, to within %.0f\n", "lag", 1e3 * (double)lag.lag_s,
                     1e3 * (double)lag.bound_s);
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

/* Ticks of a pair at a common time, and slices of the work. */
static void learn_pair(session_t *session, const jcal_pair_t *pair)
{
    const jcal_reading_t one = {pair->t_us, pair->imu1};
    const jcal_reading_t two = {pair->t_us, pair->imu2};
    const bool has_first = jcal_sensor_push(&session->stage[0], &one) == JCAL_TICK;
    const bool has_second = jcal_sensor_push(&session->stage[1], &two) == JCAL_TICK;
    if (has_first && has_second) {
        (void)jcal_lag_add(&session->lag, jcal_sensor_tick(&session->stage[0]), jcal_sensor_tick(&session->stage[1]));
    }
    (void)jcal_lag_step(&session->lag);
    (void)jcal_pairing_align(&session->pairing, &session->lag);
}

/* Pairs of sensors 1 and 2, whose times are moved against each other as the lag becomes known. */
static void learn_lag(session_t *session, const jcal_pair_t *row)
{
    if (!jcal_sensor_may_take(&row->imu1) || !jcal_sensor_may_take(&row->imu2)) {
        return;
    }
    for (unsigned which = 1u; which <= 2u; which++) {
        const jcal_reading_t reading = {row->t_us, (which == 1u) ? row->imu1 : row->imu2};
        (void)jcal_pairing_push(&session->pairing, which, &reading);
        jcal_pair_t pair;
        while (jcal_pairing_pull(&session->pairing, &pair) == JCAL_OK) {
            learn_pair(session, &pair);
        }
    }
}

static void take(session_t *session, const recording_row_t *row)
{
    jcal_pair_t pair = {row_clock_advance(&session->clock, row), row->imu1, row->imu2};
    if (!row->has_time) {
        pair.imu1.gyr_rad_s.x = NAN; /* the library's time has no NaN; the sample has */
    }
    if (row->has_time) {
        learn_lag(session, &pair);
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
    const jcal_pairing_config_t pairs = jcal_pairing_config_default();
    const bool is_begun = jcal_pairing_init(&session->pairing, &pairs) == JCAL_OK &&
                          jcal_sensor_init(&session->stage[0]) == JCAL_OK &&
                          jcal_sensor_init(&session->stage[1]) == JCAL_OK && jcal_lag_init(&session->lag) == JCAL_OK;
    (void)is_begun; /* they are ours, and so is the config */
    exit_status_t status = reading_open(&session->reading, session->common.recording, session->common.sort);
    if (status == EXIT_READY) {
        reading_begin(&session->reading);
        status = run_rows(session);
    }
    reading_close(&session->reading);
    free(session);
    return (int)status;
}

/* SPDX-License-Identifier: MIT */
/* `jointcal angles`: rows in, angles out. */
#include "commands/angles_options.h"
#include "commands/ball.h"
#include "commands/commands.h"
#include "commands/hinge.h"
#include "commands/two_dof.h"
#include "output/angle_table.h"
#include "run/angle_source.h"
#include "run/reading.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

/* Findings of the recording change slowly. */
#define LOOK_EVERY_ROWS 100u

/* Everything of one run; too big for comfort on the stack. */
typedef struct {
    angles_options_t options;
    reading_t reading;
    orientations_t orientations;
    angle_source_t source;
    angle_table_t table;
    uint64_t rows;
    check_findings_t findings; /* of the recording as a whole */
} session_t;

static exit_status_t refused(void)
{
    complain("jointcal", 0, 0, "the library refused a call; please report this");
    return EXIT_TROUBLE;
}

/* Asks now and then whether the recording as a whole may be used. */
static bool is_refused(session_t *session)
{
    if (session->rows % LOOK_EVERY_ROWS == 0) {
        reading_findings(&session->reading, session->source.head.reason, &session->findings);
    }
    session->rows++;
    return session->findings.refuses;
}

static const report_words_t *words_of(const angle_source_config_t *source)
{
    if (source->ball) {
        return &BALL_WORDS;
    }
    return source->hinge ? &HINGE_WORDS : &TWO_DOF_WORDS;
}

/* Why there are no angles, or none at the end; and what else there is to say of the recording. On standard error. */
static void tell(const session_t *session)
{
    const angle_source_t *source = &session->source;
    const check_findings_t *findings = &session->findings;
    const char *name = session->reading.input.name;
    report_t report = {.words = words_of(&session->options.source), .head = source->head, .findings = *findings};
    size_t told = 0;
    if (source->rows == 0) {
        report_apply_findings(&report);
        const char *reason = source->given ? NULL : report_reason(&report);
        const char *help = (reason != NULL && !findings->explains) ? report_help(&report) : NULL;
        if (findings->explains) {
            reason = findings->sentences[0];
            told = 1;
        }
        complain(name, 0, 0, "no row has angles: %s%s%s",
                 (reason != NULL) ? reason : "the heading is not known in any row",
                 (help != NULL) ? "; what would help: " : "", (help != NULL) ? help : "");
    }
    const bool matters = source->rows == 0 || !source->at_end || findings->refuses;
    for (size_t k = told; matters && k < findings->count; k++) {
        complain(name, 0, 0, "%s", findings->sentences[k]);
    }
}

static exit_status_t run_rows(session_t *session)
{
    oriented_row_t row;
    recording_event_t event = orientations_next(&session->orientations, &row);
    for (; event == RECORDING_ROW; event = orientations_next(&session->orientations, &row)) {
        angles_row_t out;
        if (!angle_source_row(&session->source, &row, is_refused(session), &out)) {
            return refused();
        }
        const exit_status_t status = angle_table_row(&session->table, &out);
        if (status != EXIT_READY) {
            return status;
        }
        reading_advance(&session->reading);
    }
    if (event != RECORDING_END) {
        return reading_give_up(&session->reading, event);
    }
    progress_clear(&session->reading.progress);
    reading_findings(&session->reading, session->source.head.reason, &session->findings);
    tell(session);
    const exit_status_t status = angle_table_end(&session->table);
    if (status != EXIT_READY) {
        return status;
    }
    return session->source.at_end ? EXIT_READY : EXIT_NOT_READY;
}

static exit_status_t run_recording(session_t *session)
{
    const recording_event_t event = orientations_open(&session->orientations, &session->reading.recording,
                                                      session->options.source.hinge || session->options.source.ball);
    if (event != RECORDING_ROW) {
        return reading_give_up(&session->reading, event);
    }
    session->source.config.own_orientations = session->orientations.source == ORIENTATIONS_FROM_JOINT;
    session->reading.recording.check.times_only = session->orientations.source == ORIENTATIONS_FROM_COLUMNS &&
                                                  !session->options.source.ball &&
                                                  (session->source.given || !session->options.source.hinge);
    exit_status_t status = angle_table_open(&session->table, &session->options.table);
    if (status == EXIT_READY) {
        reading_begin(&session->reading);
        status = run_rows(session);
    }
    angle_table_close(&session->table);
    return status;
}

/* The calibration that is given, if one is, and the engines. */
static exit_status_t prepare(session_t *session)
{
    const angles_options_t *options = &session->options;
    calibration_t calibration;
    if (options->calibration != NULL && !calibration_load(options->calibration, options->source.hinge, &calibration)) {
        return EXIT_INPUT;
    }
    return angle_source_start(&session->source, &options->source, (options->calibration != NULL) ? &calibration : NULL)
               ? EXIT_READY
               : refused();
}

int angles_command(int argc, char **argv)
{
    session_t *session = calloc(1, sizeof *session);
    if (session == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    common_options_t common = {0};
    common_parse(&ANGLES_LINE, argc, argv, &common, &session->options);
    exit_status_t status = prepare(session);
    if (status == EXIT_READY) {
        status = reading_open_given(&session->reading, &common, false);
        status = (status == EXIT_READY) ? run_recording(session) : status;
        orientations_close(&session->orientations);
        reading_close(&session->reading);
    }
    free(session);
    return (int)status;
}

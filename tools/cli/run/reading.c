/* SPDX-License-Identifier: MIT */
/* A recording that is being read. */
#include "run/reading.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

exit_status_t reading_open(reading_t *reading, const char *name, bool sorted)
{
    memset(reading, 0, sizeof *reading);
    if (input_open(&reading->input, name) != 0) {
        complain(name, 0, 0, "%s", strerror(reading->input.error));
        return EXIT_INPUT;
    }
    const recording_event_t event = recording_open(&reading->recording, input_read, &reading->input);
    if (event != RECORDING_ROW) {
        return reading_give_up(reading, event);
    }
    if (sorted) {
        recording_want_sorted(&reading->recording);
    }
    return EXIT_READY;
}

static exit_status_t open_two(reading_t *reading, const two_files_config_t *config)
{
    memset(reading, 0, sizeof *reading);
    two_files_t *two = malloc(sizeof *two);
    if (two == NULL) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
        return EXIT_TROUBLE;
    }
    reading->two = two;
    const recording_event_t event = two_files_open(two, config);
    recording_open_source(&reading->recording, two_files_next, two);
    reading->input.name = config->names[0];
    reading->input.size = two->files[0].input.size + two->files[1].input.size;
    return (event == RECORDING_ROW) ? EXIT_READY : reading_give_up(reading, event);
}

exit_status_t reading_open_given(reading_t *reading, const common_options_t *options, bool watched)
{
    if (options->second == NULL) {
        return reading_open(reading, options->recording, options->sort);
    }
    const two_files_config_t config = {.names = {options->recording, options->second},
                                       .sorted = options->sort,
                                       .watched = watched,
                                       .has_lag = options->has_lag,
                                       .lag_us = options->lag_us};
    return open_two(reading, &config);
}

void reading_findings(const reading_t *reading, jcal_reason_t reason, check_findings_t *findings)
{
    check_findings(&reading->recording.check, findings);
    if (reading->two != NULL) {
        two_files_findings(reading->two, reason, findings);
    }
}

report_lag_t reading_lag(const reading_t *reading, const lag_watch_t *watch, check_findings_t *findings)
{
    if (reading->two == NULL) {
        return lag_watch_report(watch, &reading->recording.check, findings);
    }
    const two_files_lag_t found = two_files_lag(reading->two);
    return (report_lag_t){.known = found.known,
                          .lag_us = found.lag_us,
                          .bound_s = (reading->two->kind == TWO_FILES_GIVEN) ? NAN : (float)found.bound_s,
                          .two_files = true,
                          .drift = found.has_drift ? (float)found.drift : NAN};
}

void reading_begin(reading_t *reading)
{
    progress_start(&reading->progress, reading->input.size);
}

void reading_advance(reading_t *reading)
{
    const two_files_t *two = reading->two;
    const uint64_t bytes = (two == NULL) ? reading->recording.csv.bytes
                                         : two->files[0].recording.csv.bytes + two->files[1].recording.csv.bytes;
    progress_show(&reading->progress, bytes);
}

/* Says why a file could not be read on. */
static exit_status_t give_up(const input_t *input, const recording_fault_t *fault, recording_event_t event)
{
    if (event == RECORDING_BAD) {
        complain(input->name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(input->name, 0, 0, "%s", strerror((input->error != 0) ? input->error : ENOMEM));
    return (input->descriptor < 0) ? EXIT_INPUT : EXIT_TROUBLE;
}

exit_status_t reading_give_up(reading_t *reading, recording_event_t event)
{
    progress_clear(&reading->progress);
    if (reading->two == NULL || reading->recording.fault.text[0] != '\0') {
        return give_up(&reading->input, &reading->recording.fault, event);
    }
    const sensor_file_t *file = &reading->two->files[reading->two->at_fault];
    return give_up(&file->input, &file->recording.fault, event);
}

void reading_close(reading_t *reading)
{
    if (reading->two != NULL) {
        two_files_close(reading->two);
        free(reading->two);
    } else {
        input_close(&reading->input);
    }
    recording_close(&reading->recording);
}

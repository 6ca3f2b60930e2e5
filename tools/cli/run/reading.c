/* SPDX-License-Identifier: MIT */
/* A recording that is being read. */
#include "run/reading.h"

#include <errno.h>
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

void reading_begin(reading_t *reading)
{
    progress_start(&reading->progress, reading->input.size);
}

void reading_advance(reading_t *reading)
{
    progress_show(&reading->progress, reading->recording.csv.bytes);
}

exit_status_t reading_give_up(reading_t *reading, recording_event_t event)
{
    const recording_fault_t *fault = &reading->recording.fault;
    progress_clear(&reading->progress);
    if (event == RECORDING_BAD) {
        complain(reading->input.name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(reading->input.name, 0, 0, "%s", strerror((reading->input.error != 0) ? reading->input.error : ENOMEM));
    return EXIT_TROUBLE;
}

void reading_close(reading_t *reading)
{
    recording_close(&reading->recording);
    input_close(&reading->input);
}

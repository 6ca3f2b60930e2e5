/* SPDX-License-Identifier: MIT */
/* What every run over a recording needs at its ends. */
#include "run.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

exit_status_t run_flush(void)
{
    if (fflush(stdout) != 0 || ferror(stdout) != 0) {
        complain("standard output", 0, 0, "%s", strerror(errno));
        return EXIT_TROUBLE;
    }
    return EXIT_READY;
}

exit_status_t run_give_up(const input_t *input, const recording_t *recording, recording_event_t event)
{
    const recording_fault_t *fault = &recording->fault;
    if (event == RECORDING_BAD) {
        complain(input->name, fault->line, fault->column, "%s", fault->text);
        return EXIT_INPUT;
    }
    complain(input->name, 0, 0, "%s", strerror((input->error != 0) ? input->error : ENOMEM));
    return EXIT_TROUBLE;
}

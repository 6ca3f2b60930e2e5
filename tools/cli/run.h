/* SPDX-License-Identifier: MIT */
/// @file
/// What every run over a recording needs at its ends.
#ifndef JCAL_CLI_RUN_H
#define JCAL_CLI_RUN_H

#include "input.h"
#include "message.h"
#include "recording.h"

/// Flushes standard output, so that readers of a pipe get each event at once; complains if that fails.
exit_status_t run_flush(void);

/// Says why a recording could not be read on.
exit_status_t run_give_up(const input_t *input, const recording_t *recording, recording_event_t event);

#endif

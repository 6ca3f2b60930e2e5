/* SPDX-License-Identifier: MIT */
/// @file
/// Progress bar with the time left on standard error; silent unless that is a terminal and the total is known.
#ifndef JCAL_CLI_OUTPUT_PROGRESS_H
#define JCAL_CLI_OUTPUT_PROGRESS_H

#include <stdbool.h>
#include <stdint.h>

typedef struct {
    bool on;
    bool drawn;
    uint64_t total;
    unsigned percent;
    double began_s; /* by the clock */
} progress_t;

void progress_start(progress_t *progress, uint64_t total);

/// Redraws when the percentage has changed; cheap otherwise.
void progress_show(progress_t *progress, uint64_t done);

/// Removes the bar, so that other output starts on a clean line. It comes back with the next percent.
void progress_clear(progress_t *progress);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal two-dof` says, for a program and for a person.
#ifndef JCAL_CLI_TWO_DOF_REPORT_H
#define JCAL_CLI_TWO_DOF_REPORT_H

#include "jointcal/jointcal.h"
#include "timeline.h"

#include <stdio.h>

/// A result and what the program knows besides.
typedef struct {
    jcal_two_dof_result_t result;
    timeline_t timeline;
    uint32_t samples;  ///< Rows read.
    uint32_t rejected;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    bool was_ready;    ///< Ready was entered at least once.
    int64_t ready_us;  ///< When it was entered first, as in the file.
    float max_bound_rad;
    bool from_columns;  ///< Orientations are the recording's own.
} two_dof_report_t;

/// Writes one line of JSON; `event` is estimate, ready, moved or end.
void two_dof_write_json(FILE *file, const char *event, const two_dof_report_t *report);

/// One line for an event in the middle.
void two_dof_print_event(FILE *file, const char *event, const two_dof_report_t *report);

/// The closing summary.
void two_dof_print_summary(FILE *file, const two_dof_report_t *report);

#endif

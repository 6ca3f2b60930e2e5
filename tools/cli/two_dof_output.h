/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal two-dof` writes.
#ifndef JCAL_CLI_TWO_DOF_OUTPUT_H
#define JCAL_CLI_TWO_DOF_OUTPUT_H

#include "report.h"

/// Words for a joint with two axes.
extern const report_words_t TWO_DOF_WORDS;

/// What the result has in common with others, but for the counters, which are those of orientations and not of rows.
finding_t two_dof_finding(const jcal_two_dof_result_t *result);

/// Writes one line of JSON; `event` is estimate, ready, moved or end. The finding is that of the result.
void two_dof_write_json(FILE *file, const char *event, const report_t *report, const jcal_two_dof_result_t *result);

/// The closing summary; `orientations` says where they come from.
void two_dof_print_summary(FILE *file, const report_t *report, const jcal_two_dof_result_t *result,
                           const char *orientations);

#endif

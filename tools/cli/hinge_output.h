/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal hinge` writes.
#ifndef JCAL_CLI_HINGE_OUTPUT_H
#define JCAL_CLI_HINGE_OUTPUT_H

#include "report.h"

/// Words for a hinge.
extern const report_words_t HINGE_WORDS;

/// What a hinge's result has in common with others.
finding_t hinge_finding(const jcal_hinge_result_t *result);

/// Writes one line of JSON; `event` is estimate, ready, moved or end. The finding is that of the result.
void hinge_write_json(FILE *file, const char *event, const report_t *report, const jcal_hinge_result_t *result);

/// The closing summary.
void hinge_print_summary(FILE *file, const report_t *report, const jcal_hinge_result_t *result);

#endif

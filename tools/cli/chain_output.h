/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal chain` writes.
#ifndef JCAL_CLI_CHAIN_OUTPUT_H
#define JCAL_CLI_CHAIN_OUTPUT_H

#include "report.h"

/// Words for hip and knee.
extern const report_words_t CHAIN_WORDS;

/// What the result has in common with others; bounds are the larger one of each joint.
finding_t chain_finding(const jcal_chain_result_t *result);

/// Writes one line of JSON; `event` is estimate, ready, moved or end. The finding is that of the result.
void chain_write_json(FILE *file, const char *event, const report_t *report, const jcal_chain_result_t *result);

/// The closing summary; `orientations` says where they come from, null without.
void chain_print_summary(FILE *file, const report_t *report, const jcal_chain_result_t *result,
                         const char *orientations);

#endif

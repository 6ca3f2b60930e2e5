/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal center` writes.
#ifndef JCAL_CLI_CENTER_OUTPUT_H
#define JCAL_CLI_CENTER_OUTPUT_H

#include "report.h"

/// Words for a joint centre.
extern const report_words_t CENTER_WORDS;

/// What is told besides the result.
typedef struct {
    bool is_hinge;             ///< The axes of a hinge are known.
    bool has_heading;          ///< Orientations are in use ...
    const char *orientations;  ///< ... and where they come from; null without.
} center_setting_t;

/// What the result has in common with others.
finding_t center_finding(const jcal_center_result_t *result);

/// Writes one line of JSON; `event` is estimate, ready, moved or end. The finding is that of the result.
void center_write_json(FILE *file, const char *event, const report_t *report, const jcal_center_result_t *result,
                       const center_setting_t *setting);

/// The closing summary.
void center_print_summary(FILE *file, const report_t *report, const jcal_center_result_t *result,
                          const center_setting_t *setting);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// An event of a hinge calibration as a line of JSON.
#ifndef JCAL_CLI_HINGE_JSON_H
#define JCAL_CLI_HINGE_JSON_H

#include "hinge_summary.h"

/// Writes one line; `event` is estimate, ready, moved or end.
void hinge_write_json(FILE *file, const char *event, const hinge_report_t *report);

#endif

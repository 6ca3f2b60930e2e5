/* SPDX-License-Identifier: MIT */
/// @file
/// Words and keys of a hinge; the hub's estimates have the keys too.
#ifndef JCAL_CLI_COMMANDS_HINGE_H
#define JCAL_CLI_COMMANDS_HINGE_H

#include "output/json.h"
#include "output/report.h"

#include "jointcal/hinge_auto.h"

/// Words for a hinge.
extern const report_words_t HINGE_WORDS;

/// The result of a hinge that knows the rigid model only.
jcal_hinge_auto_result_t hinge_of_rigid(const jcal_hinge_result_t *hinge);

/// Writes the keys that only a hinge has.
void hinge_write_keys(json_t *json, const jcal_hinge_auto_result_t *result, const report_lag_t *lag);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal check` writes of each sensor.
#ifndef JCAL_CLI_OUTPUT_REPORT_HEALTH_H
#define JCAL_CLI_OUTPUT_REPORT_HEALTH_H

#include "output/json.h"

#include "jointcal/health.h"

/// `ok` if nothing is named, `wrong` if readings cannot be used as they are, else `doubtful`.
const char *report_health_verdict(const jcal_health_result_t *result);

/// The lines of sensor `number`.
void report_health_print(FILE *file, int number, const jcal_health_result_t *result);

/// The object of a sensor.
void report_health_json(json_t *json, const jcal_health_result_t *result);

#endif

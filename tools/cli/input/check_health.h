/* SPDX-License-Identifier: MIT */
/// @file
/// The library's health of one sensor (jointcal/health.h), in words.
#ifndef JCAL_CLI_INPUT_CHECK_HEALTH_H
#define JCAL_CLI_INPUT_CHECK_HEALTH_H

#include "input/check_time.h"

#include "jointcal/health.h"

/// Start from all zero.
typedef struct {
    /* Private. */
    jcal_health_t health;
    bool is_begun;
} check_health_t;

/// Takes in a row.
void check_health_push(check_health_t *self, const jcal_imu_t *imu, int64_t t_us);

/// What is known of the sensor; all zero before any row.
jcal_health_result_t check_health_get(const check_health_t *self);

/// What is to be done about a finding of sensor `number`, as a sentence; false if it is not named.
bool check_health_sentence(const jcal_health_result_t *result, jcal_finding_t finding, int number, sentence_t sentence);

/// A component's name: "x of the gyroscope" for 0, "z of the accelerometer" for 5.
const char *check_health_component(unsigned component);

/// How to read the columns where frames do not fit, as "z, -y, x"; empty if it is not known.
void check_health_way(const jcal_health_result_t *result, char way[static 32]);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What `jointcal hinge` tells a person.
#ifndef JCAL_CLI_HINGE_SUMMARY_H
#define JCAL_CLI_HINGE_SUMMARY_H

#include "jointcal/jointcal.h"

#include <stdio.h>

#define DEG_PER_RAD 57.2957795f

/// A bound from here on says nothing: any two axes are at most a quarter turn apart.
#define BOUND_UNKNOWN_RAD 1.5707f

/// A result and what the program knows besides.
typedef struct {
    jcal_hinge_result_t result;
    bool has_time;     ///< False while no row had a time.
    int64_t t_us;      ///< Largest time so far, as in the file.
    int64_t start_us;  ///< First time in the file.
    bool was_ready;    ///< Ready was entered at least once.
    int64_t ready_us;  ///< When it was entered first, as in the file.
    float max_bound_rad;
} hinge_report_t;

/// One line for an event in the middle: estimate, ready, moved.
void hinge_print_event(FILE *file, const char *event, const hinge_report_t *report);

/// The closing summary.
void hinge_print_summary(FILE *file, const hinge_report_t *report);

#endif

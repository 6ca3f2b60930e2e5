/* SPDX-License-Identifier: MIT */
/// @file
/// What the times of a recording tell: their unit, their order, their resolution.
#ifndef JCAL_CLI_INPUT_CHECK_TIME_H
#define JCAL_CLI_INPUT_CHECK_TIME_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#define CHECK_TIME_STEPS 63

/// A sentence for a person, without its full stop.
#define SENTENCE_MAX 240
typedef char sentence_t[SENTENCE_MAX];

/// Start from all zero.
typedef struct {
    uint64_t rows;          ///< Rows with a time.
    uint64_t out_of_order;  ///< Rows that belong before others that came earlier.
    uint64_t standing;      ///< Rows with the time of the row before.
    uint32_t set_back;      ///< How often the clock went back and stayed there.
    double set_back_s;      ///< By how much at the most.
    uint64_t ahead;         ///< Rows whose time is far ahead of those before and after them.

    /* Private. */
    double last_s;
    double top_s; /* latest time so far */
    double low_s; /* earliest time since then */
    uint64_t below;
    double before_jump_s; /* the row before the last jump forward, and rows since */
    uint64_t since_jump;
    double steps_s[CHECK_TIME_STEPS]; /* the first ones that lead forward */
    size_t step_count;
} check_time_t;

/// Takes in the time of a row as it stands in the file, which may be in any unit.
void check_time_push(check_time_t *times, double t_s);

/// Usual time from row to row; 0 while it is not known.
double check_time_step_s(const check_time_t *times);

/// Rows that are out of order, with those that may still turn out to be so.
uint64_t check_time_out_of_order(const check_time_t *times);

/// True if the times alone explain that a calibration is not ready: not for a few rows out of order.
bool check_time_explains(const check_time_t *times);

/// What is wrong with the times, as sentences; returns how many.
size_t check_time_sentences(const check_time_t *times, sentence_t *sentences, size_t most);

#endif

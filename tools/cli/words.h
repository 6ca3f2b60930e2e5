/* SPDX-License-Identifier: MIT */
/// @file
/// The library's enumerators in words for a person; null where there is nothing to say.
#ifndef JCAL_CLI_WORDS_H
#define JCAL_CLI_WORDS_H

#include "jointcal/jointcal.h"

#include <stdio.h>

const char *status_words(jcal_calibration_t status);
const char *reason_words(jcal_reason_t reason);
const char *hint_words(jcal_hint_t hint);
const char *weak_words(jcal_weak_t weak);

/// A labelled line, or nothing if there are no words.
void print_words(FILE *file, const char *label, const char *words);

/// An axis and its bound.
void print_axis(FILE *file, const char *label, bool known, jcal_vec3_t axis, float bound_rad);

/// How many rows were read and how many rejected, and why.
void print_samples(FILE *file, uint32_t samples, uint32_t rejected, const uint32_t *rejected_by);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// JSON Lines: one object per line, written key by key. Unknown values are null; NaN is never written.
#ifndef JCAL_CLI_OUTPUT_JSON_H
#define JCAL_CLI_OUTPUT_JSON_H

#include "input/check_time.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/// An object that is being written.
typedef struct {
    FILE *file;
    bool first; /* no key was written yet */
} json_t;

/// Begins an object. For one inside another, write its key first.
json_t json_begin(FILE *file);

/// Ends the object; the caller ends the line.
void json_end(json_t *json);

/// Writes the key alone; the value follows by other means.
void json_key(json_t *json, const char *key);

/// A plain word of our own, nothing to escape; null stands for a null pointer.
void json_word(json_t *json, const char *key, const char *word);
void json_bool(json_t *json, const char *key, bool value);
void json_count(json_t *json, const char *key, uint32_t value);

/// A number with the digits that give back the same float; NaN becomes null.
void json_number(json_t *json, const char *key, float value);

/// An array of numbers, or null if it is not known.
void json_numbers(json_t *json, const char *key, bool known, const float *values, size_t count);

/// An array of sentences, whatever is in them.
void json_sentences(json_t *json, const char *key, const sentence_t *sentences, size_t count);

/// Microseconds as seconds, exactly; or null if the time is not known.
void json_time(json_t *json, const char *key, bool known, int64_t us);

/// Microseconds as seconds in decimal, without trailing zeros. Returns `buffer`.
const char *time_text(int64_t us, char buffer[static 32]);

#endif

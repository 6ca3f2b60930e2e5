/* SPDX-License-Identifier: MIT */
/// @file
/// Numbers from text, the same whatever the locale.
#ifndef JCAL_CLI_INPUT_NUMBER_H
#define JCAL_CLI_INPUT_NUMBER_H

#include <stdint.h>

/// Largest time or duration, about 73,000 years: differences of two of them fit into 63 bits.
#define NUMBER_US_MAX ((int64_t)1 << 61)

typedef enum {
    NUMBER_FINITE,       ///< A number.
    NUMBER_NOT_FINITE,   ///< nan, inf, nothing at all, or too large for its type.
    NUMBER_NOT_A_NUMBER  ///< Text.
} number_kind_t;

/// The nearest float of a decimal number. `value` becomes NaN or infinite when it is not finite; untouched for text.
number_kind_t number_to_float(const char *text, float *value);

/// Seconds in decimal to microseconds, exactly; a half is rounded upward, so that a shift of whole microseconds does
/// not change differences. `value` is untouched unless it is finite.
number_kind_t number_to_us(const char *text, int64_t *value);

#endif

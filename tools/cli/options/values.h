/* SPDX-License-Identifier: MIT */
/// @file
/// Values of command line options that several subcommands share. A wrong value ends the program with a message.
#ifndef JCAL_CLI_OPTIONS_VALUES_H
#define JCAL_CLI_OPTIONS_VALUES_H

#include "jointcal/types.h"

#include <argp.h>
#include <stdint.h>

/// Index of `word` in a list of two; anything else is an error.
int option_one_of_two(struct argp_state *state, const char *option, const char *word, const char *first,
                      const char *second);

/// The same for three.
int option_one_of_three(struct argp_state *state, const char *option, const char *word,
                        const char *const names[static 3]);

/// Seconds, more than zero; in microseconds.
int64_t option_duration(struct argp_state *state, const char *option, const char *text);

/// Seconds, of either sign; in microseconds.
int64_t option_time(struct argp_state *state, const char *option, const char *text);

/// A number above zero.
float option_positive(struct argp_state *state, const char *option, const char *text);

/// A number that is zero or more.
float option_not_negative(struct argp_state *state, const char *option, const char *text);

/// Value of --n-max: a whole number above zero. `least` and `most` are for the message; the engine's config says what it takes.
uint16_t option_sample_count(struct argp_state *state, const char *text, int least, int most);

/// Numbers with commas between them, `most` at the most; returns how many there are, 0 if it is no such list.
size_t option_numbers(const char *text, float *values, size_t most);

/// A direction X,Y,Z, not zero.
jcal_vec3_t option_direction(struct argp_state *state, const char *option, const char *text);

#endif

/* SPDX-License-Identifier: MIT */
/* Values of command line options. */
#include "options/values.h"

#include "input/number.h"

#include <math.h>
#include <string.h>

int option_one_of_two(struct argp_state *state, const char *option, const char *word, const char *first,
                      const char *second)
{
    if (strcmp(word, first) != 0 && strcmp(word, second) != 0) {
        argp_error(state, "--%s: '%s' is neither %s nor %s", option, word, first, second);
    }
    return strcmp(word, first) != 0;
}

int option_one_of_three(struct argp_state *state, const char *option, const char *word,
                        const char *const names[static 3])
{
    for (int k = 0; k < 3; k++) {
        if (strcmp(word, names[k]) == 0) {
            return k;
        }
    }
    argp_error(state, "--%s: '%s' is neither %s, %s nor %s", option, word, names[0], names[1], names[2]);
    return 0;
}

int64_t option_duration(struct argp_state *state, const char *option, const char *text)
{
    int64_t us = 0;
    if (number_to_us(text, &us) != NUMBER_FINITE || us <= 0) {
        argp_error(state, "--%s: '%s' is not a number of seconds above 0", option, text);
    }
    return us;
}

int64_t option_time(struct argp_state *state, const char *option, const char *text)
{
    int64_t us = 0;
    if (number_to_us(text, &us) != NUMBER_FINITE) {
        argp_error(state, "--%s: '%s' is not a number of seconds", option, text);
    }
    return us;
}

float option_positive(struct argp_state *state, const char *option, const char *text)
{
    float value = 0.0f;
    if (number_to_float(text, &value) != NUMBER_FINITE || value <= 0.0f) {
        argp_error(state, "--%s: '%s' is not a number above 0", option, text);
    }
    return value;
}

float option_not_negative(struct argp_state *state, const char *option, const char *text)
{
    float value = 0.0f;
    if (number_to_float(text, &value) != NUMBER_FINITE || value < 0.0f) {
        argp_error(state, "--%s: '%s' is not a number of at least 0", option, text);
    }
    return value;
}

uint16_t option_sample_count(struct argp_state *state, const char *text, int least, int most)
{
    const float value = option_positive(state, "n-max", text);
    if (value > 65535.0f || floorf(value) != value) {
        argp_error(state, "--n-max: '%s' is not a whole number from %d to %d", text, least, most);
    }
    return (uint16_t)value;
}

size_t option_numbers(const char *text, float *values, size_t most)
{
    size_t count = 0;
    char word[32];
    for (;;) {
        const size_t length = strcspn(text, ",");
        if (length >= sizeof word || count == most) {
            return 0;
        }
        memcpy(word, text, length);
        word[length] = '\0';
        if (number_to_float(word, &values[count]) != NUMBER_FINITE) {
            return 0;
        }
        count++;
        if (text[length] == '\0') {
            return count;
        }
        text += length + 1;
    }
}

jcal_vec3_t option_direction(struct argp_state *state, const char *option, const char *text)
{
    float v[3] = {0.0f, 0.0f, 0.0f};
    if (option_numbers(text, v, 3) != 3 || (v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f)) {
        argp_error(state, "--%s: '%s' is not a direction X,Y,Z", option, text);
    }
    return (jcal_vec3_t){v[0], v[1], v[2]};
}

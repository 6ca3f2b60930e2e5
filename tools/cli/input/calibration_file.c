/* SPDX-License-Identifier: MIT */
/* A calibration from a file of JSON Lines. */
#include "input/calibration_file.h"

#include "input/number.h"
#include "output/message.h"
#include "units.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define VALUE_MAX 160

/* What is left of a line. */
typedef struct {
    const char *at;
} text_t;

static void skip_blanks(text_t *text)
{
    text->at += strspn(text->at, " \t\r\n");
}

/* Takes a character if it comes next. */
static bool take(text_t *text, char wanted)
{
    skip_blanks(text);
    if (*text->at != wanted) {
        return false;
    }
    text->at++;
    return true;
}

/* Takes a string of plain characters; this program writes no others. */
static bool take_string(text_t *text, char buffer[static VALUE_MAX])
{
    if (!take(text, '"')) {
        return false;
    }
    const size_t length = strcspn(text->at, "\"\\");
    if (text->at[length] != '"' || length >= VALUE_MAX) {
        return false;
    }
    memcpy(buffer, text->at, length);
    buffer[length] = '\0';
    text->at += length + 1;
    return true;
}

/* Takes a number or one of null, true, false. */
static bool take_plain(text_t *text, char buffer[static VALUE_MAX])
{
    skip_blanks(text);
    const size_t length = strspn(text->at, "+-.0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ");
    if (length == 0 || length >= VALUE_MAX) {
        return false;
    }
    memcpy(buffer, text->at, length);
    buffer[length] = '\0';
    text->at += length;
    return true;
}

static bool to_float(const char *word, float *value)
{
    return number_to_float(word, value) == NUMBER_FINITE;
}

/* Skips a string with anything in it. */
static bool skip_string(text_t *text)
{
    if (!take(text, '"')) {
        return false;
    }
    while (*text->at != '"' && *text->at != '\0') {
        text->at += (text->at[0] == '\\' && text->at[1] != '\0') ? 2 : 1;
    }
    return take(text, '"');
}

/* Skips a list of sentences, which may be empty. */
static bool skip_sentences(text_t *text)
{
    if (!take(text, '[')) {
        return false;
    }
    if (take(text, ']')) {
        return true;
    }
    do {
        if (!skip_string(text)) {
            return false;
        }
    } while (take(text, ','));
    return take(text, ']');
}

/* True if what comes next is a list of sentences and not of numbers. */
static bool sentences_next(const text_t *text)
{
    const char *at = text->at + 1;
    at += strspn(at, " \t");
    return *at == '"' || *at == ']';
}

/* Takes `[1, 2, 3]`, any count; keeps the first three. */
static bool take_numbers(text_t *text, float values[static 3], size_t *count)
{
    char word[VALUE_MAX];
    *count = 0;
    if (!take(text, '[')) {
        return false;
    }
    do {
        float value = 0.0f;
        if (!take_plain(text, word) || !to_float(word, &value)) {
            return false;
        }
        if (*count < 3) {
            values[*count] = value;
        }
        (*count)++;
    } while (take(text, ','));
    return take(text, ']');
}

/* Takes the object of counts. */
static bool take_counts(text_t *text)
{
    char word[VALUE_MAX];
    if (!take(text, '{')) {
        return false;
    }
    do {
        if (!take_string(text, word) || !take(text, ':') || !take_plain(text, word)) {
            return false;
        }
    } while (take(text, ','));
    return take(text, '}');
}

/* A value of any kind that this program writes. */
typedef struct {
    char word[VALUE_MAX]; /* string or plain word, else empty */
    float numbers[3];
    size_t count; /* of numbers */
} value_t;

static bool take_value(text_t *text, value_t *value)
{
    memset(value, 0, sizeof *value);
    skip_blanks(text);
    switch (*text->at) {
    case '"':
        return take_string(text, value->word);
    case '[':
        return sentences_next(text) ? skip_sentences(text) : take_numbers(text, value->numbers, &value->count);
    case '{':
        return take_counts(text);
    default:
        return take_plain(text, value->word);
    }
}

static const char *set_axis(const value_t *value, jcal_vec3_t *axis)
{
    if (strcmp(value->word, "null") == 0) {
        return NULL;
    }
    const float *v = value->numbers;
    const float length = sqrtf((v[0] * v[0]) + (v[1] * v[1]) + (v[2] * v[2]));
    if (value->count != 3 || !(length > 0.99f && length < 1.01f)) {
        return "an axis is not a unit vector of three numbers";
    }
    *axis = (jcal_vec3_t){v[0], v[1], v[2]};
    return NULL;
}

static const char *set_carrying_angle(const value_t *value, calibration_t *calibration)
{
    calibration->is_two_dof = true;
    if (strcmp(value->word, "null") == 0) {
        return NULL;
    }
    float degrees = 0.0f;
    if (!to_float(value->word, &degrees) || fabsf(degrees) > 90.0f) {
        return "carrying_angle_deg is not a number from -90 to 90";
    }
    calibration->has_carrying_angle = true;
    calibration->carrying_angle_rad = degrees * RAD_PER_DEG;
    return NULL;
}

static const char *use(const char *key, const value_t *value, calibration_t *calibration)
{
    if (strcmp(key, "status") == 0) {
        calibration->ready = strcmp(value->word, "ready") == 0;
    } else if (strcmp(key, "axis1") == 0) {
        return set_axis(value, &calibration->axis1);
    } else if (strcmp(key, "axis2") == 0) {
        return set_axis(value, &calibration->axis2);
    } else if (strcmp(key, "sign_margin") == 0) {
        calibration->is_hinge = true;
    } else if (strcmp(key, "carrying_angle_deg") == 0) {
        return set_carrying_angle(value, calibration);
    }
    return NULL;
}

static bool known(jcal_vec3_t axis)
{
    return axis.x != 0.0f || axis.y != 0.0f || axis.z != 0.0f;
}

const char *calibration_parse(const char *line, calibration_t *calibration)
{
    static const char *const other = "this is no line of --json output";
    memset(calibration, 0, sizeof *calibration);
    text_t text = {line};
    if (!take(&text, '{')) {
        return other;
    }
    do {
        char key[VALUE_MAX];
        value_t value;
        if (!take_string(&text, key) || !take(&text, ':') || !take_value(&text, &value)) {
            return other;
        }
        const char *wrong = use(key, &value, calibration);
        if (wrong != NULL) {
            return wrong;
        }
    } while (take(&text, ','));
    if (!take(&text, '}')) {
        return other;
    }
    skip_blanks(&text);
    calibration->has_axes = known(calibration->axis1) && known(calibration->axis2);
    return (*text.at == '\0') ? NULL : other;
}

/* Why a line that could be read is of no use; null if it is. */
static const char *objection(const calibration_t *calibration, bool hinge)
{
    if (hinge && !calibration->is_hinge) {
        return "this is no calibration of a hinge; it was made with another subcommand";
    }
    if (!hinge && !calibration->is_two_dof) {
        return "this is no calibration of a joint with two axes; it was made with another subcommand";
    }
    if (!calibration->has_axes || !calibration->ready || (!hinge && !calibration->has_carrying_angle)) {
        return "this calibration is not ready: its axes are not known well enough";
    }
    return NULL;
}

/* Reads all lines; the last one that is of use counts. */
static bool load_lines(FILE *file, const char *name, bool hinge, calibration_t *calibration)
{
    char line[CALIBRATION_LINE_MAX];
    const char *wrong = "the file is empty";
    uint64_t number = 0;
    bool found = false;
    while (fgets(line, sizeof line, file) != NULL) {
        number++;
        calibration_t next;
        const char *bad = calibration_parse(line, &next);
        if (bad != NULL) {
            complain(name, number, 0, "%s", bad);
            return false;
        }
        wrong = objection(&next, hinge);
        if (wrong == NULL) {
            *calibration = next;
            found = true;
        }
    }
    if (ferror(file) != 0) {
        complain(name, 0, 0, "%s", strerror(errno));
        return false;
    }
    if (!found) {
        complain(name, number, 0, "%s", wrong);
    }
    return found;
}

bool calibration_load(const char *name, bool hinge, calibration_t *calibration)
{
    FILE *file = fopen(name, "r");
    if (file == NULL) {
        complain(name, 0, 0, "%s", strerror(errno));
        return false;
    }
    const bool loaded = load_lines(file, name, hinge, calibration);
    (void)fclose(file);
    return loaded;
}

bool calibration_axes(const char *name, jcal_vec3_t *axis1, jcal_vec3_t *axis2)
{
    calibration_t calibration;
    if (name == NULL) {
        return true;
    }
    if (!calibration_load(name, true, &calibration)) {
        return false;
    }
    *axis1 = calibration.axis1;
    *axis2 = calibration.axis2;
    return true;
}

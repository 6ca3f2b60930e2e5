/* SPDX-License-Identifier: MIT */
/* JSON Lines. */
#include "output/json.h"

#include <float.h>
#include <inttypes.h>
#include <math.h>
#include <string.h>

json_t json_begin(FILE *file)
{
    (void)fputc('{', file);
    return (json_t){.file = file, .first = true};
}

void json_end(json_t *json)
{
    (void)fputc('}', json->file);
}

void json_key(json_t *json, const char *key)
{
    (void)fprintf(json->file, "%s\"%s\": ", json->first ? "" : ", ", key);
    json->first = false;
}

void json_word(json_t *json, const char *key, const char *word)
{
    json_key(json, key);
    if (word == NULL) {
        (void)fputs("null", json->file);
    } else {
        (void)fprintf(json->file, "\"%s\"", word);
    }
}

void json_bool(json_t *json, const char *key, bool value)
{
    json_key(json, key);
    (void)fputs(value ? "true" : "false", json->file);
}

void json_count(json_t *json, const char *key, uint32_t value)
{
    json_key(json, key);
    (void)fprintf(json->file, "%" PRIu32, value);
}

/* Nine digits are enough for any float. JSON has no infinity: the largest float stands in for it. */
static void write_number(FILE *file, float value)
{
    if (isnan(value)) {
        (void)fputs("null", file);
    } else {
        (void)fprintf(file, "%.9g", (double)fmaxf(-FLT_MAX, fminf(FLT_MAX, value)));
    }
}

void json_number(json_t *json, const char *key, float value)
{
    json_key(json, key);
    write_number(json->file, value);
}

void json_numbers(json_t *json, const char *key, bool known, const float *values, size_t count)
{
    json_key(json, key);
    if (!known) {
        (void)fputs("null", json->file);
        return;
    }
    (void)fputc('[', json->file);
    for (size_t k = 0; k < count; k++) {
        (void)fputs((k == 0) ? "" : ", ", json->file);
        write_number(json->file, values[k]);
    }
    (void)fputc(']', json->file);
}

/* Between quotes, with what JSON forbids there written as it wants it. */
static void write_string(FILE *file, const char *text)
{
    (void)fputc('"', file);
    for (const char *at = text; *at != '\0'; at++) {
        if (*at == '"' || *at == '\\') {
            (void)fprintf(file, "\\%c", *at);
        } else if ((unsigned char)*at < 0x20u) {
            (void)fprintf(file, "\\u%04x", (unsigned)*at);
        } else {
            (void)fputc(*at, file);
        }
    }
    (void)fputc('"', file);
}

void json_sentences(json_t *json, const char *key, const sentence_t *sentences, size_t count)
{
    json_key(json, key);
    (void)fputc('[', json->file);
    for (size_t k = 0; k < count; k++) {
        (void)fputs((k == 0) ? "" : ", ", json->file);
        write_string(json->file, sentences[k]);
    }
    (void)fputc(']', json->file);
}

const char *time_text(int64_t us, char buffer[static 32])
{
    const uint64_t size = (us < 0) ? (uint64_t)-us : (uint64_t)us;
    (void)snprintf(buffer, 32, "%s%" PRIu64 ".%06" PRIu64, (us < 0) ? "-" : "", size / 1000000u, size % 1000000u);
    size_t length = strlen(buffer);
    while (buffer[length - 1] == '0') {
        length--;
    }
    if (buffer[length - 1] == '.') {
        length--;
    }
    buffer[length] = '\0';
    return buffer;
}

void json_time(json_t *json, const char *key, bool known, int64_t us)
{
    char buffer[32];
    json_key(json, key);
    (void)fputs(known ? time_text(us, buffer) : "null", json->file);
}

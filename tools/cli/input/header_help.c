/* SPDX-License-Identifier: MIT */
/* What a file without our columns is. */
#include "input/header_help.h"

#include "input/number.h"

#include <ctype.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

/* So many other separators in one cell are no accident. */
#define SEPARATORS 5u

/* Lines in which a header line is looked for. */
#define LINES_MAX 60

/* Suggestions in one message. */
#define SUGGESTIONS_MAX 6

/* What a column of any recording holds, by its name. */
typedef enum { HOLDS_OTHER, HOLDS_TIME, HOLDS_RATE, HOLDS_ACC, HOLDS_FREE_ACC, HOLDS_ORIENTATION, HOLDS_KINDS } holds_t;

/* A column's name as it may be meant. */
typedef struct {
    holds_t holds;
    char axis;  /* x, y, z, w, or 0 */
    int sensor; /* 1 to 3, or 0 */
} meaning_t;

__attribute__((format(printf, 2, 3))) static void add(char text[static HEADER_HELP_MAX], const char *format, ...)
{
    const size_t length = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    (void)vsnprintf(text + length, HEADER_HELP_MAX - length, format, arguments);
    va_end(arguments);
}

/* Begins a new word, unless one has just begun. */
static size_t part(char *plain, size_t length)
{
    if (length == 0 || plain[length - 1] == ' ') {
        return length;
    }
    plain[length] = ' ';
    return length + 1;
}

/* Letters and digits in lower case; words apart by one blank, digits too: "Gyr1_X" is "gyr 1 x". */
static void simplify(const char *name, char plain[static 64])
{
    size_t length = 0;
    bool digit = false;
    for (const char *at = name; *at != '\0' && length < 61; at++) {
        const unsigned char c = (unsigned char)*at;
        if (isalnum(c) == 0 || (isdigit(c) != 0) != digit) {
            length = part(plain, length);
        }
        if (isalnum(c) != 0) {
            digit = isdigit(c) != 0;
            plain[length++] = (char)tolower(c);
        }
    }
    plain[length] = '\0';
}

static bool starts(const char *word, const char *with)
{
    return strncmp(word, with, strlen(with)) == 0;
}

static bool is_one_of(const char *word, const char *const *list)
{
    for (; *list != NULL; list++) {
        if (strcmp(word, *list) == 0) {
            return true;
        }
    }
    return false;
}

/* Takes one word of a name into what the name means. */
static void take_word(const char *word, meaning_t *meaning)
{
    static const char *const times[] = {"t",  "time", "timestamp", "times", "sec",  "secs", "seconds", "sampletimefine",
                                        "ts", "utc",  "unix",      "epoch", "epoc", NULL};
    static const char *const rates[] = {"w", "omega", "rate", "rates", "angularvelocity", "rotationrate", NULL};
    static const char *const free[] = {
        "free", "freeacc", "linear", "lin", "linacc", "linearacceleration", "useracceleration", "laccel", NULL};
    static const char *const turns[] = {"q", "quat", "quaternion", "orientation", "ori", NULL};
    const size_t length = strlen(word);
    if (is_one_of(word, free)) {
        meaning->holds = HOLDS_FREE_ACC;
    } else if (starts(word, "gyr") || starts(word, "angvel") || starts(word, "angular") ||
               (is_one_of(word, rates) && meaning->holds == HOLDS_OTHER && strcmp(word, "w") != 0)) {
        meaning->holds = HOLDS_RATE;
    } else if ((starts(word, "acc") || strcmp(word, "a") == 0) && meaning->holds != HOLDS_FREE_ACC) {
        meaning->holds = HOLDS_ACC;
    } else if (is_one_of(word, turns)) {
        meaning->holds = HOLDS_ORIENTATION;
    } else if (is_one_of(word, times) && meaning->holds == HOLDS_OTHER) {
        meaning->holds = HOLDS_TIME;
    }
    if (length == 1 && strchr("xyzw", word[0]) != NULL) {
        meaning->axis = word[0];
    } else if (length == 1 && word[0] >= '1' && word[0] <= '3') {
        meaning->sensor = word[0] - '0';
    } else if (meaning->axis == '\0' && (starts(word, "gyr") || starts(word, "acc")) &&
               strchr("xyz", word[length - 1]) != NULL) {
        meaning->axis = word[length - 1];
    }
}

static meaning_t meaning_of(const char *name)
{
    char plain[64];
    meaning_t meaning = {HOLDS_OTHER, '\0', 0};
    simplify(name, plain);
    for (char *word = plain; *word != '\0';) {
        const size_t length = strcspn(word, " ");
        const char after = word[length];
        word[length] = '\0';
        take_word(word, &meaning);
        word += length + ((after == ' ') ? 1 : 0);
    }
    return meaning;
}

static bool same_meaning(const meaning_t *a, const meaning_t *b)
{
    return a->holds != HOLDS_OTHER && a->holds == b->holds &&
           (a->holds == HOLDS_TIME || (a->axis == b->axis && a->axis != '\0'));
}

/* Cells of the row that are among our names. */
static size_t count_known(const csv_t *csv, const header_names_t *names)
{
    size_t count = 0;
    for (size_t k = 0; k < csv->cell_count; k++) {
        for (size_t j = 0; j < names->count; j++) {
            count += (strcmp(csv->cells[k].text, names->names[j]) == 0) ? 1 : 0;
        }
    }
    return count;
}

static size_t count_meant(const csv_t *csv, bool has[static HOLDS_KINDS])
{
    size_t count = 0;
    memset(has, 0, HOLDS_KINDS * sizeof has[0]);
    for (size_t k = 0; k < csv->cell_count; k++) {
        const meaning_t meaning = meaning_of(csv->cells[k].text);
        const bool meant = meaning.holds == HOLDS_TIME || (meaning.holds != HOLDS_OTHER && meaning.axis != '\0');
        has[meaning.holds] = has[meaning.holds] || meant;
        count += meant ? 1 : 0;
    }
    return count;
}

static bool has_cell(const csv_t *csv, const char *name)
{
    for (size_t k = 0; k < csv->cell_count; k++) {
        if (strcasecmp(csv->cells[k].text, name) == 0) {
            return true;
        }
    }
    return false;
}

/* Whose export has such columns; null if it is of no one we know. */
static const char *maker(const csv_t *csv)
{
    static const struct {
        const char *column, *also, *words;
    } makers[] = {{"PacketCounter", "SampleTimeFine", "an export of Movella (Xsens) DOT"},
                  {"PacketCounter", NULL, "an export of Xsens MT Manager"},
                  {"seconds_elapsed", NULL, "a recording of the app Sensor Logger"},
                  {"Time (s)", "Gyroscope x (rad/s)", "a recording of the app phyphox"},
                  {"Time (s)", "Linear Acceleration x (m/s^2)", "a recording of the app phyphox"},
                  {"epoc (ms)", NULL, "a recording of MbientLab MetaBase"},
                  {"loggingTime(txt)", NULL, "a recording of the app SensorLog"}};
    for (size_t k = 0; k < sizeof makers / sizeof makers[0]; k++) {
        if (has_cell(csv, makers[k].column) && (makers[k].also == NULL || has_cell(csv, makers[k].also))) {
            return makers[k].words;
        }
    }
    return NULL;
}

/* What columns of another maker, or of nobody we know, have and lack. */
static void describe(char text[static HEADER_HELP_MAX], const bool has[static HOLDS_KINDS])
{
    if (!has[HOLDS_RATE]) {
        add(text, "; it lacks angular rates (gyr)");
    }
    if (!has[HOLDS_ACC]) {
        add(text, has[HOLDS_FREE_ACC]
                      ? "; its accelerations are free of gravity, and those with gravity (acc) are needed"
                      : "; it lacks accelerations (acc)");
    }
    if (has[HOLDS_ORIENTATION] && !has[HOLDS_RATE]) {
        add(text, "; orientations alone are not enough: record rates and accelerations too");
    }
}

/* Names that are written in another way, as "did you mean". */
static void suggest(const csv_t *csv, const header_names_t *names, char text[static HEADER_HELP_MAX])
{
    size_t count = 0;
    for (size_t j = 0; j < names->needed; j++) {
        const meaning_t wanted = meaning_of(names->names[j]);
        const char *best = NULL;
        for (size_t k = 0; k < csv->cell_count && !names->found[j]; k++) {
            const meaning_t meaning = meaning_of(csv->cells[k].text);
            if (same_meaning(&wanted, &meaning) &&
                (meaning.sensor == wanted.sensor || meaning.sensor == 0 || wanted.holds == HOLDS_TIME) &&
                (best == NULL || meaning.sensor == wanted.sensor)) {
                best = csv->cells[k].text;
            }
        }
        if (best == NULL) {
            continue;
        }
        if (count < SUGGESTIONS_MAX) {
            add(text, "%s%s for '%.24s'", (count == 0) ? "; did you mean " : ", ", names->names[j], best);
        } else if (count == SUGGESTIONS_MAX) {
            add(text, " and so on");
        }
        count++;
    }
    if (count > 0) {
        add(text, "? Names must be as given, small letters too, with t_s in s, gyr in rad/s, acc in m/s^2");
    }
}

static bool all_numbers(const csv_t *csv)
{
    for (size_t k = 0; k < csv->cell_count; k++) {
        float value = 0.0f;
        if (number_to_float(csv->cells[k].text, &value) != NUMBER_FINITE) {
            return false;
        }
    }
    return csv->cell_count > 1;
}

static size_t count_of(const char *text, char c)
{
    size_t count = 0;
    for (const char *at = strchr(text, c); at != NULL; at = strchr(at + 1, c)) {
        count++;
    }
    return count;
}

/* True if the first word is a column's name and no prose. */
static bool begins_with_name(const char *text)
{
    char word[32];
    (void)snprintf(word, sizeof word, "%.*s", (int)strcspn(text, " "), text);
    return meaning_of(word).holds != HOLDS_OTHER;
}

/* A line of one cell, or of few, with another separator in it. */
static const char *separator_words(const csv_t *csv)
{
    const char *text = csv->cells[0].text;
    if (count_of(text, ';') >= SEPARATORS) {
        return " (cells must be separated by commas, and here they are by semicolons; decimal commas must be points)";
    }
    if (count_of(text, '\t') >= SEPARATORS) {
        return " (cells must be separated by commas, and here they are by tabs)";
    }
    if (count_of(text, '|') >= SEPARATORS) {
        return " (cells must be separated by commas, and here they are by bars)";
    }
    return (count_of(text, ' ') >= SEPARATORS && begins_with_name(text))
               ? " (cells must be separated by commas, and here they are by blanks)"
               : NULL;
}

/* Looks for a line below that is a header; true if one is, of ours or of others. */
static bool find_header(csv_t *csv, const header_names_t *names, bool has[static HOLDS_KINDS])
{
    for (int line = 0; line < LINES_MAX && csv_next(csv) == CSV_ROW; line++) {
        if (!all_numbers(csv) && (count_known(csv, names) >= 3 || count_meant(csv, has) >= 4)) {
            (void)count_meant(csv, has);
            return true;
        }
    }
    return false;
}

/* A file whose first line is not the header. */
static bool later_header(csv_t *csv, const header_names_t *names, bool note, char text[static HEADER_HELP_MAX])
{
    bool has[HOLDS_KINDS];
    char found[64];
    (void)snprintf(found, sizeof found, "%.40s%s", csv->cells[0].text, (note && csv->cell_count > 1) ? "," : "");
    if (!find_header(csv, names, has)) {
        if (note) {
            add(text, "'%s' is a note for spreadsheets, not the header line: take this line out", found);
        }
        return note;
    }
    const unsigned long before = (unsigned long)csv->cells[0].line - 1;
    const char *whose = maker(csv);
    if (whose != NULL) {
        add(text, "this is %s, with %lu lines before the header line, which must come first", whose, before);
    } else if (before == 1 && note) {
        add(text, "'%s' is a note for spreadsheets, not the header line: take this line out", found);
    } else {
        add(text, "the header line must come first, and here %lu lines stand before it: take them out", before);
    }
    if (count_known(csv, names) < 3) {
        describe(text, has);
        add(text, "; columns must be called %s, %s", names->columns, names->where);
    }
    return true;
}

bool header_help(csv_t *csv, const header_names_t *names, char text[static HEADER_HELP_MAX])
{
    bool has[HOLDS_KINDS];
    text[0] = '\0';
    const bool note = strncasecmp(csv->cells[0].text, "sep=", 4) == 0;
    if (all_numbers(csv)) {
        add(text, "no header line: the first line has numbers only; it must name the columns %s", names->columns);
        return true;
    }
    const char *separator = note ? NULL : separator_words(csv);
    const size_t known = count_known(csv, names);
    const size_t meant = count_meant(csv, has);
    if (separator != NULL && known == 0 && strstr(csv->cells[0].text, "://") == NULL) {
        add(text, "%s", separator);
        return false;
    }
    if (known == 0 && meant < 4) {
        return later_header(csv, names, note, text);
    }
    const char *whose = maker(csv);
    suggest(csv, names, text);
    if (whose != NULL) {
        add(text, "; this is %s", whose);
    }
    if (whose != NULL || known == 0) {
        describe(text, has);
    }
    return false;
}

const char *number_help(const char *text, bool is_time)
{
    const char *comma = strchr(text, ',');
    if (comma != NULL && isdigit((unsigned char)comma[1]) != 0) {
        return ": decimals must have a point, not a comma";
    }
    const char *colon = strchr(text, ':');
    const bool date = isdigit((unsigned char)text[0]) != 0 &&
                      (colon != NULL || strchr(text, 'T') != NULL || strchr(text, '/') != NULL);
    return (is_time && date) ? ": t_s counts seconds, and this is a date or a time of day" : "";
}

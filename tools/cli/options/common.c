/* SPDX-License-Identifier: MIT */
/* The options that commands share. */
#include "options/common.h"

#include "options/values.h"
#include "units.h"

#include <string.h>

/* Keys of shared options stand after those of any command. */
#define KEY_COMMON (OPTION_OWN + 1000)

/* Most options of a command, shared ones and the end of the table included. */
#define OPTIONS_MAX 32

static const char *const NAMES[COMMON_COUNT] = {"engine",    "n-max",        "window", "every", "max-bound",
                                                "sign-hint", "axis1-toward", "json",   "sort",  "lag"};
static const char *const ARGUMENTS[COMMON_COUNT] = {"NAME", "N", "S", "S", "DEG", "SIGN", "X,Y,Z", NULL, NULL, "S"};

/* What argp hands to the parser. */
typedef struct {
    const command_line_t *line;
    common_options_t *common;
    void *own;
} parse_t;

/* Everything that can be judged only when all options are known. */
static void settle(struct argp_state *state, const parse_t *parse)
{
    const common_options_t *common = parse->common;
    if (common->recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (common->n_max > 0 && common->engine == JCAL_ENGINE_STREAM) {
        argp_error(state, "%s", COMMON_N_MAX_REFUSAL);
    }
    if (common->recording != NULL && common->second != NULL && strcmp(common->recording, "-") == 0 &&
        strcmp(common->second, "-") == 0) {
        argp_error(state, "two files, and - is standard input, which is one");
    }
    if (common->has_lag && common->second == NULL) {
        argp_error(state, "--lag goes with two files: the sensors of one file have one clock");
    }
    parse->line->settle(state, parse->common, parse->own);
}

static void take(struct argp_state *state, const parse_t *parse, common_option_t option, const char *argument)
{
    const command_line_t *line = parse->line;
    common_options_t *common = parse->common;
    switch (option) {
    case COMMON_ENGINE:
        common->engine = (jcal_engine_t)option_one_of_two(state, "engine", argument, "stream", "window");
        if (common->engine == JCAL_ENGINE_WINDOW && line->offers[COMMON_ENGINE].refusal != NULL) {
            argp_error(state, "%s", line->offers[COMMON_ENGINE].refusal);
        }
        return;
    case COMMON_N_MAX:
        common->n_max = option_sample_count(state, argument, line->n_max_least, line->n_max_most);
        return;
    case COMMON_WINDOW:
        common->window_s = 1e-6f * (float)option_duration(state, "window", argument);
        return;
    case COMMON_EVERY:
        common->every_us = option_duration(state, "every", argument);
        return;
    case COMMON_MAX_BOUND:
        common->max_bound =
            option_positive(state, "max-bound", argument) * ((line->bound_unit == BOUND_IN_DEG) ? RAD_PER_DEG : 1.0f);
        return;
    case COMMON_SIGN_HINT:
        common->sign_hint = (option_one_of_two(state, "sign-hint", argument, "same", "opposite") == 0)
                                ? JCAL_SIGN_SAME
                                : JCAL_SIGN_OPPOSITE;
        return;
    case COMMON_AXIS1_TOWARD:
        common->axis1_toward = option_direction(state, "axis1-toward", argument);
        return;
    case COMMON_JSON:
        common->json = true;
        return;
    case COMMON_LAG:
        common->has_lag = true;
        common->lag_us = option_time(state, "lag", argument);
        return;
    case COMMON_SORT:
    case COMMON_COUNT:
    default:
        common->sort = true;
    }
}

static void take_name(struct argp_state *state, const parse_t *parse, const char *argument)
{
    common_options_t *common = parse->common;
    if (parse->line->take_file != NULL) {
        parse->line->take_file(state, argument, parse->own);
        common->recording = (common->recording == NULL) ? argument : common->recording;
        return;
    }
    if (common->recording == NULL) {
        common->recording = argument;
    } else if (!parse->line->two_files) {
        argp_error(state, "one recording at a time, and '%s' is a second one", argument);
    } else if (common->second == NULL) {
        common->second = argument;
    } else {
        argp_error(state, "two files at the most, one of each sensor, and '%s' is a third one", argument);
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    parse_t *parse = state->input;
    if (key == ARGP_KEY_ARG) {
        take_name(state, parse, argument);
        return 0;
    }
    if (key == ARGP_KEY_END) {
        settle(state, parse);
        return 0;
    }
    if (key == 'h') {
        argp_state_help(state, stdout, ARGP_HELP_STD_HELP); /* ends the program */
    }
    if (key < KEY_COMMON || key >= KEY_COMMON + (int)COMMON_COUNT) {
        return (parse->line->parse != NULL) ? parse->line->parse(key, argument, state, parse->own) : ARGP_ERR_UNKNOWN;
    }
    const common_option_t option = (common_option_t)(key - KEY_COMMON);
    const common_offer_t *offer = &parse->line->offers[option];
    if (offer->help == NULL) {
        argp_error(state, "%s", offer->refusal);
    }
    take(state, parse, option, argument);
    return 0;
}

/* The command's own options and those that it shares, in one table. */
static void list_options(const command_line_t *line, struct argp_option table[static OPTIONS_MAX])
{
    size_t count = 0;
    for (const struct argp_option *own = line->own; own != NULL && own->name != NULL; own++) {
        table[count++] = *own;
    }
    for (size_t k = 0; k < COMMON_COUNT; k++) {
        const common_offer_t *offer = &line->offers[k];
        if (offer->help != NULL || offer->refusal != NULL) {
            const bool metres = k == COMMON_MAX_BOUND && line->bound_unit == BOUND_IN_M;
            table[count++] = (struct argp_option){.name = NAMES[k],
                                                  .key = KEY_COMMON + (int)k,
                                                  .arg = metres ? "M" : ARGUMENTS[k],
                                                  .flags = (offer->help == NULL) ? OPTION_HIDDEN : 0,
                                                  .doc = (offer->help == NULL) ? "" : offer->help};
        }
    }
    table[count++] = (struct argp_option){.name = "h", .key = 'h', .flags = OPTION_HIDDEN, .doc = ""};
    memset(&table[count], 0, sizeof table[count]);
}

void common_parse(const command_line_t *line, int argc, char **argv, common_options_t *common, void *options)
{
    struct argp_option table[OPTIONS_MAX];
    list_options(line, table);
    const struct argp parser = {.options = table, .parser = parse_option, .args_doc = line->args_doc, .doc = line->doc};
    parse_t parse = {line, common, options};
    (void)argp_parse(&parser, argc, argv, 0, NULL, &parse);
}

void common_check(struct argp_state *state, const char *field, const common_limit_t *limits, size_t count)
{
    if (field == NULL) {
        return;
    }
    for (size_t k = 0; k < count; k++) {
        if (strcmp(field, limits[k].field) == 0) {
            argp_error(state, "--%s: %g is not %s", limits[k].option, (double)limits[k].value, limits[k].range);
        }
    }
    argp_error(state, "the library does not take these options together: %s", field);
}

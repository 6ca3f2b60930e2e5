/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal hinge`. */
#include "hinge_options.h"

#include "option_values.h"

#include <argp.h>
#include <string.h>

#define RAD_PER_DEG 0.0174532925f

/* Keys of options without a short form. */
enum { KEY_ENGINE = 256, KEY_N_MAX, KEY_WINDOW, KEY_EVERY, KEY_MAX_BOUND, KEY_SIGN_HINT, KEY_JSON };

static const struct argp_option OPTIONS[] = {
    {"engine", KEY_ENGINE, "NAME", 0,
     "How to compute. stream (default): sums of moments, remembers everything, constant memory. window: selected "
     "samples in a buffer, as published by Olsson et al. 2020",
     0},
    {"n-max", KEY_N_MAX, "N", 0, "Samples in the window engine's buffer, 20 to 10000 (default 500)", 0},
    {"window", KEY_WINDOW, "S", 0,
     "Memory in seconds for what drifts. Accepted for all joints; a hinge has nothing that drifts, so it changes "
     "nothing here. Not with --engine window, whose buffer counts samples (--n-max)",
     0},
    {"every", KEY_EVERY, "S", 0, "Report an estimate every S seconds of recording time", 0},
    {"max-bound", KEY_MAX_BOUND, "DEG", 0,
     "Ready when both axes are known to within DEG degrees with 95 % confidence (default 3)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", 0,
     "What is known about the sign pairing. same: the largest components of both axes have the same sign; opposite: "
     "they have not",
     0},
    {"json", KEY_JSON, NULL, 0, "Write JSON Lines instead of text", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* What the parser fills in, and what it must remember until all options are read. */
typedef struct {
    hinge_options_t options;
    bool has_n_max;
    bool has_window;
} parse_t;

/* Everything that can be judged only when all options are known. */
static void check(struct argp_state *state, const parse_t *parse)
{
    const engine_config_t *engine = &parse->options.engine;
    if (parse->options.common.recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (parse->has_n_max && engine->kind == JCAL_ENGINE_STREAM) {
        argp_error(state, "--n-max goes with --engine window only: the stream engine keeps no samples");
    }
    if (parse->has_window && engine->kind == JCAL_ENGINE_WINDOW) {
        argp_error(state, "--window does not go with --engine window here: its buffer counts samples, see --n-max");
    }
    const jcal_hinge_config_t *hinge = &engine->config.hinge;
    if (jcal_hinge_config_check(hinge) != NULL) {
        argp_error(state, "--max-bound: %g degrees are outside what makes sense, 0.06 to 28 degrees",
                   (double)(hinge->max_bound_rad / RAD_PER_DEG));
    }
    if (engine->kind == JCAL_ENGINE_WINDOW && jcal_hinge_window_config_check(&engine->config) != NULL) {
        argp_error(state, "--n-max: %d is not a number from 20 to 10000", (int)engine->config.n_max);
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    parse_t *parse = state->input;
    engine_config_t *engine = &parse->options.engine;
    switch (key) {
    case KEY_ENGINE:
        engine->kind = (jcal_engine_t)option_one_of_two(state, "engine", argument, "stream", "window");
        return 0;
    case KEY_N_MAX:
        engine->config.n_max = option_sample_count(state, argument, 20, 10000);
        parse->has_n_max = true;
        return 0;
    case KEY_WINDOW:
        (void)option_duration(state, "window", argument);
        parse->has_window = true;
        return 0;
    case KEY_EVERY:
        parse->options.common.every_us = option_duration(state, "every", argument);
        return 0;
    case KEY_MAX_BOUND:
        engine->config.hinge.max_bound_rad = option_positive(state, "max-bound", argument) * RAD_PER_DEG;
        return 0;
    case KEY_SIGN_HINT:
        engine->config.hinge.sign_hint = (option_one_of_two(state, "sign-hint", argument, "same", "opposite") == 0)
                                             ? JCAL_SIGN_SAME
                                             : JCAL_SIGN_OPPOSITE;
        return 0;
    case KEY_JSON:
        parse->options.common.json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (parse->options.common.recording != NULL) {
            argp_error(state, "one recording at a time, and '%s' is a second one", argument);
        }
        parse->options.common.recording = argument;
        return 0;
    case ARGP_KEY_END:
        check(state, parse);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp PARSER = {
    .options = OPTIONS,
    .parser = parse_option,
    .args_doc = "RECORDING.csv",
    .doc = "Finds both axes of a hinge joint from a recording of arbitrary motion.\v"
           "The recording is CSV with one header line; the columns t_s (s), gyr1_x, gyr1_y, gyr1_z, gyr2_x ... (rad/s) "
           "and acc1_x ... acc2_z (m/s^2) may stand in any order among others. Sensor 1 sits on the proximal segment, "
           "sensor 2 on the distal one. - reads standard input.\n"
           "\n"
           "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is "
           "wrong; 1 anything else.",
};

hinge_options_t hinge_options(int argc, char **argv)
{
    parse_t parse = {.options.engine.config = jcal_hinge_window_config_default()};
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &parse);
    return parse.options;
}

/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal two-dof`. */
#include "two_dof_options.h"

#include "option_values.h"

#include <argp.h>
#include <math.h>
#include <string.h>

#define RAD_PER_DEG 0.0174532925f

/* Samples that the window engine keeps a second. */
#define ROWS_PER_S 20.0f

/* Keys of options without a short form. */
enum { KEY_CONSTRAINT = 256, KEY_ENGINE, KEY_N_MAX, KEY_WINDOW, KEY_EVERY, KEY_MAX_BOUND, KEY_SIGN_HINT, KEY_JSON };

static const struct argp_option OPTIONS[] = {
    {"constraint", KEY_CONSTRAINT, "NAME", 0,
     "What is known of the joint. rotation: its segments do not turn against each other about the third axis; orientation: "
     "the angle between its axes does not change; combined: both (default, but rotation with --engine window, which has no "
     "combined)",
     0},
    {"engine", KEY_ENGINE, "NAME", 0,
     "How to compute. stream (default): sums of moments, constant memory. window: the last samples in a buffer, 20 a second, "
     "as published by Laidig et al. 2022",
     0},
    {"n-max", KEY_N_MAX, "N", 0, "Samples in the window engine's buffer, 20 to 10000 (default 200)", 0},
    {"window", KEY_WINDOW, "S", 0,
     "Memory in seconds for the heading, which drifts, once the calibration is ready: 2 to 600 (default 5). With --engine "
     "window the length of its buffer: 1 to 500 (default 10)",
     0},
    {"every", KEY_EVERY, "S", 0, "Report an estimate every S seconds of recording time", 0},
    {"max-bound", KEY_MAX_BOUND, "DEG", 0,
     "Ready when both axes and the heading are known to within DEG degrees with 95 % confidence (default 3)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", OPTION_HIDDEN, "", 0},
    {"json", KEY_JSON, NULL, 0, "Write JSON Lines instead of text", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* What the parser fills in, and what it must remember until all options are read. */
typedef struct {
    two_dof_options_t options;
    bool has_n_max;
    bool has_window;
    bool has_constraint;
} parse_t;

static jcal_constraint_t constraint(struct argp_state *state, const char *word)
{
    if (strcmp(word, "combined") == 0) {
        return JCAL_CONSTRAINT_COMBINED;
    }
    if (strcmp(word, "rotation") == 0) {
        return JCAL_CONSTRAINT_ROTATION;
    }
    if (strcmp(word, "orientation") != 0) {
        argp_error(state, "--constraint: '%s' is neither combined, rotation nor orientation", word);
    }
    return JCAL_CONSTRAINT_ORIENTATION;
}

static void check_stream(struct argp_state *state, const parse_t *parse)
{
    if (parse->has_n_max) {
        argp_error(state, "--n-max goes with --engine window only: the stream engine keeps no samples");
    }
}

/* The buffer's length in samples, whichever way it was given. */
static void settle_window(struct argp_state *state, parse_t *parse)
{
    jcal_two_dof_window_config_t *config = &parse->options.engine.config;
    if (!parse->has_constraint) {
        config->two_dof.constraint = JCAL_CONSTRAINT_ROTATION;
    }
    if (config->two_dof.constraint == JCAL_CONSTRAINT_COMBINED) {
        argp_error(state, "--constraint combined goes with --engine stream only: choose rotation or orientation");
    }
    if (parse->has_n_max && parse->has_window) {
        argp_error(state, "--n-max and --window both set the length of the buffer: give one of them");
    }
    if (parse->has_window) {
        const float samples = roundf(ROWS_PER_S * config->two_dof.memory_s);
        if (samples < 20.0f || samples > 10000.0f) {
            argp_error(state, "--window: %g is not a number of seconds from 1 to 500",
                       (double)config->two_dof.memory_s);
        }
        config->n_max = (uint16_t)samples;
        config->two_dof.memory_s = jcal_two_dof_config_default().memory_s; /* has no meaning here */
    }
}

static void check_config(struct argp_state *state, const two_dof_engine_config_t *engine)
{
    const jcal_two_dof_config_t *config = &engine->config.two_dof;
    const char *field = jcal_two_dof_config_check(config);
    if (field != NULL && strcmp(field, "memory_s") == 0) {
        argp_error(state, "--window: %g is not a number of seconds from 2 to 600", (double)config->memory_s);
    } else if (field != NULL) {
        argp_error(state, "--max-bound: %g degrees are outside what makes sense, 0.06 to 28 degrees",
                   (double)(config->max_bound_rad / RAD_PER_DEG));
    } else if (engine->kind == JCAL_ENGINE_WINDOW && jcal_two_dof_window_config_check(&engine->config) != NULL) {
        argp_error(state, "--n-max: %d is not a number from 20 to 10000", (int)engine->config.n_max);
    }
}

/* Everything that can be judged only when all options are known. */
static void settle(struct argp_state *state, parse_t *parse)
{
    if (parse->options.common.recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (parse->options.engine.kind == JCAL_ENGINE_STREAM) {
        check_stream(state, parse);
    } else {
        settle_window(state, parse);
    }
    check_config(state, &parse->options.engine);
}

/* Options that say what to compute. */
static error_t parse_values(int key, char *argument, struct argp_state *state)
{
    parse_t *parse = state->input;
    two_dof_engine_config_t *engine = &parse->options.engine;
    switch (key) {
    case KEY_CONSTRAINT:
        engine->config.two_dof.constraint = constraint(state, argument);
        parse->has_constraint = true;
        return 0;
    case KEY_ENGINE:
        engine->kind = (jcal_engine_t)option_one_of_two(state, "engine", argument, "stream", "window");
        return 0;
    case KEY_N_MAX:
        engine->config.n_max = option_sample_count(state, argument, 20, 10000);
        parse->has_n_max = true;
        return 0;
    case KEY_WINDOW:
        engine->config.two_dof.memory_s = 1e-6f * (float)option_duration(state, "window", argument);
        parse->has_window = true;
        return 0;
    case KEY_MAX_BOUND:
        engine->config.two_dof.max_bound_rad = option_positive(state, "max-bound", argument) * RAD_PER_DEG;
        return 0;
    case KEY_SIGN_HINT:
        argp_error(state, "--sign-hint is for a hinge: each axis of a joint with two axes has a sign of its own");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    parse_t *parse = state->input;
    calibrate_options_t *common = &parse->options.common;
    switch (key) {
    case KEY_EVERY:
        common->every_us = option_duration(state, "every", argument);
        return 0;
    case KEY_JSON:
        common->json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (common->recording != NULL) {
            argp_error(state, "one recording at a time, and '%s' is a second one", argument);
        }
        common->recording = argument;
        return 0;
    case ARGP_KEY_END:
        settle(state, parse);
        return 0;
    default:
        return parse_values(key, argument, state);
    }
}

static const struct argp PARSER = {
    .options = OPTIONS,
    .parser = parse_option,
    .args_doc = "RECORDING.csv",
    .doc =
        "Finds both axes of a joint with two degrees of freedom, like elbow and forearm, and the heading offset of the two "
        "sensors' orientations from a recording of arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Orientations are taken from the columns q1_w, q1_x, q1_y, q1_z, q2_w ... "
        "q2_z if both sensors have them (unit quaternions that turn from the sensor's frame to an earth frame with z up, "
        "each with a heading of its own); else they are computed from the rates and specific forces.\n"
        "\n"
        "The heading offset turns vectors from the earth frame of sensor 2 to that of sensor 1, about z.\n"
        "\n"
        "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is "
        "wrong; 1 anything else.",
};

two_dof_options_t two_dof_options(int argc, char **argv)
{
    parse_t parse = {.options.engine.config = jcal_two_dof_window_config_default()};
    parse.options.engine.config.two_dof.constraint = JCAL_CONSTRAINT_COMBINED;
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &parse);
    return parse.options;
}

/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal two-dof`. */
#include "two_dof_options.h"

#include "option_values.h"

#include <argp.h>
#include <string.h>

#define RAD_PER_DEG 0.0174532925f

/* Keys of options without a short form. */
enum { KEY_CONSTRAINT = 256, KEY_ENGINE, KEY_N_MAX, KEY_WINDOW, KEY_EVERY, KEY_MAX_BOUND, KEY_SIGN_HINT, KEY_JSON };

static const struct argp_option OPTIONS[] = {
    {"constraint", KEY_CONSTRAINT, "NAME", 0,
     "What is known of the joint. rotation: the segments do not turn against each other about the normal of both axes; "
     "orientation: the angle between the axes does not change; combined (default): both",
     0},
    {"engine", KEY_ENGINE, "NAME", 0,
     "How to compute. stream (default): sums of moments, constant memory. window: a buffer of samples, as published by "
     "Laidig et al. 2022",
     0},
    {"n-max", KEY_N_MAX, "N", 0, "Samples in the window engine's buffer", 0},
    {"window", KEY_WINDOW, "S", 0,
     "Memory in seconds for what drifts, the heading offset, once the calibration is ready: 2 to 600 (default 5)", 0},
    {"every", KEY_EVERY, "S", 0, "Report an estimate every S seconds of recording time", 0},
    {"max-bound", KEY_MAX_BOUND, "DEG", 0,
     "Ready when both axes and the heading offset are known to within DEG degrees with 95 % confidence (default 3)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", OPTION_HIDDEN, NULL, 0},
    {"json", KEY_JSON, NULL, 0, "Write JSON Lines instead of text", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* What the parser fills in, and what it must remember until all options are read. */
typedef struct {
    two_dof_options_t options;
    bool has_constraint;
    bool has_n_max;
    jcal_engine_t engine;
} parse_t;

static jcal_constraint_t constraint_named(struct argp_state *state, const char *name)
{
    if (strcmp(name, "combined") == 0) {
        return JCAL_CONSTRAINT_COMBINED;
    }
    if (strcmp(name, "rotation") == 0) {
        return JCAL_CONSTRAINT_ROTATION;
    }
    if (strcmp(name, "orientation") != 0) {
        argp_error(state, "--constraint: '%s' is neither combined nor rotation nor orientation", name);
    }
    return JCAL_CONSTRAINT_ORIENTATION;
}

/* Everything that can be judged only when all options are known. */
static void check(struct argp_state *state, const parse_t *parse)
{
    const jcal_two_dof_config_t *config = &parse->options.config;
    if (parse->options.recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (parse->has_n_max && parse->engine == JCAL_ENGINE_STREAM) {
        argp_error(state, "--n-max goes with --engine window only: the stream engine keeps no samples");
    }
    if (parse->engine == JCAL_ENGINE_WINDOW) {
        if (parse->has_constraint && config->constraint == JCAL_CONSTRAINT_COMBINED) {
            argp_error(state, "--constraint combined goes with --engine stream only: the paper has no such method");
        }
        argp_error(state, "--engine window: there is no window engine for two axes in this version");
    }
    const char *wrong = jcal_two_dof_config_check(config);
    if (wrong != NULL && strcmp(wrong, "memory_s") == 0) {
        argp_error(state, "--window: %g s are outside what makes sense, 2 to 600 s", (double)config->memory_s);
    }
    if (wrong != NULL) {
        argp_error(state, "--max-bound: %g degrees are outside what makes sense, 0.06 to 28 degrees",
                   (double)(config->max_bound_rad / RAD_PER_DEG));
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    parse_t *parse = state->input;
    jcal_two_dof_config_t *config = &parse->options.config;
    switch (key) {
    case KEY_CONSTRAINT:
        config->constraint = constraint_named(state, argument);
        parse->has_constraint = true;
        return 0;
    case KEY_ENGINE:
        parse->engine = (jcal_engine_t)option_one_of_two(state, "engine", argument, "stream", "window");
        return 0;
    case KEY_N_MAX:
        (void)option_positive(state, "n-max", argument);
        parse->has_n_max = true;
        return 0;
    case KEY_WINDOW:
        config->memory_s = 1e-6f * (float)option_duration(state, "window", argument);
        return 0;
    case KEY_EVERY:
        parse->options.every_us = option_duration(state, "every", argument);
        return 0;
    case KEY_MAX_BOUND:
        config->max_bound_rad = option_positive(state, "max-bound", argument) * RAD_PER_DEG;
        return 0;
    case KEY_SIGN_HINT:
        argp_error(state, "--sign-hint is for a hinge: the signs of two axes are free");
        return 0;
    case KEY_JSON:
        parse->options.json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (parse->options.recording != NULL) {
            argp_error(state, "one recording at a time, and '%s' is a second one", argument);
        }
        parse->options.recording = argument;
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
    .doc =
        "Finds both axes of a joint with two axes, like an elbow or an ankle, and the heading offset between the sensors' "
        "orientations, from a recording of arbitrary motion.\v"
        "The recording is CSV with one header line; the columns t_s (s), gyr1_x, gyr1_y, gyr1_z, gyr2_x ... (rad/s) "
        "and acc1_x ... acc2_z (m/s^2) may stand in any order among others. Orientations without magnetometer, sensor "
        "to earth, are taken from the columns q1_w, q1_x ... q2_z if all of them are there; else the filter VQF finds "
        "them. Sensor 1 sits on the proximal segment, sensor 2 on the distal one. - reads standard input.\n"
        "\n"
        "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is "
        "wrong; 1 anything else.",
};

two_dof_options_t two_dof_options(int argc, char **argv)
{
    parse_t parse = {.options.config = jcal_two_dof_config_default()};
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &parse);
    return parse.options;
}

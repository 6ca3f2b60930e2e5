/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal chain`. */
#include "chain_options.h"

#include "option_values.h"

#include <argp.h>
#include <string.h>

/* Keys of options without a short form. */
enum {
    KEY_METHOD = 256,
    KEY_SMOOTHING,
    KEY_THIGH_LENGTH,
    KEY_CALIBRATION,
    KEY_ENGINE,
    KEY_N_MAX,
    KEY_WINDOW,
    KEY_EVERY,
    KEY_MAX_BOUND,
    KEY_SIGN_HINT,
    KEY_JSON
};

static const struct argp_option OPTIONS[] = {
    {"method", KEY_METHOD, "NAME", 0, "As for 'jointcal center': ss (default), sa, or ls, which needs orientations", 0},
    {"smoothing", KEY_SMOOTHING, "S", 0, "As for 'jointcal center', 0 to 2 (default 0.12)", 0},
    {"thigh-length", KEY_THIGH_LENGTH, "M", 0, "Distance of hip and knee in metres, if it is known: 0.05 to 1", 0},
    {"calibration", KEY_CALIBRATION, "FILE", 0,
     "The knee is a hinge with these axes: output of 'jointcal hinge --json' for thigh and shank. Its centre is then the point of the "
     "axis next to both sensors",
     0},
    {"engine", KEY_ENGINE, "NAME", 0, "How to compute: stream (default). The chain has no other engine", 0},
    {"n-max", KEY_N_MAX, "N", OPTION_HIDDEN, "", 0},
    {"window", KEY_WINDOW, "S", 0, "Memory in seconds for what wanders, biases and headings: 10 to 3600 (default 300)",
     0},
    {"every", KEY_EVERY, "S", 0, "Report an estimate every S seconds of recording time", 0},
    {"max-bound", KEY_MAX_BOUND, "M", 0,
     "Ready when both centres are known to within M metres from all sensors with 95 % confidence (default 0.01)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", OPTION_HIDDEN, "", 0},
    {"json", KEY_JSON, NULL, 0, "Write JSON Lines instead of text", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Everything that can be judged only when all options are known. */
static void settle(struct argp_state *state, const chain_options_t *options)
{
    if (options->common.recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    const char *field = jcal_chain_config_check(&options->config);
    if (field == NULL) {
        return;
    }
    if (strcmp(field, "segment_length_m") == 0) {
        argp_error(state, "--thigh-length: %g is not a number of metres from 0.05 to 1",
                   (double)options->config.segment_length_m);
    }
    if (strcmp(field, "memory_s") == 0) {
        argp_error(state, "--window: %g is not a number of seconds from 10 to 3600",
                   (double)options->config.center.memory_s);
    }
    if (strcmp(field, "smoothing_s") == 0) {
        argp_error(state, "--smoothing: %g is not a number of seconds from 0 to 2",
                   (double)options->config.center.kinematics.smoothing_s);
    }
    argp_error(state, "--max-bound: %g metres are outside what makes sense, 0.001 to 0.1 m",
               (double)options->config.center.max_bound_m);
}

/* Options that say what to compute. */
static error_t parse_values(int key, char *argument, struct argp_state *state)
{
    static const char *const methods[] = {"ss", "sa", "ls"};
    chain_options_t *options = state->input;
    switch (key) {
    case KEY_METHOD:
        options->config.center.method = (jcal_center_method_t)option_one_of_three(state, "method", argument, methods);
        return 0;
    case KEY_SMOOTHING:
        options->config.center.kinematics.smoothing_s = option_not_negative(state, "smoothing", argument);
        return 0;
    case KEY_THIGH_LENGTH:
        options->config.segment_length_m = option_positive(state, "thigh-length", argument);
        return 0;
    case KEY_CALIBRATION:
        options->calibration = argument;
        return 0;
    case KEY_ENGINE:
        if (option_one_of_two(state, "engine", argument, "stream", "window") != 0) {
            argp_error(state, "--engine window: the chain has the stream engine only");
        }
        return 0;
    case KEY_N_MAX:
        argp_error(state, "--n-max goes with --engine window, which the chain does not have");
        return 0;
    case KEY_SIGN_HINT:
        argp_error(state, "--sign-hint is for a hinge: joint centres have no sign");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    chain_options_t *options = state->input;
    switch (key) {
    case KEY_WINDOW:
        options->config.center.memory_s = 1e-6f * (float)option_duration(state, "window", argument);
        return 0;
    case KEY_MAX_BOUND:
        options->config.center.max_bound_m = option_positive(state, "max-bound", argument);
        return 0;
    case KEY_EVERY:
        options->common.every_us = option_duration(state, "every", argument);
        return 0;
    case KEY_JSON:
        options->common.json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (options->common.recording != NULL) {
            argp_error(state, "one recording at a time, and '%s' is a second one", argument);
        }
        options->common.recording = argument;
        return 0;
    case ARGP_KEY_END:
        settle(state, options);
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
        "Finds where three sensors, 1 on the pelvis, 2 on the thigh and 3 on the shank, sit relative to the centres of hip and knee, "
        "from arbitrary motion.\v"
        "The recording is as for 'jointcal hinge', with gyr3_x ... acc3_z besides. Results are the vectors from each joint's centre to "
        "the sensors beside it, in the sensor's frame, and the distance of both centres. Orientations for --method ls are taken "
        "from the columns q1_w ... q3_z or computed.\n"
        "\n"
        "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is "
        "wrong; 1 anything else.",
};

chain_options_t chain_options(int argc, char **argv)
{
    chain_options_t options = {.config = jcal_chain_config_default()};
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &options);
    return options;
}

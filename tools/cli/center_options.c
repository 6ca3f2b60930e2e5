/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal center`. */
#include "center_options.h"

#include "option_values.h"

#include <argp.h>
#include <math.h>
#include <string.h>

/* Samples that the window engine keeps a second, about. */
#define ROWS_PER_S 50.0f

/* Keys of options without a short form. */
enum {
    KEY_METHOD = 256,
    KEY_DERIVATIVE,
    KEY_SMOOTHING,
    KEY_MIN_RATE,
    KEY_ACC_BIAS,
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
    {"method", KEY_METHOD, "NAME", 0,
     "What is minimised. ss (default): squared differences of the lengths of what both sensors feel at the joint; sa: absolute "
     "differences, which knocks disturb less; ls: squared differences of the vectors, which needs orientations",
     0},
    {"derivative", KEY_DERIVATIVE, "NAME", 0,
     "How angular accelerations are made: five-point (default), or symmetric as published by Olsson and Halvorsen 2017",
     0},
    {"smoothing", KEY_SMOOTHING, "S", 0,
     "Smooth both sides of the equation over S seconds, 0 to 2 (default 0.12): what skin and straps add is mostly faster than limbs are",
     0},
    {"min-rate", KEY_MIN_RATE, "RAD_S", 0,
     "Leave out samples in which both sensors turn slower than this; 1.2 as published (default 0: rest tells of biases)",
     0},
    {"acc-bias", KEY_ACC_BIAS, "M_S2", 0,
     "Standard deviation of the accelerometers' biases, which are estimated too with ss and sa (default 0.3); 0 takes them for none",
     0},
    {"calibration", KEY_CALIBRATION, "FILE", 0,
     "The joint is a hinge with these axes: output of 'jointcal hinge --json'. Its centre is then the point of the axis next to both "
     "sensors; along the axis nothing is claimed",
     0},
    {"engine", KEY_ENGINE, "NAME", 0,
     "How to compute. stream (default): sums of moments, constant memory. window: the last samples in a buffer, about 50 a second",
     0},
    {"n-max", KEY_N_MAX, "N", 0, "Samples in the window engine's buffer, 50 to 20000 (default 500)", 0},
    {"window", KEY_WINDOW, "S", 0,
     "Memory in seconds for what wanders, biases and heading: 10 to 3600 (default 300). With --engine window the length of its buffer: "
     "1 to 400 (default 10)",
     0},
    {"every", KEY_EVERY, "S", 0, "Report an estimate every S seconds of recording time", 0},
    {"max-bound", KEY_MAX_BOUND, "M", 0,
     "Ready when the centre is known to within M metres from both sensors with 95 % confidence (default 0.01)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", OPTION_HIDDEN, "", 0},
    {"json", KEY_JSON, NULL, 0, "Write JSON Lines instead of text", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* What the parser fills in, and what it must remember until all options are read. */
typedef struct {
    center_options_t options;
    float window_s;
    bool has_n_max;
    bool has_window;
} parse_t;

/* The buffer's length in samples, whichever way it was given. */
static void settle_window(struct argp_state *state, parse_t *parse)
{
    jcal_center_window_config_t *config = &parse->options.engine.config;
    if (parse->has_n_max && parse->has_window) {
        argp_error(state, "--n-max and --window both set the length of the buffer: give one of them");
    }
    if (parse->has_window) {
        if (!(parse->window_s >= 1.0f && parse->window_s <= 400.0f)) {
            argp_error(state, "--window: %g is not a number of seconds from 1 to 400", (double)parse->window_s);
        }
        config->n_max = (uint16_t)roundf(ROWS_PER_S * parse->window_s);
    }
}

static void check_config(struct argp_state *state, const center_engine_config_t *engine)
{
    const jcal_center_config_t *config = &engine->config.center;
    const char *field = jcal_center_config_check(config);
    if (field != NULL && strcmp(field, "memory_s") == 0) {
        argp_error(state, "--window: %g is not a number of seconds from 10 to 3600", (double)config->memory_s);
    } else if (field != NULL && strcmp(field, "max_bound_m") == 0) {
        argp_error(state, "--max-bound: %g metres are outside what makes sense, 0.001 to 0.1 m",
                   (double)config->max_bound_m);
    } else if (field != NULL && strcmp(field, "acc_bias_m_s2") == 0) {
        argp_error(state, "--acc-bias: %g is not a number from 0 to 2 m/s^2", (double)config->acc_bias_m_s2);
    } else if (field != NULL && strcmp(field, "smoothing_s") == 0) {
        argp_error(state, "--smoothing: %g is not a number of seconds from 0 to 2",
                   (double)config->kinematics.smoothing_s);
    } else if (field != NULL) {
        argp_error(state, "--min-rate: %g is not a number from 0 to 20 rad/s", (double)config->min_rate_rad_s);
    } else if (engine->kind == JCAL_ENGINE_WINDOW && jcal_center_window_config_check(&engine->config) != NULL) {
        argp_error(state, "--n-max: %d is not a number from 50 to 20000", (int)engine->config.n_max);
    }
}

/* Everything that can be judged only when all options are known. */
static void settle(struct argp_state *state, parse_t *parse)
{
    if (parse->options.common.recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (parse->options.engine.kind == JCAL_ENGINE_WINDOW) {
        settle_window(state, parse);
    } else if (parse->has_n_max) {
        argp_error(state, "--n-max goes with --engine window only: the stream engine keeps no samples");
    } else if (parse->has_window) {
        parse->options.engine.config.center.memory_s = parse->window_s;
    }
    check_config(state, &parse->options.engine);
}

/* Options that say what to compute. */
static error_t parse_values(int key, char *argument, struct argp_state *state)
{
    static const char *const methods[] = {"ss", "sa", "ls"};
    parse_t *parse = state->input;
    jcal_center_config_t *center = &parse->options.engine.config.center;
    switch (key) {
    case KEY_METHOD:
        center->method = (jcal_center_method_t)option_one_of_three(state, "method", argument, methods);
        return 0;
    case KEY_DERIVATIVE:
        center->kinematics.derivative =
            (jcal_derivative_t)option_one_of_two(state, "derivative", argument, "five-point", "symmetric");
        return 0;
    case KEY_SMOOTHING:
        center->kinematics.smoothing_s = option_not_negative(state, "smoothing", argument);
        return 0;
    case KEY_MIN_RATE:
        center->min_rate_rad_s = option_not_negative(state, "min-rate", argument);
        return 0;
    case KEY_ACC_BIAS:
        center->acc_bias_m_s2 = option_not_negative(state, "acc-bias", argument);
        return 0;
    case KEY_MAX_BOUND:
        center->max_bound_m = option_positive(state, "max-bound", argument);
        return 0;
    case KEY_CALIBRATION:
        parse->options.calibration = argument;
        return 0;
    case KEY_SIGN_HINT:
        argp_error(state, "--sign-hint is for a hinge: a joint centre has no sign");
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
    case KEY_ENGINE:
        parse->options.engine.kind = (jcal_engine_t)option_one_of_two(state, "engine", argument, "stream", "window");
        return 0;
    case KEY_N_MAX:
        parse->options.engine.config.n_max = option_sample_count(state, argument, 50, 20000);
        parse->has_n_max = true;
        return 0;
    case KEY_WINDOW:
        parse->window_s = 1e-6f * (float)option_duration(state, "window", argument);
        parse->has_window = true;
        return 0;
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
        "Finds where both sensors of a recording sit relative to the centre of the joint between them, from arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Results are the vectors from the joint's centre to each sensor, in that sensor's "
        "frame. Orientations for --method ls are taken or computed as for 'jointcal two-dof'.\n"
        "\n"
        "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is "
        "wrong; 1 anything else.",
};

center_options_t center_options(int argc, char **argv)
{
    parse_t parse = {.options.engine.config = jcal_center_window_config_default()};
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &parse);
    return parse.options;
}

/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal stream`. */
#include "stream_options.h"

#include "hub_link.h"
#include "option_values.h"

#include <string.h>

#define RAD_PER_DEG 0.0174532925f

/* Keys of options without a short form. */
enum {
    KEY_TO = 256,
    KEY_BAUD,
    KEY_SPEED,
    KEY_EVERY,
    KEY_TIMEOUT,
    KEY_MAX_BOUND,
    KEY_SIGN_HINT,
    KEY_COUNTERS,
    KEY_JSON
};

static const struct argp_option OPTIONS[] = {
    {"to", KEY_TO, "HUB", 0, "Where the hub is: unix:PATH, tcp:HOST:PORT, or a serial device like /dev/ttyACM0", 0},
    {"baud", KEY_BAUD, "RATE", 0, "Rate of a serial device, 9600 to 230400 (default 115200)", 0},
    {"speed", KEY_SPEED, "X", 0,
     "How fast: 1 (default) is real time, 10 ten times that, max as fast as the hub can take it", 0},
    {"every", KEY_EVERY, "S", 0, "Report an estimate every S seconds of recording time", 0},
    {"timeout", KEY_TIMEOUT, "S", 0, "Give up when the hub has been silent for S seconds (default 5)", 0},
    {"max-bound", KEY_MAX_BOUND, "DEG", 0,
     "Ready when both axes are known to within DEG degrees with 95 % confidence (default 3)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", 0,
     "What is known about the sign pairing. same: the largest components of both axes have the same sign; opposite: "
     "they have not",
     0},
    {"counters", KEY_COUNTERS, NULL, 0,
     "At the end, tell on standard error what became of the frames, even if none was lost or damaged", 0},
    {"json", KEY_JSON, NULL, 0, "Write JSON Lines, which is what this subcommand does anyway", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Everything that can be judged only when all options are known. */
static void check(struct argp_state *state, const stream_options_t *options)
{
    if (options->recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (options->target == NULL) {
        argp_error(state, "where is the hub? Give --to unix:PATH, --to tcp:HOST:PORT or --to /dev/NAME");
    }
    jcal_hinge_config_t config = jcal_hinge_config_default();
    config.max_bound_rad = options->max_bound_rad;
    if (jcal_hinge_config_check(&config) != NULL) {
        argp_error(state, "--max-bound: %g degrees are outside what makes sense, 0.06 to 28 degrees",
                   (double)(config.max_bound_rad / RAD_PER_DEG));
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    stream_options_t *options = state->input;
    switch (key) {
    case KEY_TO:
        options->target = argument;
        if (!hub_link_target_ok(argument)) {
            argp_error(state, "--to: '%s' is none of unix:PATH, tcp:HOST:PORT, /dev/NAME", argument);
        }
        return 0;
    case KEY_BAUD:
        options->baud = (unsigned long)option_positive(state, "baud", argument);
        return 0;
    case KEY_SPEED:
        options->speed = (strcmp(argument, "max") == 0) ? 0.0f : option_positive(state, "speed", argument);
        return 0;
    case KEY_EVERY:
        options->every_us = option_duration(state, "every", argument);
        return 0;
    case KEY_TIMEOUT:
        options->timeout_us = option_duration(state, "timeout", argument);
        return 0;
    case KEY_MAX_BOUND:
        options->max_bound_rad = option_positive(state, "max-bound", argument) * RAD_PER_DEG;
        return 0;
    case KEY_SIGN_HINT:
        options->sign_hint = (option_one_of_two(state, "sign-hint", argument, "same", "opposite") == 0)
                                 ? JCAL_SIGN_SAME
                                 : JCAL_SIGN_OPPOSITE;
        return 0;
    case KEY_COUNTERS:
        options->counters = true;
        return 0;
    case KEY_JSON:
        return 0;
    case ARGP_KEY_ARG:
        if (options->recording != NULL) {
            argp_error(state, "one recording at a time, and '%s' is a second one", argument);
        }
        options->recording = argument;
        return 0;
    case ARGP_KEY_END:
        check(state, options);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp PARSER = {
    .options = OPTIONS,
    .parser = parse_option,
    .args_doc = "RECORDING.csv --to HUB",
    .doc = "Plays a recording to a hub and writes the hub's estimates as JSON Lines.\v"
           "The recording and the lines are those of 'jointcal hinge --json'; as long as no frame is lost, so is every "
           "byte of the output.\n"
           "\n"
           "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is "
           "wrong; 1 anything else, such as a hub that does not answer.",
};

stream_options_t stream_options(int argc, char **argv)
{
    stream_options_t options = {.baud = 115200,
                                .speed = 1.0f,
                                .timeout_us = 5000000,
                                .max_bound_rad = jcal_hinge_config_default().max_bound_rad,
                                .sign_hint = JCAL_SIGN_UNKNOWN};
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &options);
    return options;
}

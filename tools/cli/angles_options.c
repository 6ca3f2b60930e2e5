/* SPDX-License-Identifier: MIT */
/* Command line of `jointcal angles`. */
#include "angles_options.h"

#include "number.h"
#include "option_values.h"

#include <argp.h>
#include <math.h>
#include <string.h>

#define RAD_PER_DEG 0.0174532925f

/* Keys of options without a short form. */
enum {
    KEY_JOINT = 256,
    KEY_OUT,
    KEY_CALIBRATION,
    KEY_ZERO,
    KEY_REFERENCE,
    KEY_SIGNS,
    KEY_TOWARD1,
    KEY_TOWARD2,
    KEY_POSITIVE,
    KEY_WINDOW,
    KEY_MAX_BOUND,
    KEY_SIGN_HINT
};

static const struct argp_option OPTIONS[] = {
    {"joint", KEY_JOINT, "KIND", 0, "hinge (flexion) or two-dof (flexion, pronation, carrying angle)", 0},
    {"out", KEY_OUT, "FILE", 0, "Write to FILE.csv, or to FILE.sto for OpenSim (default: CSV on standard output)", 0},
    {"calibration", KEY_CALIBRATION, "FILE", 0,
     "Axes from a line of --json output of 'jointcal hinge' or 'jointcal two-dof', the last one that is ready, instead "
     "of from this recording: angles then start where the heading is known",
     0},
    {"zero", KEY_ZERO, "WHERE", 0,
     "Pose with the reference angles. none (default): wherever the mounting of the sensors puts zero; first: first row "
     "with angles; a number: that time in s; range: smallest angles of the recording",
     0},
    {"reference", KEY_REFERENCE, "DEG[,DEG]", 0, "Flexion and pronation in that pose (default 0,0)", 0},
    {"signs", KEY_SIGNS, "HOW", 0,
     "axes (default): positive about the axes; range: so that the mean angles are positive, counted from full extension "
     "and supination, which --zero must name",
     0},
    {"axis1-toward", KEY_TOWARD1, "X,Y,Z", 0,
     "Axis 1 points about this way in the frame of sensor 1. ISB: to the person's right", 0},
    {"axis2-toward", KEY_TOWARD2, "X,Y,Z", 0,
     "Axis 2 points about this way in the frame of sensor 2. ISB: to the elbow on the right arm, away from it on the "
     "left",
     0},
    {"positive", KEY_POSITIVE, "WORDS", 0,
     "What counts as positive: flexion or extension, pronation or supination, with a comma between them (default "
     "flexion,pronation, as ISB has it)",
     0},
    {"window", KEY_WINDOW, "S", 0, "Memory in seconds for the heading, which drifts, 2 to 600 (default 10)", 0},
    {"max-bound", KEY_MAX_BOUND, "DEG", 0,
     "Ready when the calibration is known to within DEG degrees with 95 % confidence (default 3)", 0},
    {"sign-hint", KEY_SIGN_HINT, "SIGN", 0, "As of 'jointcal hinge': same or opposite", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

/* Numbers with commas between them; returns how many there are, 0 if it is no such list. */
static size_t list_of_numbers(const char *text, float *values, size_t most)
{
    size_t count = 0;
    char word[32];
    for (;;) {
        const size_t length = strcspn(text, ",");
        if (length >= sizeof word || count == most) {
            return 0;
        }
        memcpy(word, text, length);
        word[length] = '\0';
        if (number_to_float(word, &values[count]) != NUMBER_FINITE) {
            return 0;
        }
        count++;
        if (text[length] == '\0') {
            return count;
        }
        text += length + 1;
    }
}

static jcal_vec3_t direction(struct argp_state *state, const char *option, const char *text)
{
    float v[3] = {0.0f, 0.0f, 0.0f};
    if (list_of_numbers(text, v, 3) != 3 || (v[0] == 0.0f && v[1] == 0.0f && v[2] == 0.0f)) {
        argp_error(state, "--%s: '%s' is not a direction X,Y,Z", option, text);
    }
    return (jcal_vec3_t){v[0], v[1], v[2]};
}

static jcal_joint_angles_t reference(struct argp_state *state, const char *text)
{
    float v[2] = {0.0f, 0.0f};
    if (list_of_numbers(text, v, 2) == 0 || fabsf(v[0]) > 180.0f || fabsf(v[1]) > 180.0f) {
        argp_error(state, "--reference: '%s' is not one or two angles from -180 to 180 degrees", text);
    }
    return (jcal_joint_angles_t){v[0] * RAD_PER_DEG, v[1] * RAD_PER_DEG, 0.0f};
}

static void set_zero(struct argp_state *state, const char *text, angles_options_t *options)
{
    if (strcmp(text, "none") == 0) {
        options->zero = ZERO_NONE;
    } else if (strcmp(text, "first") == 0) {
        options->zero = ZERO_FIRST;
    } else if (strcmp(text, "range") == 0) {
        options->zero = ZERO_RANGE;
    } else if (number_to_us(text, &options->zero_us) == NUMBER_FINITE) {
        options->zero = ZERO_TIME;
    } else {
        argp_error(state, "--zero: '%s' is neither none, first, range nor a time in seconds", text);
    }
}

static jcal_positive_t positive(struct argp_state *state, const char *text)
{
    static const struct {
        const char *words;
        jcal_positive_t meaning;
    } names[] = {{"flexion", JCAL_POSITIVE_ISB},
                 {"pronation", JCAL_POSITIVE_ISB},
                 {"flexion,pronation", JCAL_POSITIVE_ISB},
                 {"supination", JCAL_POSITIVE_FLEXION_SUPINATION},
                 {"flexion,supination", JCAL_POSITIVE_FLEXION_SUPINATION},
                 {"extension", JCAL_POSITIVE_EXTENSION_PRONATION},
                 {"extension,pronation", JCAL_POSITIVE_EXTENSION_PRONATION},
                 {"extension,supination", JCAL_POSITIVE_EXTENSION_SUPINATION}};
    for (size_t k = 0; k < sizeof names / sizeof names[0]; k++) {
        if (strcmp(text, names[k].words) == 0) {
            return names[k].meaning;
        }
    }
    argp_error(state, "--positive: '%s' is not flexion or extension, a comma, pronation or supination", text);
    return JCAL_POSITIVE_ISB;
}

/* What the name of the file asks for. */
static bool is_storage(struct argp_state *state, const char *name)
{
    const size_t length = strlen(name);
    const char *end = (length > 4) ? name + length - 4 : "";
    if (strcmp(end, ".sto") != 0 && strcmp(end, ".csv") != 0) {
        argp_error(state, "--out: '%s' ends neither in .csv nor in .sto", name);
    }
    return strcmp(end, ".sto") == 0;
}

static void check_hinge(struct argp_state *state, const angles_options_t *options)
{
    if (options->hinge && options->has_toward2) {
        argp_error(state, "--axis2-toward does not go with --joint hinge: axis 2 follows axis 1");
    }
    if (options->hinge && options->reference.pronation_rad != 0.0f) {
        argp_error(state, "--reference: a hinge has one angle");
    }
    if (!options->hinge && options->sign_hint != JCAL_SIGN_UNKNOWN) {
        argp_error(state, "--sign-hint goes with --joint hinge only");
    }
}

/* Everything that can be judged only when all options are known. */
static void check(struct argp_state *state, const angles_options_t *options)
{
    if (options->recording == NULL) {
        argp_error(state, "which recording? Give a file name, or - for standard input");
    }
    if (!options->has_joint) {
        argp_error(state, "which joint? Give --joint hinge or --joint two-dof");
    }
    check_hinge(state, options);
    const bool has_reference = options->reference.flexion_rad != 0.0f || options->reference.pronation_rad != 0.0f;
    if (has_reference && options->zero == ZERO_NONE) {
        argp_error(state, "--reference needs --zero, which names the pose");
    }
    if (options->signs_by_range && options->zero != ZERO_FIRST && options->zero != ZERO_TIME) {
        argp_error(state, "--signs range needs --zero first or --zero TIME: angles count from that pose");
    }
    if (options->signs_by_range && (options->has_toward1 || options->has_toward2)) {
        argp_error(state, "--signs range does not go with --axis1-toward or --axis2-toward");
    }
    if (options->calibration != NULL && (options->max_bound_rad > 0.0f || options->sign_hint != JCAL_SIGN_UNKNOWN)) {
        argp_error(state, "--max-bound and --sign-hint do not go with --calibration");
    }
    if (options->max_bound_rad != 0.0f && (options->max_bound_rad < 0.001f || options->max_bound_rad > 0.5f)) {
        argp_error(state, "--max-bound: %g degrees are outside what makes sense, 0.06 to 28 degrees",
                   (double)(options->max_bound_rad / RAD_PER_DEG));
    }
    if (options->window_s != 0.0f && (options->window_s < 2.0f || options->window_s > 600.0f)) {
        argp_error(state, "--window: %g is not a number of seconds from 2 to 600", (double)options->window_s);
    }
}

static error_t parse_values(int key, char *argument, struct argp_state *state)
{
    angles_options_t *options = state->input;
    switch (key) {
    case KEY_REFERENCE:
        options->reference = reference(state, argument);
        return 0;
    case KEY_SIGNS:
        options->signs_by_range = option_one_of_two(state, "signs", argument, "axes", "range") == 1;
        return 0;
    case KEY_TOWARD1:
        options->toward1 = direction(state, "axis1-toward", argument);
        options->has_toward1 = true;
        return 0;
    case KEY_TOWARD2:
        options->toward2 = direction(state, "axis2-toward", argument);
        options->has_toward2 = true;
        return 0;
    case KEY_POSITIVE:
        options->positive = positive(state, argument);
        return 0;
    case KEY_WINDOW:
        options->window_s = option_positive(state, "window", argument);
        return 0;
    case KEY_MAX_BOUND:
        options->max_bound_rad = option_positive(state, "max-bound", argument) * RAD_PER_DEG;
        return 0;
    case KEY_SIGN_HINT:
        options->sign_hint = (option_one_of_two(state, "sign-hint", argument, "same", "opposite") == 0)
                                 ? JCAL_SIGN_SAME
                                 : JCAL_SIGN_OPPOSITE;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse_option(int key, char *argument, struct argp_state *state)
{
    angles_options_t *options = state->input;
    switch (key) {
    case KEY_JOINT:
        options->hinge = option_one_of_two(state, "joint", argument, "hinge", "two-dof") == 0;
        options->has_joint = true;
        return 0;
    case KEY_OUT:
        options->sto = is_storage(state, argument);
        options->out = argument;
        return 0;
    case KEY_CALIBRATION:
        options->calibration = argument;
        return 0;
    case KEY_ZERO:
        set_zero(state, argument, options);
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
        return parse_values(key, argument, state);
    }
}

static const struct argp PARSER = {
    .options = OPTIONS,
    .parser = parse_option,
    .args_doc = "RECORDING.csv --joint hinge|two-dof",
    .doc =
        "Computes the angles of a joint from a recording of arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Orientations are taken from the columns q1_w, q1_x, q1_y, q1_z, q2_w ... "
        "q2_z if they are there: unit quaternions that turn from the sensor's frame to an earth frame with z up, each with a "
        "heading of its own. Else the filter VQF finds them.\n"
        "\n"
        "Columns written: t_s, flexion_deg; with two axes also pronation_deg, carrying_deg, heading_offset_deg. There is "
        "a row for each row of the recording; its angles are empty while the calibration is not ready. A .sto file "
        "holds only rows with angles.\n"
        "\n"
        "Exit status: 0 angles at the end; 3 read to the end but without angles there; 2 the command line or a file "
        "is wrong; 1 anything else.",
};

angles_options_t angles_options(int argc, char **argv)
{
    angles_options_t options;
    memset(&options, 0, sizeof options);
    (void)argp_parse(&PARSER, argc, argv, 0, NULL, &options);
    return options;
}

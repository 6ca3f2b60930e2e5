/* SPDX-License-Identifier: MIT */
/* The command line of `jointcal angles`. */
#include "commands/angles_options.h"

#include "input/number.h"
#include "options/values.h"
#include "units.h"

#include <math.h>
#include <string.h>

enum {
    KEY_JOINT = OPTION_OWN,
    KEY_OUT,
    KEY_CALIBRATION,
    KEY_ZERO,
    KEY_REFERENCE,
    KEY_SIGNS,
    KEY_TOWARD1,
    KEY_TOWARD2,
    KEY_POSITIVE,
    KEY_ACCEPT,
    KEY_SEQUENCE,
    KEY_NAME /* and one more for each column */
};

static const struct argp_option OPTIONS[] = {
    {"joint", KEY_JOINT, "KIND", 0,
     "hinge (flexion), two-dof (flexion, pronation, carrying angle) or ball (hip or shoulder, see --sequence)", 0},
    {"sequence", KEY_SEQUENCE, "NAME", 0,
     "Angles of a ball joint, as ISB has them. hip (default): flexion, adduction, rotation, z-x'-y''; shoulder: plane of elevation, "
     "elevation, axial rotation, y-x'-y''. They count from the pose of --zero, in which the person stands upright",
     0},
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
    {"accept", KEY_ACCEPT, "WHAT", 0,
     "ready (default): rows have angles only while the calibration is ready; best: with the best estimate whatever its status, and a "
     "column bound_deg with how far its axes may be off",
     0},
    {"flexion-name", KEY_NAME + ANGLE_FLEXION, "NAME", 0,
     "Name of the column of flexion in a .sto file, like knee_angle_r (default flexion)", 0},
    {"pronation-name", KEY_NAME + ANGLE_PRONATION, "NAME", 0, "The same of pronation, like pro_sup_r", 0},
    {"carrying-name", KEY_NAME + ANGLE_CARRYING, "NAME", 0, "The same of the carrying angle", 0},
    {"heading-name", KEY_NAME + ANGLE_HEADING, "NAME", 0, "The same of the heading offset", 0},
    {"bound-name", KEY_NAME + ANGLE_BOUND, "NAME", 0, "The same of the bound, with --accept best", 0},
    {NULL, 0, NULL, 0, NULL, 0}};

static jcal_joint_angles_t reference(struct argp_state *state, const char *text)
{
    float v[2] = {0.0f, 0.0f};
    if (option_numbers(text, v, 2) == 0 || fabsf(v[0]) > 180.0f || fabsf(v[1]) > 180.0f) {
        argp_error(state, "--reference: '%s' is not one or two angles from -180 to 180 degrees", text);
    }
    return (jcal_joint_angles_t){v[0] * RAD_PER_DEG, v[1] * RAD_PER_DEG, 0.0f};
}

static void set_zero(struct argp_state *state, const char *text, angle_table_config_t *table)
{
    if (strcmp(text, "none") == 0) {
        table->zero = ZERO_NONE;
    } else if (strcmp(text, "first") == 0) {
        table->zero = ZERO_FIRST;
    } else if (strcmp(text, "range") == 0) {
        table->zero = ZERO_RANGE;
    } else if (number_to_us(text, &table->zero_us) == NUMBER_FINITE) {
        table->zero = ZERO_TIME;
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

/* Names of columns of a storage file, which is read by its tabs. */
static error_t parse_name(int key, char *argument, struct argp_state *state, angles_options_t *options)
{
    if (key < KEY_NAME || key >= KEY_NAME + (int)ANGLE_TABLE_COLUMNS) {
        return ARGP_ERR_UNKNOWN;
    }
    if (argument[0] == '\0' || strpbrk(argument, " \t\r\n,;\"") != NULL) {
        argp_error(state, "'%s' is no name of a column: it must be one word", argument);
    }
    options->table.names[key - KEY_NAME] = argument;
    return 0;
}

/* Options that say what the angles count from and what is positive. */
static error_t parse_table(int key, char *argument, struct argp_state *state, angles_options_t *options)
{
    switch (key) {
    case KEY_OUT:
        options->table.sto = is_storage(state, argument);
        options->table.out = argument;
        return 0;
    case KEY_ZERO:
        set_zero(state, argument, &options->table);
        return 0;
    case KEY_REFERENCE:
        options->table.reference = reference(state, argument);
        return 0;
    case KEY_SIGNS:
        options->table.signs_by_range = option_one_of_two(state, "signs", argument, "axes", "range") == 1;
        return 0;
    case KEY_POSITIVE:
        options->table.positive = positive(state, argument);
        return 0;
    case KEY_ACCEPT:
        options->source.accept_best = option_one_of_two(state, "accept", argument, "ready", "best") == 1;
        options->table.has_bound = options->source.accept_best;
        return 0;
    default:
        return parse_name(key, argument, state, options);
    }
}

static void set_joint(struct argp_state *state, const char *text, angles_options_t *options)
{
    static const char *const kinds[] = {"hinge", "two-dof", "ball"};
    const int kind = option_one_of_three(state, "joint", text, kinds);
    options->source.hinge = kind == 0;
    options->source.ball = kind == 2;
    options->table.hinge = options->source.hinge;
    options->table.ball = options->source.ball;
    options->has_joint = true;
}

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    angles_options_t *options = self;
    switch (key) {
    case KEY_JOINT:
        set_joint(state, argument, options);
        return 0;
    case KEY_SEQUENCE:
        options->source.shoulder = option_one_of_two(state, "sequence", argument, "hip", "shoulder") == 1;
        options->table.shoulder = options->source.shoulder;
        options->has_sequence = true;
        return 0;
    case KEY_CALIBRATION:
        options->calibration = argument;
        return 0;
    case KEY_TOWARD1:
        options->source.toward1 = option_direction(state, "axis1-toward", argument);
        options->source.has_toward1 = true;
        return 0;
    case KEY_TOWARD2:
        options->source.toward2 = option_direction(state, "axis2-toward", argument);
        options->source.has_toward2 = true;
        return 0;
    default:
        return parse_table(key, argument, state, options);
    }
}

static void check_hinge(struct argp_state *state, const angles_options_t *options)
{
    if (options->source.hinge && options->source.has_toward2) {
        argp_error(state, "--axis2-toward does not go with --joint hinge: axis 2 follows axis 1");
    }
    if (options->source.hinge && options->table.reference.pronation_rad != 0.0f) {
        argp_error(state, "--reference: a hinge has one angle");
    }
    if (!options->source.hinge && options->source.sign_hint != JCAL_SIGN_UNKNOWN) {
        argp_error(state, "--sign-hint goes with --joint hinge only");
    }
}

/* A ball joint has no axes: a pose and the person's right take their place. */
static void check_ball(struct argp_state *state, angles_options_t *options)
{
    angle_source_config_t *source = &options->source;
    angle_table_config_t *table = &options->table;
    if (!source->ball) {
        if (options->has_sequence) {
            argp_error(state, "--sequence goes with --joint ball only");
        }
        return;
    }
    if (!source->has_toward1) {
        argp_error(
            state,
            "--joint ball needs --axis1-toward X,Y,Z: about where the person's right is in the frame of sensor 1");
    }
    if (source->has_toward2 || options->calibration != NULL || table->zero == ZERO_RANGE || table->signs_by_range ||
        source->window_s > 0.0f) {
        argp_error(
            state,
            "--axis2-toward, --calibration, --zero range, --signs range and --window do not go with --joint ball");
    }
    source->has_pose_time = table->zero == ZERO_TIME;
    source->pose_us = table->zero_us;
    table->zero = ZERO_NONE; /* angles come counted from the pose */
}

static void check_names(struct argp_state *state, const angle_table_config_t *table)
{
    bool named = false;
    for (int k = 0; k < ANGLE_TABLE_COLUMNS; k++) {
        named = named || table->names[k] != NULL;
    }
    if (named && !table->sto) {
        argp_error(state, "--flexion-name and its like go with --out FILE.sto: the columns of CSV have fixed names");
    }
}

static void check_table(struct argp_state *state, const angles_options_t *options)
{
    const angle_table_config_t *table = &options->table;
    const bool has_reference = table->reference.flexion_rad != 0.0f || table->reference.pronation_rad != 0.0f;
    if (has_reference && table->zero == ZERO_NONE) {
        argp_error(state, "--reference needs --zero, which names the pose");
    }
    if (table->signs_by_range && table->zero != ZERO_FIRST && table->zero != ZERO_TIME) {
        argp_error(state, "--signs range needs --zero first or --zero TIME: angles count from that pose");
    }
    if (table->signs_by_range && (options->source.has_toward1 || options->source.has_toward2)) {
        argp_error(state, "--signs range does not go with --axis1-toward or --axis2-toward");
    }
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    angles_options_t *options = self;
    angle_source_config_t *source = &options->source;
    source->window_s = common->window_s;
    source->max_bound_rad = common->max_bound;
    source->sign_hint = common->sign_hint;
    if (!options->has_joint) {
        argp_error(state, "which joint? Give --joint hinge, --joint two-dof or --joint ball");
    }
    check_hinge(state, options);
    check_ball(state, options);
    check_table(state, options);
    check_names(state, &options->table);
    if (options->calibration != NULL && source->accept_best) {
        argp_error(state, "--accept best does not go with --calibration, whose axes are ready");
    }
    if (options->calibration != NULL && (source->max_bound_rad > 0.0f || source->sign_hint != JCAL_SIGN_UNKNOWN)) {
        argp_error(state, "--max-bound and --sign-hint do not go with --calibration");
    }
    jcal_two_dof_config_t config = jcal_two_dof_config_default(); /* a hinge has the same limits */
    config.memory_s = (source->window_s > 0.0f) ? source->window_s : config.memory_s;
    config.max_bound_rad = (source->max_bound_rad > 0.0f) ? source->max_bound_rad : config.max_bound_rad;
    const common_limit_t limits[] = {
        {"memory_s", "window", config.memory_s, "a number of seconds from 2 to 600"},
        {"max_bound_rad", "max-bound", config.max_bound_rad / RAD_PER_DEG, "a number of degrees from 0.06 to 28"}};
    common_check(state, jcal_two_dof_config_check(&config), limits, sizeof limits / sizeof limits[0]);
}

const command_line_t ANGLES_LINE = {
    .args_doc = "RECORDING.csv --joint hinge|two-dof|ball\nSENSOR1.csv SENSOR2.csv --joint hinge|two-dof|ball",
    .two_files = true,
    .doc =
        "Computes the angles of a joint from a recording of arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Orientations are taken from the columns q1_w, q1_x, q1_y, q1_z, q2_w ... "
        "q2_z if they are there: unit quaternions that turn from the sensor's frame to an earth frame with z up, each with a "
        "heading of its own. Else the filter VQF finds them.\n"
        "\n"
        "Columns written: t_s, flexion_deg; with two axes also pronation_deg, carrying_deg, heading_offset_deg; of a ball joint "
        "flexion_deg, rotation_deg, adduction_deg or elevation_deg, axial_rotation_deg, plane_of_elevation_deg, and heading_offset_deg. There is "
        "a row for each row of the recording; its angles are empty while the calibration is not ready. Flexion and pronation go on beyond "
        "180 degrees instead of jumping by 360. A .sto file "
        "holds only rows with angles.\n"
        "\n" COMMON_TWO_FILES
        "Exit status: 0 angles at the end; 3 read to the end but without angles there; 2 the command line or a file "
        "is wrong; 1 anything else.",
    .offers = {[COMMON_WINDOW] = {.help = "Memory in seconds for the heading, which drifts, 2 to 600 (default 10)"},
               [COMMON_MAX_BOUND] =
                   {.help =
                        "Ready when the calibration is known to within DEG degrees with 95 % confidence (default 3)"},
               [COMMON_SORT] = {.help = COMMON_SORT_HELP},
               [COMMON_LAG] = {.help = COMMON_LAG_HELP},
               [COMMON_SIGN_HINT] = {.help = "As of 'jointcal hinge': same or opposite"}},
    .bound_unit = BOUND_IN_DEG,
    .own = OPTIONS,
    .parse = parse,
    .settle = settle,
};

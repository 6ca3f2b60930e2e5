/* SPDX-License-Identifier: MIT */
/* `jointcal ball`: its options, what it writes. */
#include "commands/ball.h"

#include "commands/commands.h"
#include "options/values.h"
#include "run/calibrate.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <math.h>

/* ---- Options ---- */

enum { KEY_MAX_LEVER = OPTION_OWN };

static const struct argp_option OPTIONS[] = {
    {"max-lever", KEY_MAX_LEVER, "M", 0,
     "The joint's centre is known from a sensor when its place is known to within M metres with 95 % confidence (default 0.06)",
     0},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    jcal_ball_config_t *config = self;
    if (key != KEY_MAX_LEVER) {
        return ARGP_ERR_UNKNOWN;
    }
    config->max_lever_m = option_positive(state, "max-lever", argument);
    return 0;
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    jcal_ball_config_t *config = self;
    config->max_heading_rad = (common->max_bound > 0.0f) ? common->max_bound : config->max_heading_rad;
    common->max_bound = config->max_heading_rad;
    const common_limit_t limits[] = {
        {"max_heading_rad", "max-bound", common->max_bound / RAD_PER_DEG, "a number of degrees from 0.6 to 57"},
        {"max_lever_m", "max-lever", config->max_lever_m, "a number of metres from 0.001 to 1"}};
    common_check(state, jcal_ball_config_check(config), limits, sizeof limits / sizeof limits[0]);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv\nSENSOR1.csv SENSOR2.csv",
    .two_files = true,
    .doc =
        "Finds how the two sensors of a person's ball joint, such as hip or shoulder, stand to each other, and where the joint's centre "
        "is, from arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Ready means that the heading offset between the two sensors is known, and with it the "
        "orientation of one segment in the other, without drift. The joint's centre is told for each sensor with a bound of its own: a "
        "pelvis that hardly turns leaves it open, and the rest is told. No axes are needed; 'jointcal angles --joint ball' writes angles.\n"
        "\n"
        "The heading offset turns vectors from the level frame of sensor 2 to that of sensor 1, about z.\n"
        "\n" COMMON_TWO_FILES COMMON_EXIT_HELP COMMON_PICTURE,
    .offers =
        {[COMMON_ENGINE] = {.help = "How to compute: stream (default). A ball joint has no other engine",
                            .refusal = "--engine window: a ball joint has the stream engine only"},
         [COMMON_N_MAX] = {.refusal = "--n-max goes with --engine window, which a ball joint does not have"},
         [COMMON_WINDOW] = {.refusal = "--window: the memory of a ball joint's heading is fixed, 10 s"},
         [COMMON_EVERY] = {.help = COMMON_EVERY_HELP},
         [COMMON_MAX_BOUND] =
             {.help = "Ready when the heading offset is known to within DEG degrees with 95 % confidence (default 15)"},
         [COMMON_SIGN_HINT] = {.refusal = "--sign-hint is for a hinge: a ball joint has no axes"},
         [COMMON_AXIS1_TOWARD] = {.refusal = "--axis1-toward is for axes: a ball joint has none"},
         [COMMON_JSON] = {.help = COMMON_JSON_HELP},
         [COMMON_SORT] = {.help = COMMON_SORT_HELP},
         [COMMON_LAG] = {.help = COMMON_LAG_HELP}},
    .bound_unit = BOUND_IN_DEG,
    .own = OPTIONS,
    .parse = parse,
    .settle = settle,
};

/* ---- The engine ---- */

typedef struct {
    calibrate_state_t base;
    jcal_ball_pair_t joint;
    jcal_ball_result_t result;
} ball_run_t;

static bool start(void *self, const void *options)
{
    ball_run_t *run = self;
    return jcal_ball_pair_init(&run->joint, options, NULL) == JCAL_OK;
}

static bool push(void *self, const recording_row_t *row, uint64_t t_us)
{
    const jcal_pair_t pair = {t_us, row->imu1, row->imu2};
    return jcal_ball_pair_update(&((ball_run_t *)self)->joint, &pair) >= JCAL_OK;
}

static const jcal_head_t *get(void *self)
{
    ball_run_t *run = self;
    (void)jcal_ball_pair_get(&run->joint, &run->result); /* the only error is a null pointer */
    return &run->result.head;
}

/* ---- What is written ---- */

const report_words_t BALL_WORDS = {
    .name = "Ball joint",
    .misfit = "no joint explains the data: sensors that share none",
    .ambiguous = "another heading explains the data about equally",
    .move_joint = "turn both segments, briskly, so that the joint between them moves too",
    .asked_for = "the heading",
    .bounded = "heading",
    .unit = "deg",
    .per_unit = DEG_PER_RAD,
    .unknown = BOUND_UNKNOWN_RAD,
};

static report_bounds_t bounds(const void *self)
{
    const jcal_ball_result_t *result = &((const ball_run_t *)self)->result;
    return (report_bounds_t){result->has_estimate, result->uncertainty_heading_rad, result->uncertainty_heading_rad};
}

static bool is_known(const jcal_ball_result_t *result)
{
    return result->uncertainty_heading_rad < BOUND_UNKNOWN_RAD;
}

static float or_nan(float bound_m)
{
    return (bound_m < JCAL_BOUND_UNKNOWN_M) ? bound_m : NAN;
}

static void write_json(const void *self, json_t *json)
{
    const jcal_ball_result_t *result = &((const ball_run_t *)self)->result;
    const bool ready = result->head.status == JCAL_READY;
    const bool both = result->for_center1 && result->for_center2;
    const float bounds_m[2] = {or_nan(result->uncertainty1_m), or_nan(result->uncertainty2_m)};
    json_number(json, "heading_offset_deg", result->heading.known ? DEG_PER_RAD * result->heading.heading_rad : NAN);
    json_number(json, "uncertainty_heading_deg",
                is_known(result) ? DEG_PER_RAD * result->uncertainty_heading_rad : NAN);
    report_json_vector(json, "joint_to_sensor1_m", result->has_estimate, result->joint_to_sensor1_m);
    report_json_vector(json, "joint_to_sensor2_m", result->has_estimate, result->joint_to_sensor2_m);
    json_numbers(json, "uncertainty_m", is_known(result), bounds_m, 2);
    json_bool(json, "center1_known", result->for_center1);
    json_bool(json, "center2_known", result->for_center2);
    json_word(json, "ready_for", ready ? (both ? "orientation_and_center" : "orientation") : NULL);
    report_json_lag(json, &((const ball_run_t *)self)->base.lag);
}

static void print_known(FILE *file, const char *label, bool known)
{
    report_print_words(file, label, known ? "known" : "not known well enough");
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const jcal_ball_result_t *result = &((const ball_run_t *)self)->result;
    report_print_head(file, report);
    if (result->heading.known && is_known(result)) {
        (void)fprintf(file, "  %-18s %8.1f deg   to within %.1f deg\n", "heading offset",
                      (double)(DEG_PER_RAD * result->heading.heading_rad),
                      (double)(DEG_PER_RAD * result->uncertainty_heading_rad));
    } else {
        report_print_words(file, "heading offset", "unknown");
    }
    if (result->has_estimate) {
        report_print_place(file, "joint to sensor 1", result->joint_to_sensor1_m, result->uncertainty1_m);
        report_print_place(file, "joint to sensor 2", result->joint_to_sensor2_m, result->uncertainty2_m);
        print_known(file, "centre, sensor 1", result->for_center1);
        print_known(file, "centre, sensor 2", result->for_center2);
        (void)fprintf(file, "  %-18s at %.2f m/s rms, 0.4 to 3 Hz\n", "the centre moved", (double)result->speed_m_s);
    }
    report_print_state(file, report);
    report_print_exit(file, report);
}

/* ---- The command ---- */

static const calibrate_joint_t BALL = {.words = &BALL_WORDS,
                                       .uses_readings = true,
                                       .size = sizeof(ball_run_t),
                                       .start = start,
                                       .push = push,
                                       .get = get,
                                       .bounds = bounds,
                                       .write_json = write_json,
                                       .print_summary = print_summary};

int ball_command(int argc, char **argv)
{
    common_options_t common = {0};
    jcal_ball_config_t config = jcal_ball_config_default();
    common_parse(&LINE, argc, argv, &common, &config);
    return (int)calibrate(&common, &BALL, &config);
}

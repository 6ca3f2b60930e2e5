/* SPDX-License-Identifier: MIT */
/* `jointcal hinge`: its options, its engines, what it writes. */
#include "commands/hinge.h"

#include "commands/commands.h"
#include "options/values.h"
#include "run/calibrate.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <math.h>
#include <stdlib.h>

/* ---- Options ---- */

/* The config of the window engine, whose `hinge` part serves both, and what only the stream engine knows. */
typedef struct {
    jcal_hinge_window_config_t config;
    float max_flexion_rad;
    jcal_gyr_grade_t grade;
} hinge_options_t;

enum { KEY_MAX_FLEXION = OPTION_OWN, KEY_GYROSCOPE };

static const struct argp_option OPTIONS[] = {
    {"gyroscope", KEY_GYROSCOPE, "GRADE", 0,
     "How well the gyroscopes are known. calibrated (default): scale to 0.2 %, axes to 0.1 deg. as-it-comes: a MEMS chip as it is sold, "
     "2 % and 1 deg; bounds allow for it, and ready takes about twice as long",
     0},
    {"max-flexion", KEY_MAX_FLEXION, "DEG", 0,
     "Ready, too, when the axes put the joint's angle wrong by at most DEG degrees rms (default 3): what a person's joint allows. Not "
     "with --engine window",
     0},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    hinge_options_t *options = self;
    if (key == KEY_GYROSCOPE) {
        const int grade = option_one_of_two(state, "gyroscope", argument, "calibrated", "as-it-comes");
        options->grade = (grade == 0) ? JCAL_GYR_CALIBRATED : JCAL_GYR_AS_IT_COMES;
        return 0;
    }
    if (key != KEY_MAX_FLEXION) {
        return ARGP_ERR_UNKNOWN;
    }
    options->max_flexion_rad = option_positive(state, "max-flexion", argument) * RAD_PER_DEG;
    return 0;
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    hinge_options_t *options = self;
    jcal_hinge_window_config_t *config = &options->config;
    if (options->max_flexion_rad > 0.0f && common->engine == JCAL_ENGINE_WINDOW) {
        argp_error(state, "--max-flexion does not go with --engine window, which knows rigid segments only");
    }
    if (!(options->max_flexion_rad > 0.0f)) {
        options->max_flexion_rad = jcal_hinge_auto_config_default().max_flexion_rad;
    }
    if (common->window_s > 0.0f && common->engine == JCAL_ENGINE_WINDOW) {
        argp_error(state, "--window does not go with --engine window here: its buffer counts samples, see --n-max");
    }
    config->n_max = (common->n_max > 0) ? common->n_max : config->n_max;
    config->hinge.max_bound_rad = (common->max_bound > 0.0f) ? common->max_bound : config->hinge.max_bound_rad;
    config->hinge.sign_hint = common->sign_hint;
    config->hinge.axis1_toward = common->axis1_toward;
    common->max_bound = config->hinge.max_bound_rad;
    if (jcal_hinge_config_set_gyroscope(&config->hinge, options->grade) != JCAL_OK) {
        argp_error(state, "--gyroscope: this is a mistake in the program");
    }
    const common_limit_t limits[] = {
        {"max_bound_rad", "max-bound", common->max_bound / RAD_PER_DEG, "a number of degrees from 0.06 to 28"},
        {"n_max", "n-max", (float)config->n_max, "a number from 20 to 10000"},
        {"max_flexion_rad", "max-flexion", options->max_flexion_rad / RAD_PER_DEG,
         "a number of degrees from 0.06 to 28"}};
    const jcal_hinge_auto_config_t both = {config->hinge, options->max_flexion_rad};
    const char *wrong = jcal_hinge_window_config_check(config);
    common_check(state, (wrong != NULL) ? wrong : jcal_hinge_auto_config_check(&both), limits,
                 sizeof limits / sizeof limits[0]);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv\nSENSOR1.csv SENSOR2.csv",
    .two_files = true,
    .doc =
        "Finds both axes of a hinge joint from a recording of arbitrary motion.\v"
        "The recording is CSV with one header line; the columns t_s (s), gyr1_x, gyr1_y, gyr1_z, gyr2_x ... (rad/s) "
        "and acc1_x ... acc2_z (m/s^2) may stand in any order among others. Sensor 1 sits on the proximal segment, "
        "sensor 2 on the distal one. - reads standard input.\n"
        "\n"
        "On rigid segments the axes are exact (model rigid). On a person skin moves with the sensors: then the axes that explain most of "
        "the bending are found (model functional), and ready may mean ready for flexion only.\n"
        "\n" COMMON_TWO_FILES COMMON_EXIT_HELP COMMON_PICTURE,
    .offers =
        {[COMMON_ENGINE] =
             {.help = "How to compute. stream (default): sums of moments, remembers everything, constant memory. "
                      "window: selected samples in a buffer, as published by Olsson et al. 2020"},
         [COMMON_N_MAX] = {.help = "Samples in the window engine's buffer, 20 to 10000 (default 500)"},
         [COMMON_WINDOW] =
             {.help = "Memory in seconds for what drifts. Accepted for all joints; a hinge has nothing that drifts, so "
                      "it changes nothing here. Not with --engine window, whose buffer counts samples (--n-max)"},
         [COMMON_EVERY] = {.help = COMMON_EVERY_HELP},
         [COMMON_MAX_BOUND] =
             {.help = "Ready when both axes are known to within DEG degrees with 95 % confidence (default 3)"},
         [COMMON_SIGN_HINT] = {.help = COMMON_SIGN_HELP},
         [COMMON_AXIS1_TOWARD] = {.help = COMMON_TOWARD_HELP},
         [COMMON_JSON] = {.help = COMMON_JSON_HELP},
         [COMMON_SORT] = {.help = COMMON_SORT_HELP},
         [COMMON_LAG] = {.help = COMMON_LAG_HELP}},
    .n_max_least = 20,
    .n_max_most = 10000,
    .bound_unit = BOUND_IN_DEG,
    .own = OPTIONS,
    .parse = parse,
    .settle = settle,
};

/* ---- Engines ---- */

typedef struct {
    calibrate_state_t base;
    union {
        jcal_hinge_auto_t stream;
        jcal_hinge_window_t window;
    } engine;
    jcal_hinge_auto_result_t result;
} hinge_run_t;

static bool start(void *self, const void *options)
{
    hinge_run_t *run = self;
    const hinge_options_t *given = options;
    const jcal_hinge_window_config_t *config = &given->config;
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        const jcal_hinge_auto_config_t both = {config->hinge, given->max_flexion_rad};
        return jcal_hinge_auto_init(&run->engine.stream, &both) == JCAL_OK;
    }
    const size_t bytes = jcal_hinge_window_storage_bytes(config);
    run->base.storage = malloc(bytes);
    return run->base.storage != NULL &&
           jcal_hinge_window_init(&run->engine.window, config, run->base.storage, bytes) == JCAL_OK;
}

static bool push(void *self, const recording_row_t *row, uint64_t t_us)
{
    hinge_run_t *run = self;
    const jcal_pair_t pair = {t_us, row->imu1, row->imu2};
    return ((run->base.engine == JCAL_ENGINE_STREAM) ? jcal_hinge_auto_update(&run->engine.stream, &pair)
                                                     : jcal_hinge_window_update(&run->engine.window, &pair)) >= JCAL_OK;
}

jcal_hinge_auto_result_t hinge_of_rigid(const jcal_hinge_result_t *hinge)
{
    return (jcal_hinge_auto_result_t){
        .hinge = *hinge,
        .ready_for = (hinge->head.status == JCAL_READY) ? JCAL_FOR_AXES : JCAL_FOR_NOTHING,
        .flexion_uncertainty_rad = BOUND_UNKNOWN_RAD,
    };
}

static const jcal_head_t *get(void *self)
{
    hinge_run_t *run = self;
    jcal_hinge_auto_result_t *result = &run->result;
    /* The only error is a null pointer. */
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        (void)jcal_hinge_auto_get(&run->engine.stream, result);
    } else {
        jcal_hinge_result_t hinge;
        (void)jcal_hinge_window_get(&run->engine.window, &hinge);
        *result = hinge_of_rigid(&hinge);
    }
    return &result->hinge.head;
}

/* ---- What is written ---- */

const report_words_t HINGE_WORDS = {
    .name = "Hinge",
    .misfit =
        "no hinge explains the data: another kind of joint (of an elbow 'jointcal two-dof' finds both axes), or sensors that share none",
    .ambiguous = "other axes explain the data about equally",
    .move_joint = "bend and stretch the joint",
    .moved = "the joint began to move about a second axis: of a forearm that turns 'jointcal two-dof' finds both",
    .asked_for = "both axes",
    .bounded = "axes",
    .unit = "deg",
    .per_unit = DEG_PER_RAD,
    .unknown = BOUND_UNKNOWN_RAD,
};

static report_axes_t axes_of(const jcal_hinge_result_t *result)
{
    return (report_axes_t){result->has_axes, result->axis1, result->axis2, result->uncertainty1_rad,
                           result->uncertainty2_rad};
}

static report_axes_t axes(const void *self)
{
    return axes_of(&((const hinge_run_t *)self)->result.hinge);
}

void hinge_write_keys(json_t *json, const jcal_hinge_auto_result_t *result, const report_lag_t *lag)
{
    const jcal_hinge_result_t *hinge = &result->hinge;
    const report_axes_t found = axes_of(hinge);
    const bool known = result->flexion_uncertainty_rad < BOUND_UNKNOWN_RAD;
    const float bounds[2] = {NAN, NAN};
    report_json_axes(json, &found);
    json_number(json, "sign_margin", (hinge->sign_margin > 0.0f) ? hinge->sign_margin : NAN);
    json_word(json, "model", hinge->has_axes ? jcal_model_string(result->model) : NULL);
    json_word(json, "ready_for", jcal_ready_for_string(result->ready_for));
    json_number(json, "flexion_uncertainty_deg", known ? DEG_PER_RAD * result->flexion_uncertainty_rad : NAN);
    json_number(json, "heading_offset_deg", result->heading.known ? DEG_PER_RAD * result->heading.heading_rad : NAN);
    report_json_vector(json, "joint_to_sensor1_m", result->has_levers, result->joint_to_sensor1_m);
    report_json_vector(json, "joint_to_sensor2_m", result->has_levers, result->joint_to_sensor2_m);
    json_numbers(json, "uncertainty_m", false, bounds, 2); /* of a hinge's centre nobody knows how far it is off yet */
    report_json_lag(json, lag);
    if (hinge->head.engine == JCAL_ENGINE_WINDOW) {
        json_bool(json, "paper_accepted", hinge->paper_accepted);
    }
}

static void write_json(const void *self, json_t *json)
{
    const hinge_run_t *run = self;
    hinge_write_keys(json, &run->result, &run->base.lag);
}

static void print_pairing(FILE *file, float margin)
{
    if (margin > 0.0f) {
        (void)fprintf(file, "  %-18s the other one explains the data %.3g times worse\n", "sign pairing",
                      (double)margin);
    } else {
        report_print_words(file, "sign pairing", "unknown");
    }
}

/* Which model the axes are of, and what they are good for. */
static void print_use(FILE *file, const jcal_hinge_auto_result_t *result)
{
    if (result->model != JCAL_MODEL_FUNCTIONAL) {
        return;
    }
    report_print_words(
        file, "model",
        "functional: the segments are not rigid, as on a person; these are the axes that explain most of this motion");
    if (result->bend_rad > 0.0f) {
        (void)fprintf(file, "  %-18s by %.0f deg rms about its mean\n", "the joint bent",
                      (double)(DEG_PER_RAD * result->bend_rad));
    }
    if (result->flexion_uncertainty_rad < BOUND_UNKNOWN_RAD) {
        (void)fprintf(file, "  %-18s %.1f deg rms is what these axes make wrong in it\n", "flexion",
                      (double)(DEG_PER_RAD * result->flexion_uncertainty_rad));
    }
    if (result->ready_for == JCAL_FOR_FLEXION) {
        report_print_words(
            file, "good for",
            "flexion: 'jointcal angles --joint hinge' writes it; not for what needs the axes themselves");
    }
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const hinge_run_t *run = self;
    const report_axes_t found = axes(self);
    report_print_head(file, report);
    report_print_axes(file, &found);
    print_use(file, &run->result);
    print_pairing(file, run->result.hinge.sign_margin);
    report_print_state(file, report);
    if (run->base.engine == JCAL_ENGINE_WINDOW) {
        report_print_words(file, "paper's test", run->result.hinge.paper_accepted ? "accepted" : "not accepted");
    }
    report_print_exit(file, report);
}

/* ---- The command ---- */

static const calibrate_joint_t HINGE = {.words = &HINGE_WORDS,
                                        .uses_readings = true,
                                        .size = sizeof(hinge_run_t),
                                        .start = start,
                                        .push = push,
                                        .get = get,
                                        .axes = axes,
                                        .write_json = write_json,
                                        .print_summary = print_summary};

int hinge_command(int argc, char **argv)
{
    common_options_t common = {0};
    hinge_options_t options = {.config = jcal_hinge_window_config_default()};
    common_parse(&LINE, argc, argv, &common, &options);
    return (int)calibrate(&common, &HINGE, &options);
}

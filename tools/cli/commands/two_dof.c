/* SPDX-License-Identifier: MIT */
/* `jointcal two-dof`: its options, its engines, what it writes. */
#include "commands/two_dof.h"

#include "commands/commands.h"
#include "options/values.h"
#include "run/calibrate.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <math.h>
#include <stdlib.h>

/* Samples that the window engine keeps a second. */
#define ROWS_PER_S 20.0f

/* The least limit of a person's axes and heading, rad: no bound of theirs comes near it. */
#define PEOPLE_LEAST_RAD 0.01f

/* ---- Options ---- */

enum { KEY_CONSTRAINT = OPTION_OWN };

typedef struct {
    jcal_two_dof_window_config_t config; /* of the window engine, whose `two_dof` part serves both */
    jcal_two_axes_config_t people;
    bool has_constraint;
} two_dof_options_t;

static const struct argp_option OPTIONS[] = {
    {"constraint", KEY_CONSTRAINT, "NAME", 0,
     "What is known of the joint. rotation: its segments do not turn against each other about the third axis; orientation: "
     "the angle between its axes does not change; combined: both (default, but rotation with --engine window, which has no "
     "combined)",
     0},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    /* As the library numbers them. */
    static const char *const constraints[] = {
        [JCAL_CONSTRAINT_COMBINED] = "combined",
        [JCAL_CONSTRAINT_ROTATION] = "rotation",
        [JCAL_CONSTRAINT_ORIENTATION] = "orientation",
    };
    two_dof_options_t *options = self;
    if (key != KEY_CONSTRAINT) {
        return ARGP_ERR_UNKNOWN;
    }
    options->config.two_dof.constraint =
        (jcal_constraint_t)option_one_of_three(state, "constraint", argument, constraints);
    options->has_constraint = true;
    return 0;
}

/* The buffer's length in samples, whichever way it was given. */
static void settle_window(struct argp_state *state, const common_options_t *common, two_dof_options_t *options)
{
    jcal_two_dof_window_config_t *config = &options->config;
    if (!options->has_constraint) {
        config->two_dof.constraint = JCAL_CONSTRAINT_ROTATION;
    }
    if (config->two_dof.constraint == JCAL_CONSTRAINT_COMBINED) {
        argp_error(state, "--constraint combined goes with --engine stream only: choose rotation or orientation");
    }
    if (common->n_max > 0 && common->window_s > 0.0f) {
        argp_error(state, "--n-max and --window both set the length of the buffer: give one of them");
    }
    if (common->window_s > 0.0f) {
        const float samples = roundf(ROWS_PER_S * common->window_s);
        if (samples < 20.0f || samples > 10000.0f) {
            argp_error(state, "--window: %g is not a number of seconds from 1 to 500", (double)common->window_s);
        }
        config->n_max = (uint16_t)samples;
    }
    config->n_max = (common->n_max > 0) ? common->n_max : config->n_max;
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    two_dof_options_t *options = self;
    jcal_two_dof_config_t *config = &options->config.two_dof;
    if (common->engine == JCAL_ENGINE_WINDOW) {
        settle_window(state, common, options);
    } else if (common->window_s > 0.0f) {
        config->memory_s = common->window_s;
    }
    config->axis1_toward = common->axis1_toward;
    options->people.axis1_toward = common->axis1_toward;
    if (common->max_bound > 0.0f) { /* what is asked for is asked of both models */
        options->people.max_bound_rad = fmaxf(common->max_bound, PEOPLE_LEAST_RAD);
        options->people.ball.max_heading_rad = fmaxf(common->max_bound, PEOPLE_LEAST_RAD);
    }
    config->max_bound_rad = (common->max_bound > 0.0f) ? common->max_bound : config->max_bound_rad;
    common->max_bound = config->max_bound_rad;
    const common_limit_t limits[] = {
        {"memory_s", "window", config->memory_s, "a number of seconds from 2 to 600"},
        {"max_bound_rad", "max-bound", common->max_bound / RAD_PER_DEG, "a number of degrees from 0.06 to 28"},
        {"n_max", "n-max", (float)options->config.n_max, "a number from 20 to 10000"}};
    const jcal_two_dof_auto_config_t both = {*config, options->people};
    common_check(state,
                 (common->engine == JCAL_ENGINE_STREAM) ? jcal_two_dof_auto_config_check(&both)
                                                        : jcal_two_dof_window_config_check(&options->config),
                 limits, sizeof limits / sizeof limits[0]);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv\nSENSOR1.csv SENSOR2.csv",
    .two_files = true,
    .doc =
        "Finds both axes of a joint with two degrees of freedom, like elbow and forearm, and the heading offset of the two "
        "sensors' orientations from a recording of arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Orientations are taken from the columns q1_w, q1_x, q1_y, q1_z, q2_w ... "
        "q2_z if both sensors have them (unit quaternions that turn from the sensor's frame to an earth frame with z up, "
        "each with a heading of its own); else they are computed from the rates and specific forces.\n"
        "\n"
        "The heading offset turns vectors from the earth frame of sensor 2 to that of sensor 1, about z.\n"
        "\n"
        "On rigid segments any motion about both axes will do (model rigid). On a person skin moves with the sensors: bend only for ten "
        "seconds, then turn the forearm only for ten seconds (model functional). Each axis is found from its own motion, and ready means "
        "ready for the angles: axes and heading to within 15 degrees. The heading is then that between the orientations that the library "
        "makes itself.\n"
        "\n" COMMON_TWO_FILES COMMON_EXIT_HELP COMMON_PICTURE,
    .offers =
        {[COMMON_ENGINE] =
             {.help =
                  "How to compute. stream (default): sums of moments, constant memory. window: the last samples in a "
                  "buffer, 20 a second, as published by Laidig et al. 2022"},
         [COMMON_N_MAX] = {.help = "Samples in the window engine's buffer, 20 to 10000 (default 200)"},
         [COMMON_WINDOW] =
             {.help =
                  "Memory in seconds for the heading, which drifts, once the calibration is ready: 2 to 600 (default 5). "
                  "With --engine window the length of its buffer: 1 to 500 (default 10)"},
         [COMMON_EVERY] = {.help = COMMON_EVERY_HELP},
         [COMMON_MAX_BOUND] =
             {.help =
                  "Ready when both axes and the heading are known to within DEG degrees with 95 % confidence (default 3; of people "
                  "15, ready for angles)"},
         [COMMON_SIGN_HINT] =
             {.refusal = "--sign-hint is for a hinge: each axis of a joint with two axes has a sign of its own"},
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
        jcal_two_dof_auto_t stream;
        jcal_two_dof_window_t window;
    } engine;
    jcal_two_dof_auto_result_t all;
} two_dof_run_t;

static bool start(void *self, const void *options)
{
    two_dof_run_t *run = self;
    const two_dof_options_t *given = options;
    const jcal_two_dof_window_config_t *config = &given->config;
    run->base.oriented = true;
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        const jcal_two_dof_auto_config_t both = {config->two_dof, given->people};
        return jcal_two_dof_auto_init(&run->engine.stream, &both) == JCAL_OK;
    }
    const size_t bytes = jcal_two_dof_window_storage_bytes(config);
    run->base.storage = malloc(bytes);
    return run->base.storage != NULL &&
           jcal_two_dof_window_init(&run->engine.window, config, run->base.storage, bytes) == JCAL_OK;
}

static bool push(void *self, const recording_row_t *row, uint64_t t_us)
{
    two_dof_run_t *run = self;
    const jcal_orientation_pair_t pair = {t_us, row->q1, row->q2};
    const jcal_pair_t readings = {t_us, row->imu1, row->imu2};
    return ((run->base.engine == JCAL_ENGINE_STREAM)
                ? jcal_two_dof_auto_update(&run->engine.stream, &readings, &pair)
                : jcal_two_dof_window_update(&run->engine.window, &pair)) >= JCAL_OK;
}

static void reset(void *self)
{
    two_dof_run_t *run = self;
    (void)((run->base.engine == JCAL_ENGINE_STREAM) ? jcal_two_dof_auto_restart(&run->engine.stream)
                                                    : jcal_two_dof_window_reset(&run->engine.window));
}

static const jcal_head_t *get(void *self)
{
    two_dof_run_t *run = self;
    jcal_two_dof_result_t *result = &run->all.two_dof;
    /* The only error is a null pointer. */
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        (void)jcal_two_dof_auto_get(&run->engine.stream, &run->all);
    } else {
        (void)jcal_two_dof_window_get(&run->engine.window, result);
        run->all.ready_for = (result->head.status == JCAL_READY) ? JCAL_FOR_AXES : JCAL_FOR_NOTHING;
    }
    return &result->head;
}

/* ---- What is written ---- */

const report_words_t TWO_DOF_WORDS = {
    .name = "Joint with two axes",
    .misfit = "no joint with two axes explains the data: another kind of joint, or sensors that share none",
    .ambiguous = "other axes or headings explain the data about equally",
    .move_joint = "move the joint about both axes, in all combinations",
    .asked_for = "both axes and the heading",
    .bounded = "axes",
    .unit = "deg",
    .per_unit = DEG_PER_RAD,
    .unknown = BOUND_UNKNOWN_RAD,
};

static report_axes_t axes(const void *self)
{
    const jcal_two_dof_result_t *result = &((const two_dof_run_t *)self)->all.two_dof;
    return (report_axes_t){result->has_axes, result->axis1, result->axis2, result->uncertainty1_rad,
                           result->uncertainty2_rad};
}

/* In (-180, 180]: rounding may lead past the ends. */
static float heading_deg(float rad)
{
    const float deg = DEG_PER_RAD * rad;
    return (deg <= -180.0f || deg > 180.0f) ? 180.0f : deg;
}

/* The functional model has a heading before it has axes. */
static bool has_heading(const jcal_two_dof_auto_result_t *all)
{
    return all->two_dof.has_axes || all->model == JCAL_MODEL_FUNCTIONAL;
}

static bool heading_bounded(const jcal_two_dof_auto_result_t *all)
{
    return has_heading(all) && all->two_dof.uncertainty_heading_rad < BOUND_UNKNOWN_RAD;
}

static bool has_carrying(const jcal_two_dof_auto_result_t *all)
{
    const jcal_two_dof_result_t *result = &all->two_dof;
    const bool both = result->uncertainty1_rad < BOUND_UNKNOWN_RAD && result->uncertainty2_rad < BOUND_UNKNOWN_RAD;
    return result->has_axes && (all->model == JCAL_MODEL_RIGID || both);
}

static void write_json(const void *self, json_t *json)
{
    const two_dof_run_t *run = self;
    const jcal_two_dof_auto_result_t *all = &run->all;
    const jcal_two_dof_result_t *result = &all->two_dof;
    const report_axes_t found = axes(self);
    const float bound_deg = DEG_PER_RAD * result->uncertainty_heading_rad;
    const bool has_levers = all->ball.uncertainty_heading_rad < BOUND_UNKNOWN_RAD;
    const float bounds_m[2] = {(all->ball.uncertainty1_m < JCAL_BOUND_UNKNOWN_M) ? all->ball.uncertainty1_m : NAN,
                               (all->ball.uncertainty2_m < JCAL_BOUND_UNKNOWN_M) ? all->ball.uncertainty2_m : NAN};
    report_json_axes(json, &found);
    json_number(json, "heading_offset_deg", has_heading(all) ? heading_deg(result->heading_offset_rad) : NAN);
    json_number(json, "uncertainty_heading_deg", heading_bounded(all) ? bound_deg : NAN);
    json_number(json, "carrying_angle_deg", has_carrying(all) ? DEG_PER_RAD * result->carrying_angle_rad : NAN);
    json_word(json, "model", has_heading(all) ? jcal_model_string(all->model) : NULL);
    json_word(json, "ready_for", jcal_ready_for_string(all->ready_for));
    report_json_vector(json, "joint_to_sensor1_m", has_levers, all->ball.joint_to_sensor1_m);
    report_json_vector(json, "joint_to_sensor2_m", has_levers, all->ball.joint_to_sensor2_m);
    json_numbers(json, "uncertainty_m", has_levers, bounds_m, 2);
    report_json_lag(json, &run->base.lag);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        json_word(json, "paper_accepted", NULL); /* Laidig et al. have no such test */
    }
}

static void print_heading(FILE *file, const jcal_two_dof_auto_result_t *all)
{
    const jcal_two_dof_result_t *result = &all->two_dof;
    (void)fprintf(file, "  %-18s %8.1f deg   ", "heading offset", (double)heading_deg(result->heading_offset_rad));
    if (heading_bounded(all)) {
        (void)fprintf(file, "to within %.1f deg\n", (double)(DEG_PER_RAD * result->uncertainty_heading_rad));
    } else {
        (void)fputs("uncertainty unknown\n", file);
    }
    if (has_carrying(all)) {
        (void)fprintf(file, "  %-18s %8.1f deg\n", "carrying angle",
                      (double)(DEG_PER_RAD * result->carrying_angle_rad));
    } else {
        report_print_words(file, "carrying angle", "unknown");
    }
}

/* Which model the axes are of, what they are good for, and where the joint is. */
static void print_use(FILE *file, const jcal_two_dof_auto_result_t *all)
{
    if (all->model != JCAL_MODEL_FUNCTIONAL) {
        return;
    }
    report_print_words(
        file, "model",
        "functional: as on a person; each axis from motion that is mostly about it, the heading from the joint's own motion");
    report_print_place(file, "joint to sensor 1", all->ball.joint_to_sensor1_m, all->ball.uncertainty1_m);
    report_print_place(file, "joint to sensor 2", all->ball.joint_to_sensor2_m, all->ball.uncertainty2_m);
    if (all->ready_for == JCAL_FOR_ANGLES) {
        report_print_words(
            file, "good for",
            "angles: 'jointcal angles --joint two-dof' writes them; not for what needs the axes themselves");
    }
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const two_dof_run_t *run = self;
    const report_axes_t found = axes(self);
    report_print_head(file, report);
    report_print_axes(file, &found);
    if (has_heading(&run->all)) {
        print_heading(file, &run->all);
    } else {
        report_print_words(file, "heading offset", "unknown");
        report_print_words(file, "carrying angle", "unknown");
    }
    print_use(file, &run->all);
    report_print_orientations(file, report);
    report_print_state(file, report);
    report_print_exit(file, report);
}

/* ---- The command ---- */

static const calibrate_joint_t TWO_DOF = {.words = &TWO_DOF_WORDS,
                                          .size = sizeof(two_dof_run_t),
                                          .start = start,
                                          .push = push,
                                          .reset = reset,
                                          .get = get,
                                          .axes = axes,
                                          .write_json = write_json,
                                          .print_summary = print_summary};

int two_dof_command(int argc, char **argv)
{
    common_options_t common = {0};
    two_dof_options_t options = {.config = jcal_two_dof_window_config_default(),
                                 .people = jcal_two_axes_config_default()};
    options.config.two_dof.constraint = JCAL_CONSTRAINT_COMBINED;
    common_parse(&LINE, argc, argv, &common, &options);
    return (int)calibrate(&common, &TWO_DOF, &options);
}

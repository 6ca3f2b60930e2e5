/* SPDX-License-Identifier: MIT */
/* `jointcal center`: its options, its engines, what it writes. */
#include "commands/commands.h"
#include "input/calibration_file.h"
#include "options/values.h"
#include "run/calibrate.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <math.h>
#include <stdlib.h>

/* Samples that the window engine keeps a second, about. */
#define ROWS_PER_S 50.0f

/* Misfit of the rigid engine from which on the segments are a person's: recordings of rigs leave at most 0.05, of people 0.2 and more. */
#define PERSON_MISFIT 0.1f
/* The other model speaks for segments that are no person's with bounds below this, m: else which direction is open is worth more. */
#define PEOPLE_USEFUL_M 0.1f

/* ---- Options ---- */

enum { KEY_METHOD = OPTION_OWN, KEY_DERIVATIVE, KEY_SMOOTHING, KEY_MIN_RATE, KEY_ACC_BIAS, KEY_CALIBRATION };

typedef struct {
    jcal_center_window_config_t config; /* of the window engine, whose `center` part serves both */
    const char *calibration;            /* file with the axes of a hinge; null if not given */
} center_options_t;

static const struct argp_option OPTIONS[] = {
    {"method", KEY_METHOD, "NAME", 0,
     "What is minimised. ss (default): squared differences of the lengths of what both sensors feel at the joint; sa: absolute "
     "differences, which knocks disturb less. For research, ls: squared differences of the vectors, which needs orientations and is "
     "hardly ever ready, because a degree of tilt in them is 0.17 m/s^2 in those vectors; lengths do not feel it",
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
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    static const char *const methods[] = {"ss", "sa", "ls"};
    center_options_t *options = self;
    jcal_center_config_t *center = &options->config.center;
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
    case KEY_CALIBRATION:
        options->calibration = argument;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* The buffer's length in samples, whichever way it was given. */
static void settle_window(struct argp_state *state, const common_options_t *common, jcal_center_window_config_t *config)
{
    if (common->n_max > 0 && common->window_s > 0.0f) {
        argp_error(state, "--n-max and --window both set the length of the buffer: give one of them");
    }
    if (common->window_s > 0.0f) {
        if (!(common->window_s >= 1.0f && common->window_s <= 400.0f)) {
            argp_error(state, "--window: %g is not a number of seconds from 1 to 400", (double)common->window_s);
        }
        config->n_max = (uint16_t)roundf(ROWS_PER_S * common->window_s);
    }
    config->n_max = (common->n_max > 0) ? common->n_max : config->n_max;
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    jcal_center_window_config_t *window = &((center_options_t *)self)->config;
    jcal_center_config_t *config = &window->center;
    if (common->engine == JCAL_ENGINE_WINDOW) {
        settle_window(state, common, window);
    } else if (common->window_s > 0.0f) {
        config->memory_s = common->window_s;
    }
    config->max_bound_m = (common->max_bound > 0.0f) ? common->max_bound : config->max_bound_m;
    common->max_bound = config->max_bound_m;
    const common_limit_t limits[] = {
        {"memory_s", "window", config->memory_s, "a number of seconds from 10 to 3600"},
        {"max_bound_m", "max-bound", config->max_bound_m, "a number of metres from 0.001 to 0.1"},
        {"acc_bias_m_s2", "acc-bias", config->acc_bias_m_s2, "a number from 0 to 2 m/s^2"},
        {"smoothing_s", "smoothing", config->kinematics.smoothing_s, "a number of seconds from 0 to 2"},
        {"min_rate_rad_s", "min-rate", config->min_rate_rad_s, "a number from 0 to 20 rad/s"},
        {"n_max", "n-max", (float)window->n_max, "a number from 50 to 20000"}};
    common_check(state,
                 (common->engine == JCAL_ENGINE_STREAM) ? jcal_center_config_check(config)
                                                        : jcal_center_window_config_check(window),
                 limits, sizeof limits / sizeof limits[0]);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv\nSENSOR1.csv SENSOR2.csv",
    .two_files = true,
    .doc =
        "Finds where both sensors of a recording sit relative to the centre of the joint between them, from arbitrary motion.\v"
        "The recording is as for 'jointcal hinge'. Results are the vectors from the joint's centre to each sensor, in that sensor's "
        "frame. Orientations for --method ls are taken or computed as for 'jointcal two-dof'.\n"
        "\n"
        "On rigid segments places are good to millimetres (model rigid). On a person skin moves with the sensors: places are then good to "
        "some centimetres (model functional), and are ready with a limit such as --max-bound 0.06.\n"
        "\n" COMMON_TWO_FILES COMMON_EXIT_HELP COMMON_PICTURE,
    .offers =
        {[COMMON_ENGINE] =
             {.help =
                  "How to compute. stream (default): sums of moments, constant memory. window: the last samples in a "
                  "buffer, about 50 a second"},
         [COMMON_N_MAX] = {.help = "Samples in the window engine's buffer, 50 to 20000 (default 500)"},
         [COMMON_WINDOW] =
             {.help =
                  "Memory in seconds for what wanders, biases and heading: 10 to 3600 (default 300). With --engine window "
                  "the length of its buffer: 1 to 400 (default 10)"},
         [COMMON_EVERY] = {.help = COMMON_EVERY_HELP},
         [COMMON_MAX_BOUND] =
             {.help =
                  "Ready when the centre is known to within M metres from both sensors with 95 % confidence (default 0.01)"},
         [COMMON_SIGN_HINT] = {.refusal = "--sign-hint is for a hinge: a joint centre has no sign"},
         [COMMON_AXIS1_TOWARD] = {.refusal = "--axis1-toward is for axes: a joint centre has no axes"},
         [COMMON_JSON] = {.help = COMMON_JSON_HELP},
         [COMMON_SORT] = {.help = COMMON_SORT_HELP},
         [COMMON_LAG] = {.help = COMMON_LAG_HELP}},
    .n_max_least = 50,
    .n_max_most = 20000,
    .bound_unit = BOUND_IN_M,
    .own = OPTIONS,
    .parse = parse,
    .settle = settle,
};

/* ---- Engines ---- */

typedef struct {
    calibrate_state_t base;
    union {
        jcal_center_t stream;
        jcal_center_window_t window;
    } engine;
    bool is_hinge;           /* its axes are known */
    bool has_people;         /* the model of a person's joint runs beside the stream engine */
    jcal_ball_pair_t people; /* it */
    jcal_model_t model;      /* that the result is of */
    jcal_center_result_t result;
} center_run_t;

static bool start(void *self, const void *own)
{
    center_run_t *run = self;
    const center_options_t *options = own;
    const jcal_center_window_config_t *config = &options->config;
    run->base.oriented = config->center.method == JCAL_CENTER_LS;
    run->is_hinge = options->calibration != NULL;
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        jcal_ball_config_t people = jcal_ball_config_default();
        people.max_lever_m = config->center.max_bound_m;
        run->has_people = !run->is_hinge && !run->base.oriented;
        return jcal_center_init(&run->engine.stream, &config->center) == JCAL_OK &&
               jcal_ball_pair_init(&run->people, &people, NULL) == JCAL_OK;
    }
    const size_t bytes = jcal_center_window_storage_bytes(config);
    run->base.storage = malloc(bytes);
    return run->base.storage != NULL &&
           jcal_center_window_init(&run->engine.window, config, run->base.storage, bytes) == JCAL_OK;
}

static bool push(void *self, const recording_row_t *row, uint64_t t_us)
{
    center_run_t *run = self;
    const jcal_pair_t pair = {t_us, row->imu1, row->imu2};
    const jcal_attitudes_t attitudes = {row->q1, row->q2};
    jcal_center_t *stream = &run->engine.stream;
    jcal_center_window_t *window = &run->engine.window;
    if (run->has_people && jcal_ball_pair_update(&run->people, &pair) < JCAL_OK) {
        return false;
    }
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        const jcal_status_t status =
            run->base.oriented ? jcal_center_push_oriented(stream, &pair, &attitudes) : jcal_center_push(stream, &pair);
        return status >= JCAL_OK && jcal_center_step(stream) >= JCAL_OK;
    }
    const jcal_status_t status = run->base.oriented ? jcal_center_window_push_oriented(window, &pair, &attitudes)
                                                    : jcal_center_window_push(window, &pair);
    return status >= JCAL_OK && jcal_center_window_step(window) >= JCAL_OK;
}

static void reset(void *self)
{
    center_run_t *run = self;
    (void)((run->base.engine == JCAL_ENGINE_STREAM) ? jcal_center_reset(&run->engine.stream)
                                                    : jcal_center_window_reset(&run->engine.window));
}

/* A person's joint in the form of a rigid one's; the counters stay. */
static void say_people(center_run_t *run, const jcal_ball_result_t *ball)
{
    jcal_center_result_t *result = &run->result;
    const bool ready = ball->for_center1 && ball->for_center2;
    const bool open =
        ball->head.status == JCAL_READY && !ready; /* the joint is one, a place is not known well enough */
    const jcal_weak_t worse = (ball->uncertainty1_m > ball->uncertainty2_m) ? JCAL_WEAK_CENTER1 : JCAL_WEAK_CENTER2;
    run->model = JCAL_MODEL_FUNCTIONAL;
    result->head.status = open ? JCAL_COLLECTING : ball->head.status;
    result->head.reason = open ? JCAL_REASON_UNCERTAIN : ball->head.reason;
    result->head.weak = ready ? JCAL_WEAK_NONE : worse;
    result->head.hint = open ? JCAL_HINT_MORE_DIRECTIONS : ball->head.hint;
    result->has_center = true;
    result->joint_to_sensor1_m = ball->joint_to_sensor1_m;
    result->joint_to_sensor2_m = ball->joint_to_sensor2_m;
    result->uncertainty1_m = ball->uncertainty1_m;
    result->uncertainty2_m = ball->uncertainty2_m;
    result->weakest_direction1 = jcal_vec3(0.0f, 0.0f, 0.0f);
    result->weakest_direction2 = jcal_vec3(0.0f, 0.0f, 0.0f);
    result->uncertainty_weakest1_m = JCAL_BOUND_UNKNOWN_M;
    result->uncertainty_weakest2_m = JCAL_BOUND_UNKNOWN_M;
    result->misfit = 0.0f;
}

static const jcal_head_t *get(void *self)
{
    center_run_t *run = self;
    jcal_center_result_t *rigid = &run->result;
    /* The only error is a null pointer. */
    (void)((run->base.engine == JCAL_ENGINE_STREAM) ? jcal_center_get(&run->engine.stream, rigid)
                                                    : jcal_center_window_get(&run->engine.window, rigid));
    run->model = JCAL_MODEL_RIGID;
    if (run->has_people) {
        jcal_ball_result_t ball;
        (void)jcal_ball_pair_get(&run->people, &ball);
        const bool settled = rigid->head.status == JCAL_READY || rigid->head.status == JCAL_MOVED;
        const bool known = ball.uncertainty_heading_rad < BOUND_UNKNOWN_RAD;
        const float theirs = fmaxf(ball.uncertainty1_m, ball.uncertainty2_m);
        const bool sharper = theirs < fminf(fmaxf(rigid->uncertainty1_m, rigid->uncertainty2_m), PEOPLE_USEFUL_M);
        if (known && (rigid->misfit > PERSON_MISFIT || (!settled && sharper))) {
            say_people(run, &ball);
        }
    }
    return &rigid->head;
}

/* ---- What is written ---- */

static const report_words_t WORDS = {
    .name = "Joint centre",
    .misfit =
        "no fixed point of both segments explains the data: soft tissue, a joint that glides, or sensors that share none",
    .ambiguous = "another centre explains the data about equally",
    .move_joint = "turn both segments about all axes, briskly",
    .asked_for = "the centre from both sensors",
    .bounded = "centre",
    .unit = "mm",
    .per_unit = MM_PER_M,
    .unknown = JCAL_BOUND_UNKNOWN_M,
};

static report_bounds_t bounds(const void *self)
{
    const jcal_center_result_t *result = &((const center_run_t *)self)->result;
    return (report_bounds_t){result->has_center, result->uncertainty1_m, result->uncertainty2_m};
}

/* Two bounds: null if both are unknown; where one of two is, it reads 10 m. */
static void write_bounds(json_t *json, const char *key, float bound1, float bound2)
{
    const float values[2] = {bound1, bound2};
    json_numbers(json, key, bound1 < JCAL_BOUND_UNKNOWN_M || bound2 < JCAL_BOUND_UNKNOWN_M, values, 2);
}

/* A direction is zero until there was a judgement. */
static bool is_known(jcal_vec3_t direction)
{
    return direction.x != 0.0f || direction.y != 0.0f || direction.z != 0.0f;
}

static void write_json(const void *self, json_t *json)
{
    const center_run_t *run = self;
    const jcal_center_result_t *result = &run->result;
    const bool known = result->has_center;
    report_json_vector(json, "joint_to_sensor1_m", known, result->joint_to_sensor1_m);
    report_json_vector(json, "joint_to_sensor2_m", known, result->joint_to_sensor2_m);
    write_bounds(json, "uncertainty_m", result->uncertainty1_m, result->uncertainty2_m);
    report_json_vector(json, "weakest_direction1", is_known(result->weakest_direction1), result->weakest_direction1);
    report_json_vector(json, "weakest_direction2", is_known(result->weakest_direction2), result->weakest_direction2);
    write_bounds(json, "uncertainty_weakest_m", result->uncertainty_weakest1_m, result->uncertainty_weakest2_m);
    const bool biased = known && !run->base.oriented && run->model == JCAL_MODEL_RIGID;
    report_json_vector(json, "acc_bias1_m_s2", biased, result->acc_bias1_m_s2);
    report_json_vector(json, "acc_bias2_m_s2", biased, result->acc_bias2_m_s2);
    json_number(json, "heading_offset_deg",
                (known && run->base.oriented) ? DEG_PER_RAD * result->heading_offset_rad : NAN);
    json_word(json, "model", known ? jcal_model_string(run->model) : NULL);
    json_number(json, "misfit", (known && result->misfit > 0.0f) ? result->misfit : NAN);
    report_json_lag(json, &run->base.lag);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        json_word(json, "paper_accepted", NULL); /* the paper has no test of that kind */
    }
}

static void print_place(FILE *file, const char *label, bool known, jcal_vec3_t r, float bound)
{
    if (known) {
        report_print_place(file, label, r, bound);
    } else {
        report_print_words(file, label, "unknown");
    }
}

static void print_direction(FILE *file, const char *label, jcal_vec3_t direction, float bound)
{
    if (is_known(direction)) {
        (void)fprintf(file, "  %-18s %8.2f %8.2f %8.2f      ", label, (double)direction.x, (double)direction.y,
                      (double)direction.z);
        report_print_bound_mm(file, bound);
    }
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const center_run_t *run = self;
    const jcal_center_result_t *result = &run->result;
    report_print_head(file, report);
    print_place(file, "joint to sensor 1", result->has_center, result->joint_to_sensor1_m, result->uncertainty1_m);
    print_place(file, "joint to sensor 2", result->has_center, result->joint_to_sensor2_m, result->uncertainty2_m);
    print_direction(file, "weakest along", result->weakest_direction1, result->uncertainty_weakest1_m);
    print_direction(file, "    and, sensor 2,", result->weakest_direction2, result->uncertainty_weakest2_m);
    if (run->model == JCAL_MODEL_FUNCTIONAL) {
        report_print_words(
            file, "model",
            "functional: as on a person; a tenth of each place and more is allowed for skin that goes along");
    }
    if (run->is_hinge) {
        report_print_words(file, "along the axis",
                           "unknown: any point of a hinge's axis will do, this is the one next to both sensors");
    }
    if (run->base.oriented && result->has_center) {
        (void)fprintf(file, "  %-18s %8.1f deg\n", "heading offset",
                      (double)(DEG_PER_RAD * result->heading_offset_rad));
    }
    report_print_orientations(file, report);
    report_print_state(file, report);
    report_print_exit(file, report);
}

/* ---- The command ---- */

static const calibrate_joint_t CENTER = {.words = &WORDS,
                                         .uses_readings = true,
                                         .size = sizeof(center_run_t),
                                         .start = start,
                                         .push = push,
                                         .reset = reset,
                                         .get = get,
                                         .bounds = bounds,
                                         .write_json = write_json,
                                         .print_summary = print_summary};

int center_command(int argc, char **argv)
{
    common_options_t common = {0};
    center_options_t options = {.config = jcal_center_window_config_default()};
    common_parse(&LINE, argc, argv, &common, &options);
    if (!calibration_axes(options.calibration, &options.config.center.hinge_axis1,
                          &options.config.center.hinge_axis2)) {
        return EXIT_INPUT;
    }
    return (int)calibrate(&common, &CENTER, &options);
}

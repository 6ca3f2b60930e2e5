/* SPDX-License-Identifier: MIT */
/* `jointcal chain`: its options, hip and knee, what it writes. */
#include "commands/commands.h"
#include "input/calibration_file.h"
#include "options/values.h"
#include "run/calibrate.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <math.h>

/* Misfit of the rigid chain from which on the segments are a person's: recordings of rigs leave at most 0.05, of people 0.2 and more. */
#define PERSON_MISFIT 0.1f

/* ---- Options ---- */

enum { KEY_METHOD = OPTION_OWN, KEY_SMOOTHING, KEY_THIGH_LENGTH, KEY_CALIBRATION };

typedef struct {
    jcal_chain_config_t config;
    jcal_leg_config_t leg;
    const char *calibration; /* file with the axes of the knee; null if not given */
} chain_options_t;

static const struct argp_option OPTIONS[] = {
    {"method", KEY_METHOD, "NAME", 0,
     "As for 'jointcal center': ss (default), sa; for research ls, which needs orientations and is hardly ever ready",
     0},
    {"smoothing", KEY_SMOOTHING, "S", 0, "As for 'jointcal center', 0 to 2 (default 0.12)", 0},
    {"thigh-length", KEY_THIGH_LENGTH, "M", 0, "Distance of hip and knee in metres, if it is known: 0.1 to 1", 0},
    {"calibration", KEY_CALIBRATION, "FILE", 0,
     "The knee is a hinge with these axes: output of 'jointcal hinge --json' for thigh and shank. Its centre is then the point of the "
     "axis next to both sensors",
     0},
    {NULL, 0, NULL, 0, NULL, 0}};

static error_t parse(int key, char *argument, struct argp_state *state, void *self)
{
    static const char *const methods[] = {"ss", "sa", "ls"};
    chain_options_t *options = self;
    switch (key) {
    case KEY_METHOD:
        options->config.center.method = (jcal_center_method_t)option_one_of_three(state, "method", argument, methods);
        return 0;
    case KEY_SMOOTHING:
        options->config.center.kinematics.smoothing_s = option_not_negative(state, "smoothing", argument);
        return 0;
    case KEY_THIGH_LENGTH:
        options->config.segment_length_m = option_positive(state, "thigh-length", argument);
        options->leg.thigh_length_m = options->config.segment_length_m;
        return 0;
    case KEY_CALIBRATION:
        options->calibration = argument;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static void settle(struct argp_state *state, common_options_t *common, void *self)
{
    chain_options_t *options = self;
    jcal_chain_config_t *config = &options->config;
    config->center.memory_s = (common->window_s > 0.0f) ? common->window_s : config->center.memory_s;
    config->center.max_bound_m = (common->max_bound > 0.0f) ? common->max_bound : config->center.max_bound_m;
    common->max_bound = config->center.max_bound_m;
    options->leg.max_lever_m = config->center.max_bound_m;
    const common_limit_t limits[] = {
        {"segment_length_m", "thigh-length", config->segment_length_m, "a number of metres from 0.1 to 1"},
        {"thigh_length_m", "thigh-length", options->leg.thigh_length_m, "a number of metres from 0.1 to 1"},
        {"memory_s", "window", config->center.memory_s, "a number of seconds from 10 to 3600"},
        {"smoothing_s", "smoothing", config->center.kinematics.smoothing_s, "a number of seconds from 0 to 2"},
        {"max_bound_m", "max-bound", config->center.max_bound_m, "a number of metres from 0.001 to 0.1"}};
    const char *wrong = jcal_chain_config_check(config);
    common_check(state, (wrong != NULL) ? wrong : jcal_leg_config_check(&options->leg), limits,
                 sizeof limits / sizeof limits[0]);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv",
    .doc =
        "Finds where three sensors, 1 on the pelvis, 2 on the thigh and 3 on the shank, sit relative to the centres of hip and knee, "
        "from arbitrary motion.\v"
        "The recording is as for 'jointcal hinge', with gyr3_x ... acc3_z besides. Results are the vectors from each joint's centre to "
        "the sensors beside it, in the sensor's frame, and the distance of both centres. Orientations for --method ls are taken "
        "from the columns q1_w ... q3_z or computed.\n"
        "\n"
        "On rigid segments the vectors are exact (model rigid). On a person skin moves with the sensors: then each is found as well as that "
        "allows (model functional), and its bound says how well, some centimetres. --thigh-length makes them smaller.\n"
        "\n" COMMON_EXIT_HELP COMMON_PICTURE,
    .offers =
        {[COMMON_ENGINE] = {.help = "How to compute: stream (default). The chain has no other engine",
                            .refusal = "--engine window: the chain has the stream engine only"},
         [COMMON_N_MAX] = {.refusal = "--n-max goes with --engine window, which the chain does not have"},
         [COMMON_WINDOW] = {.help =
                                "Memory in seconds for what wanders, biases and headings: 10 to 3600 (default 300)"},
         [COMMON_EVERY] = {.help = COMMON_EVERY_HELP},
         [COMMON_MAX_BOUND] =
             {.help = "Ready when both centres are known to within M metres from all sensors with 95 % confidence "
                      "(default 0.01)"},
         [COMMON_SIGN_HINT] = {.refusal = "--sign-hint is for a hinge: joint centres have no sign"},
         [COMMON_AXIS1_TOWARD] = {.refusal = "--axis1-toward is for axes: joint centres have no axes"},
         [COMMON_JSON] = {.help = COMMON_JSON_HELP},
         [COMMON_SORT] = {.help = COMMON_SORT_HELP}},
    .bound_unit = BOUND_IN_M,
    .own = OPTIONS,
    .parse = parse,
    .settle = settle,
};

/* ---- The engines ---- */

/* What is told, of whichever model speaks. */
typedef struct {
    jcal_head_t head;
    jcal_model_t model;
    bool has_joint[JCAL_LEG_JOINTS];
    jcal_vec3_t place_m[JCAL_CHAIN_PLACES];
    float uncertainty_m[JCAL_CHAIN_PLACES];
    float segment_length_m;
    float uncertainty_segment_m;
} told_t;

typedef struct {
    calibrate_state_t base;
    jcal_chain_t chain;
    jcal_leg_t leg;
    bool had_moved; /* the rigid model */
    told_t told;
} chain_run_t;

static bool start(void *self, const void *options)
{
    chain_run_t *run = self;
    const chain_options_t *given = options;
    run->base.oriented = given->config.center.method == JCAL_CENTER_LS;
    return jcal_chain_init(&run->chain, &given->config) == JCAL_OK &&
           jcal_leg_init(&run->leg, &given->leg, &given->config.center.gate) == JCAL_OK;
}

static bool push(void *self, const recording_row_t *row, uint64_t t_us)
{
    chain_run_t *run = self;
    const jcal_triple_t triple = {t_us, row->imu1, row->imu2, row->imu3};
    const jcal_triple_attitudes_t attitudes = {row->q1, row->q2, row->q3};
    return jcal_chain_push(&run->chain, &triple, run->base.oriented ? &attitudes : NULL) >= JCAL_OK &&
           jcal_chain_step(&run->chain) >= JCAL_OK && jcal_leg_update(&run->leg, &triple) >= JCAL_OK;
}

static void reset(void *self)
{
    chain_run_t *run = self;
    (void)jcal_chain_reset(&run->chain); /* orientations that begin anew are nothing to the leg, which has its own */
}

/* On a person the rigid chain's levers shrink, and its bounds do not hold: none is told. */
static bool is_person(const jcal_chain_result_t *rigid)
{
    return rigid->misfit > PERSON_MISFIT;
}

static told_t tell_rigid(const jcal_chain_result_t *rigid)
{
    const bool holds = !is_person(rigid);
    told_t told = {.head = rigid->head,
                   .model = JCAL_MODEL_RIGID,
                   .has_joint = {rigid->has_places, rigid->has_places},
                   .segment_length_m = rigid->segment_length_m,
                   .uncertainty_segment_m = holds ? rigid->uncertainty_segment_m : JCAL_BOUND_UNKNOWN_M};
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        told.place_m[k] = rigid->place_m[k];
        told.uncertainty_m[k] = holds ? rigid->uncertainty_m[k] : JCAL_BOUND_UNKNOWN_M;
    }
    return told;
}

static told_t tell_functional(const jcal_leg_result_t *leg)
{
    told_t told = {.head = leg->head,
                   .model = JCAL_MODEL_FUNCTIONAL,
                   .has_joint = {leg->has_joint[JCAL_LEG_HIP], leg->has_joint[JCAL_LEG_KNEE]},
                   .segment_length_m = leg->segment_length_m,
                   .uncertainty_segment_m = leg->uncertainty_segment_m};
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        told.place_m[k] = leg->place_m[k];
        told.uncertainty_m[k] = leg->uncertainty_m[k];
    }
    return told;
}

/* The largest of the four bounds, and their sum. */
static void measure(const told_t *told, bool sound, float *largest, float *sum)
{
    *largest = 0.0f;
    *sum = 0.0f;
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        const float bound = (sound && told->has_joint[k / 2]) ? told->uncertainty_m[k] : JCAL_BOUND_UNKNOWN_M;
        *largest = fmaxf(*largest, bound);
        *sum += bound;
    }
}

/* True if the functional model is the one to speak. The rigid one is exact where it is ready, and where segments are rigid and it says that
   the given length does not fit, it does not; on a person it is not believed. Else the model speaks that knows all four vectors better;
   where neither knows all, the one that knows the others. Where more speaks against the rigid one than the size of its bounds, those do
   not count; the functional one tells none then. */
static bool functional_speaks(const told_t *rigid, bool person, const told_t *functional)
{
    if (!person && rigid->head.reason == JCAL_REASON_DOES_NOT_FIT) {
        return false;
    }
    if (rigid->head.status == JCAL_READY || functional->head.status == JCAL_READY) {
        return person || rigid->head.status != JCAL_READY;
    }
    float largest[2];
    float sum[2];
    measure(rigid, rigid->head.reason == JCAL_REASON_UNCERTAIN, &largest[0], &sum[0]);
    measure(functional, true, &largest[1], &sum[1]);
    return largest[1] < largest[0] || (largest[1] == largest[0] && sum[1] < sum[0]);
}

static const jcal_head_t *get(void *self)
{
    chain_run_t *run = self;
    jcal_chain_result_t chain;
    jcal_leg_result_t leg;
    (void)jcal_chain_get(&run->chain, &chain); /* the only error is a null pointer */
    const bool has_moved = chain.head.status == JCAL_MOVED;
    if (has_moved && !run->had_moved) {
        (void)jcal_leg_reset(&run->leg); /* what it learnt is of the sensors as they sat before */
    }
    run->had_moved = has_moved;
    (void)jcal_leg_get(&run->leg, &leg);
    const told_t rigid = tell_rigid(&chain);
    const told_t functional = tell_functional(&leg);
    run->told = functional_speaks(&rigid, is_person(&chain), &functional) ? functional : rigid;
    /* Both have counted the same rows. */
    run->told.head.samples = chain.head.samples;
    run->told.head.rejected = chain.head.rejected;
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        run->told.head.rejected_by[k] = chain.head.rejected_by[k];
    }
    return &run->told.head;
}

/* ---- What is written ---- */

static const report_words_t WORDS = {
    .name = "Hip and knee",
    .misfit =
        "no fixed point of both segments explains the data: soft tissue, a joint that glides, sensors that share none, or another "
        "thigh length than the one given",
    .ambiguous = "other centres explain the data about equally",
    .move_joint = "turn both segments of that joint about all axes, briskly",
    .asked_for = "both centres from all sensors",
    .bounded = "hip and knee",
    .centers = {"centre of the hip", "centre of the knee"},
    .turn = {{"turn the pelvis, about all axes", "turn the thigh, about all axes"},
             {"turn the thigh, about all axes", "turn the shank, about all axes"}},
    .unit = "mm",
    .per_unit = MM_PER_M,
    .unknown = JCAL_BOUND_UNKNOWN_M,
};

static const char *const KEYS[JCAL_CHAIN_PLACES] = {"hip_to_pelvis_m", "hip_to_thigh_m", "knee_to_thigh_m",
                                                    "knee_to_shank_m"};
static const char *const LABELS[JCAL_CHAIN_PLACES] = {"hip to pelvis", "hip to thigh", "knee to thigh",
                                                      "knee to shank"};

static bool has_all(const told_t *told)
{
    return told->has_joint[0] && told->has_joint[1];
}

/* The larger bound of each joint. */
static report_bounds_t bounds(const void *self)
{
    const told_t *told = &((const chain_run_t *)self)->told;
    const float *bound = told->uncertainty_m;
    return (report_bounds_t){has_all(told), fmaxf(bound[0], bound[1]), fmaxf(bound[2], bound[3])};
}

static float bound_or_nan(bool known, float bound_m)
{
    return (known && bound_m < JCAL_BOUND_UNKNOWN_M) ? bound_m : NAN;
}

static void write_json(const void *self, json_t *json)
{
    const told_t *told = &((const chain_run_t *)self)->told;
    const bool any = told->has_joint[0] || told->has_joint[1];
    float told_bounds[JCAL_CHAIN_PLACES];
    bool bounded = false;
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        report_json_vector(json, KEYS[k], told->has_joint[k / 2], told->place_m[k]);
        told_bounds[k] = bound_or_nan(told->has_joint[k / 2], told->uncertainty_m[k]);
        bounded = bounded || !isnan(told_bounds[k]);
    }
    json_numbers(json, "uncertainty_m", bounded, told_bounds, JCAL_CHAIN_PLACES);
    json_number(json, "segment_length_m", has_all(told) ? told->segment_length_m : NAN);
    json_number(json, "uncertainty_segment_m", bound_or_nan(has_all(told), told->uncertainty_segment_m));
    json_word(json, "model", any ? jcal_model_string(told->model) : NULL);
    report_json_lag(json, &((const chain_run_t *)self)->base.lag);
}

static void print_places(FILE *file, const told_t *told)
{
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        if (told->has_joint[k / 2]) {
            report_print_place(file, LABELS[k], told->place_m[k], told->uncertainty_m[k]);
        } else {
            report_print_words(file, LABELS[k], "unknown");
        }
    }
    if (has_all(told)) {
        (void)fprintf(file, "  %-18s %8.1f mm                     ", "from hip to knee",
                      (double)(MM_PER_M * told->segment_length_m));
        report_print_bound_mm(file, told->uncertainty_segment_m);
    }
}

static void print_model(FILE *file, const told_t *told)
{
    if (told->model == JCAL_MODEL_FUNCTIONAL) {
        report_print_words(
            file, "model",
            "functional: the segments are not rigid, as on a person; what skin may hide is in the bounds");
    }
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const told_t *told = &((const chain_run_t *)self)->told;
    report_print_head(file, report);
    if (told->has_joint[0] || told->has_joint[1]) {
        print_places(file, told);
        print_model(file, told);
    } else {
        report_print_words(file, "places", "unknown");
    }
    report_print_orientations(file, report);
    report_print_state(file, report);
    report_print_exit(file, report);
}

/* ---- The command ---- */

static const calibrate_joint_t CHAIN = {.words = &WORDS,
                                        .third = true,
                                        .uses_readings = true,
                                        .size = sizeof(chain_run_t),
                                        .start = start,
                                        .push = push,
                                        .reset = reset,
                                        .get = get,
                                        .bounds = bounds,
                                        .write_json = write_json,
                                        .print_summary = print_summary};

int chain_command(int argc, char **argv)
{
    common_options_t common = {0};
    chain_options_t options = {.config = jcal_chain_config_default(), .leg = jcal_leg_config_default()};
    common_parse(&LINE, argc, argv, &common, &options);
    if (!calibration_axes(options.calibration, &options.config.knee_axis2, &options.config.knee_axis3)) {
        return EXIT_INPUT;
    }
    return (int)calibrate(&common, &CHAIN, &options);
}

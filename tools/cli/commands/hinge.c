/* SPDX-License-Identifier: MIT */
/* `jointcal hinge`: its options, its engines, what it writes. */
#include "commands/hinge.h"

#include "commands/commands.h"
#include "run/calibrate.h"
#include "units.h"

#include "jointcal/jointcal.h"

#include <math.h>
#include <stdlib.h>

/* ---- Options ---- */

/* The config of the window engine, whose `hinge` part serves both. */
static void settle(struct argp_state *state, common_options_t *common, void *options)
{
    jcal_hinge_window_config_t *config = options;
    if (common->window_s > 0.0f && common->engine == JCAL_ENGINE_WINDOW) {
        argp_error(state, "--window does not go with --engine window here: its buffer counts samples, see --n-max");
    }
    config->n_max = (common->n_max > 0) ? common->n_max : config->n_max;
    config->hinge.max_bound_rad = (common->max_bound > 0.0f) ? common->max_bound : config->hinge.max_bound_rad;
    config->hinge.sign_hint = common->sign_hint;
    config->hinge.axis1_toward = common->axis1_toward;
    common->max_bound = config->hinge.max_bound_rad;
    const common_limit_t limits[] = {
        {"max_bound_rad", "max-bound", common->max_bound / RAD_PER_DEG, "a number of degrees from 0.06 to 28"},
        {"n_max", "n-max", (float)config->n_max, "a number from 20 to 10000"}};
    common_check(state, jcal_hinge_window_config_check(config), limits, sizeof limits / sizeof limits[0]);
}

static const command_line_t LINE = {
    .args_doc = "RECORDING.csv",
    .doc = "Finds both axes of a hinge joint from a recording of arbitrary motion.\v"
           "The recording is CSV with one header line; the columns t_s (s), gyr1_x, gyr1_y, gyr1_z, gyr2_x ... (rad/s) "
           "and acc1_x ... acc2_z (m/s^2) may stand in any order among others. Sensor 1 sits on the proximal segment, "
           "sensor 2 on the distal one. - reads standard input.\n"
           "\n" COMMON_EXIT_HELP COMMON_PICTURE,
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
         [COMMON_SORT] = {.help = COMMON_SORT_HELP}},
    .n_max_least = 20,
    .n_max_most = 10000,
    .bound_unit = BOUND_IN_DEG,
    .settle = settle,
};

/* ---- Engines ---- */

typedef struct {
    calibrate_state_t base;
    union {
        jcal_hinge_t stream;
        jcal_hinge_window_t window;
    } engine;
    jcal_hinge_result_t result;
} hinge_run_t;

static bool start(void *self, const void *options)
{
    hinge_run_t *run = self;
    const jcal_hinge_window_config_t *config = options;
    if (run->base.engine == JCAL_ENGINE_STREAM) {
        return jcal_hinge_init(&run->engine.stream, &config->hinge) == JCAL_OK;
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
    return ((run->base.engine == JCAL_ENGINE_STREAM) ? jcal_hinge_update(&run->engine.stream, &pair)
                                                     : jcal_hinge_window_update(&run->engine.window, &pair)) >= JCAL_OK;
}

static const jcal_head_t *get(void *self)
{
    hinge_run_t *run = self;
    /* The only error is a null pointer. */
    (void)((run->base.engine == JCAL_ENGINE_STREAM) ? jcal_hinge_get(&run->engine.stream, &run->result)
                                                    : jcal_hinge_window_get(&run->engine.window, &run->result));
    return &run->result.head;
}

/* ---- What is written ---- */

const report_words_t HINGE_WORDS = {
    .name = "Hinge",
    .misfit = "no hinge explains the data: another kind of joint, or sensors that share none",
    .ambiguous = "other axes explain the data about equally",
    .move_joint = "bend and stretch the joint",
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
    return axes_of(&((const hinge_run_t *)self)->result);
}

void hinge_write_keys(json_t *json, const jcal_hinge_result_t *result)
{
    const report_axes_t found = axes_of(result);
    report_json_axes(json, &found);
    json_number(json, "sign_margin", (result->sign_margin > 0.0f) ? result->sign_margin : NAN);
    if (result->head.engine == JCAL_ENGINE_WINDOW) {
        json_bool(json, "paper_accepted", result->paper_accepted);
    }
}

static void write_json(const void *self, json_t *json)
{
    hinge_write_keys(json, &((const hinge_run_t *)self)->result);
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

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const hinge_run_t *run = self;
    const report_axes_t found = axes(self);
    report_print_head(file, report);
    report_print_axes(file, &found);
    print_pairing(file, run->result.sign_margin);
    report_print_state(file, report);
    if (run->base.engine == JCAL_ENGINE_WINDOW) {
        report_print_words(file, "paper's test", run->result.paper_accepted ? "accepted" : "not accepted");
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
    jcal_hinge_window_config_t config = jcal_hinge_window_config_default();
    common_parse(&LINE, argc, argv, &common, &config);
    return (int)calibrate(&common, &HINGE, &config);
}

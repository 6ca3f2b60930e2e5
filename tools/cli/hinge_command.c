/* SPDX-License-Identifier: MIT */
/* `jointcal hinge`: the hinge engines in the run of a calibration. */
#include "hinge_command.h"

#include "calibrate.h"
#include "engine.h"
#include "hinge_options.h"
#include "hinge_output.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    engine_t engine;
    jcal_hinge_result_t result;
} hinge_run_t;

/* A hinge needs readings only. */
static recording_event_t open_recording(void *self, recording_t *recording)
{
    (void)self;
    (void)recording;
    return RECORDING_ROW;
}

static recording_event_t next_row(void *self, recording_t *recording, recording_row_t *row)
{
    (void)self;
    return recording_next(recording, row);
}

static bool push_row(void *self, const recording_row_t *row, uint64_t t_us)
{
    hinge_run_t *run = self;
    jcal_pair_t pair = {t_us, row->imu1, row->imu2};
    if (!row->has_time) {
        /* The library's time has no NaN; the sample has. */
        pair.imu1.gyr_rad_s.x = NAN;
    }
    return engine_update(&run->engine, &pair);
}

static finding_t get_finding(void *self)
{
    hinge_run_t *run = self;
    engine_get(&run->engine, &run->result);
    return hinge_finding(&run->result);
}

static void write_json(const void *self, FILE *file, const char *event, const report_t *report)
{
    const hinge_run_t *run = self;
    hinge_write_json(file, event, report, &run->result);
}

static void print_summary(const void *self, FILE *file, const report_t *report)
{
    const hinge_run_t *run = self;
    hinge_print_summary(file, report, &run->result);
}

static void close_recording(void *self)
{
    (void)self;
}

static const calibrate_joint_t HINGE = {open_recording, next_row,      push_row,        get_finding,
                                        write_json,     print_summary, close_recording, &HINGE_WORDS};

int hinge_command(int argc, char **argv)
{
    const hinge_options_t options = hinge_options(argc, argv);
    hinge_run_t *run = calloc(1, sizeof *run);
    exit_status_t status = EXIT_TROUBLE;
    if (run == NULL || !engine_start(&run->engine, &options.engine)) {
        complain("jointcal", 0, 0, "%s", strerror(ENOMEM));
    } else {
        status = calibrate(&options.common, &HINGE, run, options.engine.config.hinge.max_bound_rad);
    }
    if (run != NULL) {
        engine_stop(&run->engine);
    }
    free(run);
    return (int)status;
}

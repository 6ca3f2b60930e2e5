/* SPDX-License-Identifier: MIT */
/* Runs a hinge engine over arrays: what the Python measurements in tools/ call through ctypes (jointcal_tools.native). */
#include "batch.h"

#include <stdlib.h>
#include <string.h>

void jcal_batch_defaults(jcal_batch_options_t *options)
{
    const jcal_hinge_window_config_t window = jcal_hinge_window_config_default();
    const jcal_hinge_config_t *const hinge = &window.hinge;
    *options = (jcal_batch_options_t){
        .engine = JCAL_ENGINE_STREAM,
        .sign_hint = (int32_t)hinge->sign_hint,
        .max_bound_rad = hinge->max_bound_rad,
        .gyr_noise_rad_s = hinge->gyr_noise_rad_s,
        .acc_noise_m_s2 = hinge->acc_noise_m_s2,
        .lever_arm_m = hinge->lever_arm_m,
        .rate_mismatch = hinge->rate_mismatch,
        .gyr_bias_rad_s = hinge->gyr_bias_rad_s,
        .acc_bias_m_s2 = hinge->acc_bias_m_s2,
        .slices_per_s = hinge->slices_per_s,
        .n_max = window.n_max,
        .half_window = window.half_window,
        .acc_min = window.acc_min,
        .accept_count = window.accept_count,
        .seed = window.seed,
        .w0 = window.w0,
        .energy_max_rad2_s2 = window.energy_max_rad2_s2,
        .accept_bound_rad = window.accept_bound_rad,
        .solve_period_s = window.solve_period_s,
    };
}

static jcal_hinge_window_config_t config_from(const jcal_batch_options_t *options)
{
    jcal_hinge_window_config_t window = jcal_hinge_window_config_default();
    jcal_hinge_config_t *const hinge = &window.hinge;
    hinge->sign_hint = (jcal_sign_hint_t)options->sign_hint;
    hinge->max_bound_rad = options->max_bound_rad;
    hinge->gyr_noise_rad_s = options->gyr_noise_rad_s;
    hinge->acc_noise_m_s2 = options->acc_noise_m_s2;
    hinge->lever_arm_m = options->lever_arm_m;
    hinge->rate_mismatch = options->rate_mismatch;
    hinge->gyr_bias_rad_s = options->gyr_bias_rad_s;
    hinge->acc_bias_m_s2 = options->acc_bias_m_s2;
    hinge->slices_per_s = options->slices_per_s;
    window.n_max = (uint16_t)options->n_max;
    window.half_window = (uint16_t)options->half_window;
    window.acc_min = (uint16_t)options->acc_min;
    window.accept_count = (uint16_t)options->accept_count;
    window.seed = options->seed;
    window.w0 = options->w0;
    window.energy_max_rad2_s2 = options->energy_max_rad2_s2;
    window.accept_bound_rad = options->accept_bound_rad;
    window.solve_period_s = options->solve_period_s;
    return window;
}

size_t jcal_batch_options_size(void)
{
    return sizeof(jcal_batch_options_t);
}

const char *jcal_batch_check(const jcal_batch_options_t *options)
{
    const jcal_hinge_window_config_t config = config_from(options);
    return (options->engine == JCAL_ENGINE_STREAM) ? jcal_hinge_config_check(&config.hinge)
                                                   : jcal_hinge_window_config_check(&config);
}

static void write_row(const jcal_hinge_result_t *r, float row[static JCAL_BATCH_COLUMNS])
{
    const float values[JCAL_BATCH_COLUMNS] = {
        (float)r->head.status,
        (float)r->head.reason,
        (float)r->head.weak,
        (float)r->head.hint,
        r->axis1.x,
        r->axis1.y,
        r->axis1.z,
        r->axis2.x,
        r->axis2.y,
        r->axis2.z,
        r->uncertainty1_rad,
        r->uncertainty2_rad,
        r->sign_margin,
        r->paper_accepted ? 1.0f : 0.0f,
        r->progress_axis1,
        r->progress_axis2,
        r->progress_sign,
    };
    memcpy(row, values, sizeof(values));
}

static void write_rejected(const jcal_hinge_result_t *r, uint32_t *rejected_by)
{
    memcpy(rejected_by, r->head.rejected_by, sizeof(r->head.rejected_by));
}

static int32_t run_stream(const jcal_hinge_config_t *config, const jcal_batch_input_t *in, jcal_batch_output_t *out)
{
    jcal_hinge_t engine;
    if (jcal_hinge_init(&engine, config) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    jcal_hinge_result_t result;
    for (size_t k = 0; k < in->count; k++) {
        const jcal_pair_t pair = jcal_batch_pair(in, k);
        (void)jcal_hinge_update(&engine, &pair);
        (void)jcal_hinge_get(&engine, &result);
        write_row(&result, out->rows + k * JCAL_BATCH_COLUMNS);
    }
    (void)jcal_hinge_get(&engine, &result);
    write_rejected(&result, out->rejected_by);
    return JCAL_BATCH_DONE;
}

static int32_t run_window(const jcal_hinge_window_config_t *config, const jcal_batch_input_t *in,
                          jcal_batch_output_t *out)
{
    const size_t bytes = jcal_hinge_window_storage_bytes(config);
    void *const storage = malloc(bytes);
    if (storage == NULL) {
        return JCAL_BATCH_MEMORY;
    }
    jcal_hinge_window_t engine;
    if (jcal_hinge_window_init(&engine, config, storage, bytes) != JCAL_OK) {
        free(storage);
        return JCAL_BATCH_CONFIG;
    }
    jcal_hinge_result_t result;
    for (size_t k = 0; k < in->count; k++) {
        const jcal_pair_t pair = jcal_batch_pair(in, k);
        (void)jcal_hinge_window_update(&engine, &pair);
        (void)jcal_hinge_window_get(&engine, &result);
        write_row(&result, out->rows + k * JCAL_BATCH_COLUMNS);
    }
    (void)jcal_hinge_window_get(&engine, &result);
    write_rejected(&result, out->rejected_by);
    out->gyr_count = config->n_max;
    out->acc_count = config->n_max;
    (void)jcal_hinge_window_selection(&engine, out->gyr_ids, &out->gyr_count, out->acc_ids, &out->acc_count);
    free(storage);
    return JCAL_BATCH_DONE;
}

int32_t jcal_batch_run(const jcal_batch_options_t *options, const jcal_batch_input_t *in, jcal_batch_output_t *out)
{
    const jcal_hinge_window_config_t config = config_from(options);
    return (options->engine == JCAL_ENGINE_STREAM) ? run_stream(&config.hinge, in, out) : run_window(&config, in, out);
}

const char *jcal_batch_version(void)
{
    return jcal_version();
}

const char *jcal_batch_reason(int32_t reason)
{
    return jcal_reason_string((jcal_reason_t)reason);
}

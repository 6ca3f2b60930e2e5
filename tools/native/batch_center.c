/* SPDX-License-Identifier: MIT */
/* Runs the engines of the joint centre over arrays. */
#include "batch_center.h"

#include <stdlib.h>
#include <string.h>

/* One engine or the other. */
typedef struct {
    bool is_window;
    jcal_center_t stream;
    jcal_center_window_t window;
} engine_t;

void jcal_batch_center_defaults(jcal_batch_center_options_t *options)
{
    const jcal_center_config_t config = jcal_center_config_default();
    *options = (jcal_batch_center_options_t){
        .method = (int32_t)config.method,
        .derivative = (int32_t)config.kinematics.derivative,
        .smoothing_s = config.kinematics.smoothing_s,
        .max_bound_m = config.max_bound_m,
        .mismatch_m = config.mismatch_m,
        .rate_mismatch = config.rate_mismatch,
        .acc_noise_m_s2 = config.acc_noise_m_s2,
        .turn_error = config.turn_error,
        .acc_bias_m_s2 = config.acc_bias_m_s2,
        .min_rate_rad_s = config.min_rate_rad_s,
        .memory_s = config.memory_s,
    };
}

static jcal_vec3_t vector_at(const float *v)
{
    const jcal_vec3_t out = {v[0], v[1], v[2]};
    return out;
}

static jcal_quat_t quaternion_at(const float *v)
{
    const jcal_quat_t q = {v[0], v[1], v[2], v[3]};
    return q;
}

jcal_center_config_t jcal_batch_center_config(const jcal_batch_center_options_t *options)
{
    jcal_center_config_t config = jcal_center_config_default();
    config.method = (jcal_center_method_t)options->method;
    config.kinematics.derivative = (jcal_derivative_t)options->derivative;
    config.kinematics.smoothing_s = options->smoothing_s;
    config.max_bound_m = options->max_bound_m;
    config.mismatch_m = options->mismatch_m;
    config.rate_mismatch = options->rate_mismatch;
    config.acc_noise_m_s2 = options->acc_noise_m_s2;
    config.turn_error = options->turn_error;
    config.acc_bias_m_s2 = options->acc_bias_m_s2;
    config.min_rate_rad_s = options->min_rate_rad_s;
    config.memory_s = options->memory_s;
    config.hinge_axis1 = vector_at(options->hinge_axis1);
    config.hinge_axis2 = vector_at(options->hinge_axis2);
    return config;
}

static void push(engine_t *engine, const jcal_batch_center_input_t *in, size_t k)
{
    const float *const v = in->values + k * 12;
    const jcal_pair_t pair = {in->t_us[k], {vector_at(v), vector_at(v + 3)}, {vector_at(v + 6), vector_at(v + 9)}};
    if (in->orientations == NULL) {
        (void)(engine->is_window ? jcal_center_window_push(&engine->window, &pair)
                                 : jcal_center_push(&engine->stream, &pair));
    } else {
        const float *const q = in->orientations + k * 8;
        const jcal_attitudes_t attitudes = {quaternion_at(q), quaternion_at(q + 4)};
        (void)(engine->is_window ? jcal_center_window_push_oriented(&engine->window, &pair, &attitudes)
                                 : jcal_center_push_oriented(&engine->stream, &pair, &attitudes));
    }
    (void)(engine->is_window ? jcal_center_window_step(&engine->window) : jcal_center_step(&engine->stream));
}

static void get(const engine_t *engine, jcal_center_result_t *result)
{
    (void)(engine->is_window ? jcal_center_window_get(&engine->window, result)
                             : jcal_center_get(&engine->stream, result));
}

static float *put(float *to, jcal_vec3_t v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
    return to + 3;
}

static void write_row(const jcal_center_result_t *r, float *row)
{
    row[0] = (float)r->head.status;
    row[1] = (float)r->head.reason;
    row[2] = (float)r->head.weak;
    row[3] = (float)r->head.hint;
    float *at = put(put(row + 4, r->joint_to_sensor1_m), r->joint_to_sensor2_m);
    at[0] = r->uncertainty1_m;
    at[1] = r->uncertainty2_m;
    at = put(put(at + 2, r->weakest_direction1), r->weakest_direction2);
    at[0] = r->uncertainty_weakest1_m;
    at[1] = r->uncertainty_weakest2_m;
    at = put(put(at + 2, r->acc_bias1_m_s2), r->acc_bias2_m_s2);
    at[0] = r->heading_offset_rad;
    at[1] = r->misfit;
}

/* Storage of the window engine, or something to free. Null if the config is wrong. */
static void *start(engine_t *engine, const jcal_batch_center_options_t *options)
{
    const jcal_center_window_config_t config = {jcal_batch_center_config(options), (uint16_t)options->n_max};
    engine->is_window = options->n_max > 0;
    if (!engine->is_window) {
        return (jcal_center_init(&engine->stream, &config.center) == JCAL_OK) ? malloc(1) : NULL;
    }
    if (options->n_max > UINT16_MAX || jcal_center_window_config_check(&config) != NULL) {
        return NULL;
    }
    const size_t bytes = jcal_center_window_storage_bytes(&config);
    void *const storage = malloc(bytes);
    if (storage != NULL && jcal_center_window_init(&engine->window, &config, storage, bytes) != JCAL_OK) {
        free(storage);
        return NULL;
    }
    return storage;
}

int32_t jcal_batch_center_run(const jcal_batch_center_options_t *options, const jcal_batch_center_input_t *in,
                              float *rows, uint32_t *rejected_by)
{
    engine_t *const engine = calloc(1, sizeof *engine);
    void *const storage = (engine != NULL) ? start(engine, options) : NULL;
    if (storage == NULL) {
        free(engine);
        return JCAL_BATCH_CONFIG;
    }
    jcal_center_result_t result;
    for (size_t k = 0; k < in->count; k++) {
        push(engine, in, k);
        get(engine, &result);
        write_row(&result, rows + k * JCAL_BATCH_CENTER_COLUMNS);
    }
    get(engine, &result);
    memcpy(rejected_by, result.head.rejected_by, sizeof(result.head.rejected_by));
    free(storage);
    free(engine);
    return JCAL_BATCH_DONE;
}

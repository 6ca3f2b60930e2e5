/* SPDX-License-Identifier: MIT */
/* Runs the engines of the 2-DoF joint, and VQF, over arrays. */
#include "batch_two_dof.h"

#ifdef JCAL_BATCH_HAS_VQF
#include "jcal_vqf.h"
#endif

#include <stdlib.h>
#include <string.h>

void jcal_batch_two_dof_defaults(jcal_batch_two_dof_options_t *options)
{
    const jcal_two_dof_config_t config = jcal_two_dof_config_default();
    *options = (jcal_batch_two_dof_options_t){
        .constraint = (int32_t)config.constraint,
        .max_bound_rad = config.max_bound_rad,
        .mismatch_rad = config.mismatch_rad,
        .memory_s = config.memory_s,
    };
}

static jcal_quat_t quaternion_at(const float *v)
{
    const jcal_quat_t q = {v[0], v[1], v[2], v[3]};
    return q;
}

static void write_row(const jcal_two_dof_result_t *r, float row[static JCAL_BATCH_TWO_DOF_COLUMNS])
{
    const float values[JCAL_BATCH_TWO_DOF_COLUMNS] = {
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
        r->heading_offset_rad,
        r->carrying_angle_rad,
        r->uncertainty1_rad,
        r->uncertainty2_rad,
        r->uncertainty_heading_rad,
    };
    memcpy(row, values, sizeof(values));
}

static jcal_orientation_pair_t pair_at(const jcal_batch_orientations_t *in, size_t k)
{
    const float *const v = in->values + k * 8;
    const jcal_orientation_pair_t pair = {in->t_us[k], quaternion_at(v), quaternion_at(v + 4)};
    return pair;
}

static jcal_two_dof_config_t config_of(const jcal_batch_two_dof_options_t *options)
{
    jcal_two_dof_config_t config = jcal_two_dof_config_default();
    config.constraint = (jcal_constraint_t)options->constraint;
    config.max_bound_rad = options->max_bound_rad;
    config.mismatch_rad = options->mismatch_rad;
    config.memory_s = options->memory_s;
    return config;
}

int32_t jcal_batch_two_dof_run(const jcal_batch_two_dof_options_t *options, const jcal_batch_orientations_t *in,
                               float *rows, uint32_t *rejected_by)
{
    const jcal_two_dof_config_t config = config_of(options);
    jcal_two_dof_t engine;
    if (jcal_two_dof_init(&engine, &config) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    jcal_two_dof_result_t result;
    for (size_t k = 0; k < in->count; k++) {
        const jcal_orientation_pair_t pair = pair_at(in, k);
        (void)jcal_two_dof_update(&engine, &pair);
        (void)jcal_two_dof_get(&engine, &result);
        write_row(&result, rows + k * JCAL_BATCH_TWO_DOF_COLUMNS);
    }
    (void)jcal_two_dof_get(&engine, &result);
    memcpy(rejected_by, result.head.rejected_by, sizeof(result.head.rejected_by));
    return JCAL_BATCH_DONE;
}

static void run_window(jcal_two_dof_window_t *engine, const jcal_batch_orientations_t *in,
                       jcal_batch_two_dof_window_out_t *out)
{
    jcal_two_dof_result_t result;
    for (size_t k = 0; k < in->count; k++) {
        const jcal_orientation_pair_t pair = pair_at(in, k);
        (void)jcal_two_dof_window_update(engine, &pair);
        (void)jcal_two_dof_window_get(engine, &result);
        write_row(&result, out->rows + k * JCAL_BATCH_TWO_DOF_COLUMNS);
    }
    (void)jcal_two_dof_window_get(engine, &result);
    memcpy(out->rejected_by, result.head.rejected_by, sizeof(result.head.rejected_by));
    size_t kept = engine->cfg.n_max;
    (void)jcal_two_dof_window_kept(engine, out->kept_us, &kept);
    out->kept_count = kept;
}

int32_t jcal_batch_two_dof_window_run(const jcal_batch_two_dof_options_t *options, uint32_t n_max,
                                      const jcal_batch_orientations_t *in, jcal_batch_two_dof_window_out_t *out)
{
    const jcal_two_dof_window_config_t config = {config_of(options), (uint16_t)n_max};
    if (n_max > UINT16_MAX || jcal_two_dof_window_config_check(&config) != NULL) {
        return JCAL_BATCH_CONFIG;
    }
    const size_t bytes = jcal_two_dof_window_storage_bytes(&config);
    void *const storage = malloc(bytes);
    jcal_two_dof_window_t engine;
    const bool ready = storage != NULL && jcal_two_dof_window_init(&engine, &config, storage, bytes) == JCAL_OK;
    if (ready) {
        run_window(&engine, in, out);
    }
    free(storage);
    return ready ? JCAL_BATCH_DONE : JCAL_BATCH_CONFIG;
}

int32_t jcal_batch_vqf(const float *values, size_t count, float period_s, float *orientations)
{
#ifdef JCAL_BATCH_HAS_VQF
    jcal_vqf_t filter;
    if (jcal_vqf_init(&filter, period_s, period_s) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    float q[4] = {1.0f, 0.0f, 0.0f, 0.0f};
    for (size_t k = 0; k < count; k++) {
        if (jcal_vqf_update(&filter, values + k * 6, values + k * 6 + 3, q) < JCAL_OK) {
            return JCAL_BATCH_CONFIG;
        }
        memcpy(orientations + k * 4, q, sizeof(q)); /* a reading that is not finite repeats the last one */
    }
    return JCAL_BATCH_DONE;
#else
    (void)values;
    (void)count;
    (void)period_s;
    (void)orientations;
    return JCAL_BATCH_CONFIG;
#endif
}

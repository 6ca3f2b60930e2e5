/* SPDX-License-Identifier: MIT */
/* Runs hip and knee over arrays. */
#include "batch_chain.h"

#include <stdlib.h>
#include <string.h>

void jcal_batch_chain_defaults(jcal_batch_chain_options_t *options)
{
    const jcal_chain_config_t config = jcal_chain_config_default();
    memset(options, 0, sizeof *options);
    jcal_batch_center_defaults(&options->center);
    options->segment_tolerance_m = config.segment_tolerance_m;
    options->plane_tolerance_m = config.plane_tolerance_m;
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

static jcal_chain_config_t config_of(const jcal_batch_chain_options_t *options)
{
    jcal_chain_config_t config = jcal_chain_config_default();
    config.center = jcal_batch_center_config(&options->center);
    config.knee_axis2 = config.center.hinge_axis1;
    config.knee_axis3 = config.center.hinge_axis2;
    config.center.hinge_axis1 = (jcal_vec3_t){0.0f, 0.0f, 0.0f};
    config.center.hinge_axis2 = config.center.hinge_axis1;
    config.segment_length_m = options->segment_length_m;
    config.segment_tolerance_m = options->segment_tolerance_m;
    config.plane_normal = vector_at(options->plane_normal);
    config.plane_tolerance_m = options->plane_tolerance_m;
    return config;
}

static void push(jcal_chain_t *chain, const jcal_batch_chain_input_t *in, size_t k)
{
    const float *const v = in->values + k * 18;
    const jcal_triple_t triple = {in->t_us[k],
                                  {vector_at(v), vector_at(v + 3)},
                                  {vector_at(v + 6), vector_at(v + 9)},
                                  {vector_at(v + 12), vector_at(v + 15)}};
    jcal_triple_attitudes_t attitudes;
    if (in->orientations != NULL) {
        const float *const q = in->orientations + k * 12;
        attitudes = (jcal_triple_attitudes_t){quaternion_at(q), quaternion_at(q + 4), quaternion_at(q + 8)};
    }
    (void)jcal_chain_push(chain, &triple, (in->orientations != NULL) ? &attitudes : NULL);
    (void)jcal_chain_step(chain);
}

static void write_row(const jcal_chain_result_t *r, float *row)
{
    const float head[4] = {(float)r->head.status, (float)r->head.reason, (float)r->head.weak, (float)r->head.hint};
    memcpy(row, head, sizeof head);
    for (int i = 0; i < JCAL_CHAIN_PLACES; i++) {
        row[4 + 3 * i] = r->place_m[i].x;
        row[5 + 3 * i] = r->place_m[i].y;
        row[6 + 3 * i] = r->place_m[i].z;
        row[16 + i] = r->uncertainty_m[i];
    }
    row[20] = r->segment_length_m;
    row[21] = r->uncertainty_segment_m;
    row[22] = (float)r->joint_status[0];
    row[23] = (float)r->joint_status[1];
}

int32_t jcal_batch_chain_run(const jcal_batch_chain_options_t *options, const jcal_batch_chain_input_t *in,
                             uint32_t every, float *rows)
{
    const jcal_chain_config_t config = config_of(options);
    jcal_chain_t *const chain = malloc(sizeof *chain);
    if (chain == NULL || every == 0 || jcal_chain_init(chain, &config) != JCAL_OK) {
        free(chain);
        return JCAL_BATCH_CONFIG;
    }
    jcal_chain_result_t result;
    for (size_t k = 0; k < in->count; k++) {
        push(chain, in, k);
        if ((k + 1) % every == 0) {
            (void)jcal_chain_get(chain, &result);
            write_row(&result, rows + ((k + 1) / every - 1) * JCAL_BATCH_CHAIN_COLUMNS);
        }
    }
    free(chain);
    return JCAL_BATCH_DONE;
}

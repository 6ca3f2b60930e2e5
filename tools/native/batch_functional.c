/* SPDX-License-Identifier: MIT */
/* Runs the functional joint over arrays. */
#include "batch_functional.h"

#include <string.h>

#define VALUES_PER_PAIR 12

void jcal_batch_functional_defaults(jcal_batch_functional_options_t *options)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    *options = (jcal_batch_functional_options_t){
        .max_bound_rad = config.max_bound_rad,
        .max_flexion_rad = config.max_flexion_rad,
        .slices_per_s = config.slices_per_s,
        .sign_hint = (int32_t)config.sign_hint,
    };
}

static void write_row(const jcal_functional_pair_t *engine, size_t sample,
                      float row[static JCAL_BATCH_FUNCTIONAL_COLUMNS])
{
    jcal_functional_result_t r;
    (void)jcal_functional_pair_get(engine, &r);
    const jcal_functional_t *const joint = &engine->joint;
    const jcal_functional_verdict_t *const v = &joint->verdict;
    const float motion_s = (joint->sums.motion_s > 0.0f) ? joint->sums.motion_s : 1.0f;
    const float values[JCAL_BATCH_FUNCTIONAL_COLUMNS] = {
        (float)r.head.status,
        (float)r.head.reason,
        (float)r.head.weak,
        (float)r.head.hint,
        r.axis1.x,
        r.axis1.y,
        r.axis1.z,
        r.axis2.x,
        r.axis2.y,
        r.axis2.z,
        r.uncertainty1_rad,
        r.uncertainty2_rad,
        r.flexion_uncertainty_rad,
        r.for_axes ? 1.0f : 0.0f,
        r.for_flexion ? 1.0f : 0.0f,
        r.has_axes ? 1.0f : 0.0f,
        r.heading.heading_rad,
        r.joint_to_sensor1_m.x,
        r.joint_to_sensor1_m.y,
        r.joint_to_sensor1_m.z,
        r.joint_to_sensor2_m.x,
        r.joint_to_sensor2_m.y,
        r.joint_to_sensor2_m.z,
        v->evidence[0],
        v->evidence[1],
        v->evidence[2],
        v->opposite,
        v->share,
        v->bend_rad,
        v->stiffness,
        joint->point.lack / motion_s,
        joint->point.speed2,
        joint->sums.motion_s,
        joint->point.size[0],
        joint->point.size[1],
        joint->point.size[2],
        joint->gravity_off,
        joint->motion_s,
        joint->point.energy,
        (float)sample,
    };
    memcpy(row, values, sizeof(values));
}

int32_t jcal_batch_functional(const jcal_batch_functional_options_t *options, const jcal_batch_input_t *in,
                              jcal_batch_functional_out_t *out)
{
    jcal_functional_config_t config = jcal_functional_config_default();
    config.max_bound_rad = options->max_bound_rad;
    config.max_flexion_rad = options->max_flexion_rad;
    config.slices_per_s = options->slices_per_s;
    config.sign_hint = (jcal_sign_hint_t)options->sign_hint;
    jcal_functional_pair_t engine;
    if (jcal_functional_pair_init(&engine, &config, NULL) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    out->row_count = 0;
    uint32_t ticks = 0;
    for (size_t k = 0; k < in->count; k++) {
        const float *const v = in->values + k * VALUES_PER_PAIR;
        const jcal_pair_t pair = {
            .t_us = in->t_us[k],
            .imu1 = {.gyr_rad_s = {v[0], v[1], v[2]}, .acc_m_s2 = {v[3], v[4], v[5]}},
            .imu2 = {.gyr_rad_s = {v[6], v[7], v[8]}, .acc_m_s2 = {v[9], v[10], v[11]}},
        };
        (void)jcal_functional_pair_update(&engine, &pair);
        out->flexion[k] = jcal_functional_pair_flexion(&engine);
        if (engine.joint.ticks != ticks) {
            ticks = engine.joint.ticks;
            write_row(&engine, k, out->rows + out->row_count * JCAL_BATCH_FUNCTIONAL_COLUMNS);
            out->row_count++;
        }
    }
    return JCAL_BATCH_DONE;
}

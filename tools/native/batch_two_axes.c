/* SPDX-License-Identifier: MIT */
/* Runs a person's joint with two axes over arrays. */
#include "batch_two_axes.h"

#include <string.h>

/* ball/judge.h: that many judgements in a row found nothing against one joint */
#define AGREED 3u

void jcal_batch_two_axes_defaults(jcal_batch_two_axes_options_t *options)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    *options = (jcal_batch_two_axes_options_t){
        .max_heading_rad = config.ball.max_heading_rad,
        .max_lever_m = config.ball.max_lever_m,
        .max_bound_rad = config.max_bound_rad,
        .slices_per_s = config.ball.slices_per_s,
    };
}

static float flag(bool set)
{
    return set ? 1.0f : 0.0f;
}

static void write_row(const jcal_two_axes_pair_t *engine, size_t sample, float row[static JCAL_BATCH_TWO_AXES_COLUMNS])
{
    jcal_two_axes_result_t r;
    (void)jcal_two_axes_pair_get(engine, &r);
    const jcal_ball_t *const ball = &engine->joint.ball;
    const float motion_s = (ball->sums.motion_s > 0.0f) ? ball->sums.motion_s : 1.0f;
    const float values[JCAL_BATCH_TWO_AXES_COLUMNS] = {
        (float)r.ball.head.status,
        (float)r.ball.head.reason,
        (float)r.ball.head.weak,
        (float)r.ball.head.hint,
        flag(r.for_heading),
        flag(r.ball.for_center1),
        flag(r.ball.for_center2),
        flag(r.for_axis1),
        flag(r.for_axis2),
        r.ball.heading.heading_rad,
        r.ball.uncertainty_heading_rad,
        r.ball.joint_to_sensor1_m.x,
        r.ball.joint_to_sensor1_m.y,
        r.ball.joint_to_sensor1_m.z,
        r.ball.joint_to_sensor2_m.x,
        r.ball.joint_to_sensor2_m.y,
        r.ball.joint_to_sensor2_m.z,
        r.ball.uncertainty1_m,
        r.ball.uncertainty2_m,
        r.axis1.x,
        r.axis1.y,
        r.axis1.z,
        r.axis2.x,
        r.axis2.y,
        r.axis2.z,
        r.uncertainty1_rad,
        r.uncertainty2_rad,
        (float)r.windows1,
        (float)r.windows2,
        ball->point.lack / motion_s,
        ball->point.speed2,
        ball->verdict.stiffness,
        ball->sums.motion_s,
        flag(ball->verdict.agreed >= AGREED),
        (float)sample,
    };
    memcpy(row, values, sizeof(values));
}

static void write_quat(jcal_quat_t q, float *to)
{
    const float values[4] = {q.w, q.x, q.y, q.z};
    memcpy(to, values, sizeof(values));
}

int32_t jcal_batch_two_axes(const jcal_batch_two_axes_options_t *options, const jcal_batch_input_t *in,
                            jcal_batch_two_axes_out_t *out)
{
    jcal_two_axes_config_t config = jcal_two_axes_config_default();
    config.ball.max_heading_rad = options->max_heading_rad;
    config.ball.max_lever_m = options->max_lever_m;
    config.ball.slices_per_s = options->slices_per_s;
    config.max_bound_rad = options->max_bound_rad;
    jcal_two_axes_pair_t engine;
    if (jcal_two_axes_pair_init(&engine, &config, NULL) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    const jcal_two_axes_t fresh = engine.joint;
    out->row_count = 0;
    uint32_t ticks = 0;
    for (size_t k = 0; k < in->count; k++) {
        const jcal_pair_t pair = jcal_batch_pair(in, k);
        (void)jcal_two_axes_pair_update(&engine, &pair);
        if (k < (size_t)options->begin) {
            engine.joint = fresh;
        }
        write_quat(jcal_two_axes_pair_relative(&engine), out->relative + k * 4);
        write_quat(jcal_sensor_orientation(&engine.sensors.sensor1), out->turns + k * 8);
        write_quat(jcal_sensor_orientation(&engine.sensors.sensor2), out->turns + k * 8 + 4);
        if (engine.joint.ball.ticks.count != ticks) {
            ticks = engine.joint.ball.ticks.count;
            write_row(&engine, k, out->rows + out->row_count * JCAL_BATCH_TWO_AXES_COLUMNS);
            out->row_count++;
        }
    }
    return JCAL_BATCH_DONE;
}

/* SPDX-License-Identifier: MIT */
/* Any bytes as readings and as ticks of a joint with two axes, and with it of a ball joint: results keep what the headers promise, and what
 * is no motion of a joint never becomes ready. */
#include "bytes.h"
#include "jointcal/quat.h"
#include "jointcal/two_axes_pair.h"
#include "jointcal/vec3.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define LARGEST_M 1e9f
#define HALF_PI 1.5708f
#define PI 3.14160f
#define SLACK 1.25f

/* What is known is within its limits. */
static void check_known(const jcal_two_axes_result_t *r)
{
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    const jcal_ball_result_t *const b = &r->ball;
    require(!r->for_heading || (b->has_estimate && b->uncertainty_heading_rad < SLACK * config.ball.max_heading_rad));
    require(!b->for_center1 || (r->for_heading && b->uncertainty1_m < SLACK * config.ball.max_lever_m));
    require(!b->for_center2 || (r->for_heading && b->uncertainty2_m < SLACK * config.ball.max_lever_m));
    require(!r->for_axis1 || (r->uncertainty1_rad <= config.max_bound_rad && r->windows1 > 0u));
    require(!r->for_axis2 || (r->uncertainty2_rad <= config.max_bound_rad && r->windows2 > 0u));
    require((b->head.status != JCAL_READY) || (r->for_heading && r->for_axis1 && r->for_axis2));
}

static void check_axis(jcal_vec3_t axis, uint8_t windows, float uncertainty_rad)
{
    require((windows > 0u) ? is_unit(axis) : is_zero(axis));
    require(uncertainty_rad > 0.0f && uncertainty_rad <= HALF_PI);
    require(windows > 0u || uncertainty_rad > 1.57f);
}

static void check_result(const jcal_two_axes_result_t *r)
{
    const jcal_ball_result_t *const b = &r->ball;
    require_words(&b->head);
    check_known(r);
    check_axis(r->axis1, r->windows1, r->uncertainty1_rad);
    check_axis(r->axis2, r->windows2, r->uncertainty2_rad);
    require(b->has_estimate || (is_zero(b->joint_to_sensor1_m) && is_zero(b->joint_to_sensor2_m)));
    require(b->has_estimate || !b->heading.known);
    require(jcal_vec3_norm(b->joint_to_sensor1_m) < LARGEST_M && jcal_vec3_norm(b->joint_to_sensor2_m) < LARGEST_M);
    require(b->uncertainty_heading_rad > 0.0f && b->uncertainty_heading_rad <= HALF_PI);
    require(b->uncertainty1_m > 0.0f && b->uncertainty1_m <= JCAL_BOUND_UNKNOWN_M);
    require(b->uncertainty2_m > 0.0f && b->uncertainty2_m <= JCAL_BOUND_UNKNOWN_M);
    require(b->speed_m_s >= 0.0f && b->gravity_off_m_s2 >= 0.0f);
    require_within(b->heading.heading_rad, -PI, PI);
    require_within(b->progress_heading + b->progress_center1 + b->progress_center2, 0.0f, 3.0f);
    require_within(r->progress_axis1 + r->progress_axis2, 0.0f, 2.0f);
}

/* Ticks that are made up may be those of a perfect joint: their parts need not belong together. Those of readings must. */
static void check_joint(const jcal_two_axes_t *joint)
{
    jcal_two_axes_result_t result;
    const jcal_quat_t one = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    require(jcal_two_axes_get(joint, &result) == JCAL_OK);
    check_result(&result);
    const jcal_quat_t q = jcal_ball_relative(&joint->ball, one, one);
    const float square = (q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z);
    require(result.ball.heading.known ? (square > 0.999f && square < 1.001f) : isnan(square));
}

static void run_ticks(const uint8_t *data, size_t size, reading_t reading, unsigned repeats)
{
    static jcal_two_axes_t joint;
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    require(jcal_two_axes_init(&joint, &config) == JCAL_OK);
    uint64_t t_us = 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 2; at + TICK_BYTES <= size; at += TICK_BYTES) {
            const uint64_t step_us = step_of(data + at, reading, 5000u) * 4u;
            t_us += step_us;
            const float dt_s = (reading == AS_SENSOR) ? 1e-6f * (float)step_us : component(data + at, reading, 1.0f);
            const jcal_tick_t tick1 = tick_at(data + at + 2, reading, t_us, dt_s);
            const jcal_tick_t tick2 = tick_at(data + at + 70, reading, t_us, dt_s);
            const jcal_status_t added = jcal_two_axes_add(&joint, &tick1, &tick2);
            require(added == JCAL_OK || added == JCAL_REJECTED);
            for (int k = 0; k < 10 && jcal_two_axes_step(&joint) == JCAL_OK; k++) {
                check_joint(&joint);
            }
        }
    }
    check_joint(&joint);
}

#define SAMPLE_BYTES 26u /* 2 bytes of time step, 12 values of 2 bytes */

static void run_pair(const uint8_t *data, size_t size, reading_t reading, unsigned repeats)
{
    static jcal_two_axes_pair_t elbow;
    const jcal_two_axes_config_t config = jcal_two_axes_config_default();
    require(jcal_two_axes_pair_init(&elbow, &config, NULL) == JCAL_OK);
    uint64_t t_us = UINT64_MAX - 1000000u;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 2; at + SAMPLE_BYTES <= size; at += SAMPLE_BYTES) {
            t_us += step_of(data + at, reading, 5000u);
            const jcal_pair_t pair = {t_us, imu_at(data + at + 2, reading, 10.0f, 30.0f),
                                      imu_at(data + at + 14, reading, 10.0f, 30.0f)};
            const jcal_status_t status = jcal_two_axes_pair_update(&elbow, &pair);
            require(status == JCAL_OK || status == JCAL_REJECTED);
            check_joint(&elbow.joint);
            jcal_two_axes_result_t result;
            require(jcal_two_axes_pair_get(&elbow, &result) == JCAL_OK);
            check_result(&result);
            require(result.ball.head.status != JCAL_READY);
        }
    }
}

/* The first byte chooses what is run and how bytes are read, the second how often they are repeated; then come samples or ticks. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2) {
        return 0;
    }
    const reading_t reading = ((data[0] & 1u) != 0) ? AS_SENSOR : AS_FLOATS;
    const unsigned repeats = 1u + (data[1] >> 4);
    if ((data[0] & 2u) != 0) {
        run_pair(data, size, reading, repeats);
    } else {
        run_ticks(data, size, reading, 2u * repeats);
    }
    return 0;
}

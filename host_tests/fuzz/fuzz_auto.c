/* SPDX-License-Identifier: MIT */
/* Any bytes as samples of a hinge of either kind, and as ticks of the functional joint: results keep what the headers promise, and what
 * is no motion of a joint never becomes ready. */
#include "bytes.h"
#include "jointcal/functional.h"
#include "jointcal/hinge_auto.h"
#include "jointcal/quat.h"
#include "jointcal/sensor.h"
#include "jointcal/vec3.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define LARGEST_M 1e9f
#define HALF_PI 1.5708f
#define PI 3.14160f

/* Ready only for what is within its limits. */
static void check_ready(const jcal_functional_result_t *r)
{
    const jcal_functional_config_t config = jcal_functional_config_default();
    const float slack = 1.25f;
    require(r->has_axes && (r->for_axes || r->for_flexion));
    require(!r->for_axes ||
            (r->uncertainty1_rad < slack * config.max_bound_rad && r->uncertainty2_rad < slack * config.max_bound_rad));
    require(!r->for_flexion || r->flexion_uncertainty_rad < slack * config.max_flexion_rad);
}

static void check_functional(const jcal_functional_result_t *r)
{
    require_words(&r->head);
    if (r->head.status == JCAL_READY) {
        check_ready(r);
    } else {
        require(!r->for_axes && !r->for_flexion);
    }
    if (r->has_axes) {
        require(is_unit(r->axis1) && is_unit(r->axis2));
    } else {
        require(is_zero(r->axis1) && is_zero(r->axis2));
        require(is_zero(r->joint_to_sensor1_m) && is_zero(r->joint_to_sensor2_m));
    }
    require(jcal_vec3_norm(r->joint_to_sensor1_m) < LARGEST_M && jcal_vec3_norm(r->joint_to_sensor2_m) < LARGEST_M);
    require(r->uncertainty1_rad > 0.0f && r->uncertainty1_rad <= HALF_PI);
    require(r->uncertainty2_rad > 0.0f && r->uncertainty2_rad <= HALF_PI);
    require(r->flexion_uncertainty_rad > 0.0f && r->flexion_uncertainty_rad <= HALF_PI);
    require(r->rate_share >= 0.0f && r->sign_margin >= 0.0f && r->gravity_off_m_s2 >= 0.0f);
    require_within(r->bend_rad, 0.0f, PI);
    require_within(r->heading.heading_rad, -PI, PI);
    require_within(r->progress_axis1 + r->progress_axis2 + r->progress_sign, 0.0f, 3.0f);
}

static void check_auto(const jcal_hinge_auto_result_t *r)
{
    const jcal_hinge_result_t *const h = &r->hinge;
    require(h->head.status >= JCAL_COLLECTING && h->head.status <= JCAL_MOVED && h->head.status != JCAL_READY);
    require(r->ready_for == JCAL_FOR_NOTHING);
    require(h->has_axes ? (is_unit(h->axis1) && is_unit(h->axis2)) : (is_zero(h->axis1) && is_zero(h->axis2)));
    require_within(h->uncertainty1_rad, 0.0f, HALF_PI);
    require_within(h->uncertainty2_rad, 0.0f, HALF_PI);
    require_within(r->flexion_uncertainty_rad, 0.0f, HALF_PI);
    require_within(r->bend_rad, 0.0f, PI);
    require_within(r->heading.heading_rad, -PI, PI);
    require(h->sign_margin >= 0.0f && jcal_model_string(r->model) != NULL);
    require(jcal_vec3_norm(r->joint_to_sensor1_m) < LARGEST_M && jcal_vec3_norm(r->joint_to_sensor2_m) < LARGEST_M);
}

#define SAMPLE_BYTES 26u /* 2 bytes of time step, 12 values of 2 bytes */

/* Ticks that are made up may be those of a perfect joint: their parts need not belong together. Those of readings must. */
static void check_joint(const jcal_functional_t *joint, bool may_be_ready)
{
    jcal_functional_result_t result;
    const jcal_quat_t one = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    require(jcal_functional_get(joint, &result) == JCAL_OK);
    check_functional(&result);
    require(may_be_ready || result.head.status != JCAL_READY);
    const float flexion = jcal_functional_flexion(joint, one, one);
    require(result.has_axes ? (flexion >= -PI && flexion <= PI) : isnan(flexion));
}

static void run_ticks(const uint8_t *data, size_t size, reading_t reading, unsigned repeats)
{
    static jcal_functional_t joint;
    const jcal_functional_config_t config = jcal_functional_config_default();
    require(jcal_functional_init(&joint, &config) == JCAL_OK);
    uint64_t t_us = 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 2; at + TICK_BYTES <= size; at += TICK_BYTES) {
            const uint64_t step_us = step_of(data + at, reading, 5000u) * 4u;
            t_us += step_us;
            const float dt_s = (reading == AS_SENSOR) ? 1e-6f * (float)step_us : component(data + at, reading, 1.0f);
            const jcal_tick_t tick1 = tick_at(data + at + 2, reading, t_us, dt_s);
            const jcal_tick_t tick2 = tick_at(data + at + 70, reading, t_us, dt_s);
            const jcal_status_t added = jcal_functional_add(&joint, &tick1, &tick2);
            require(added == JCAL_OK || added == JCAL_REJECTED);
            for (int k = 0; k < 10 && jcal_functional_step(&joint) == JCAL_OK; k++) {
                check_joint(&joint, true);
            }
        }
    }
    check_joint(&joint, true);
}

static jcal_pair_t pair_at(const uint8_t *data, reading_t reading, uint64_t t_us)
{
    const jcal_pair_t pair = {t_us, imu_at(data + 2, reading, 10.0f, 30.0f), imu_at(data + 14, reading, 10.0f, 30.0f)};
    return pair;
}

/* Both sensors' stages without a gate before them. */
static void run_sensors(const uint8_t *data, size_t size, reading_t reading, unsigned repeats)
{
    static jcal_sensor_t sensors[2];
    static jcal_functional_t joint;
    const jcal_functional_config_t config = jcal_functional_config_default();
    require(jcal_functional_init(&joint, &config) == JCAL_OK);
    require(jcal_sensor_init(&sensors[0]) == JCAL_OK && jcal_sensor_init(&sensors[1]) == JCAL_OK);
    uint64_t t_us = 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 2; at + SAMPLE_BYTES <= size; at += SAMPLE_BYTES) {
            t_us += step_of(data + at, reading, 5000u);
            const jcal_pair_t pair = pair_at(data + at, reading, t_us);
            const jcal_reading_t readings[2] = {{t_us, pair.imu1}, {t_us, pair.imu2}};
            const jcal_status_t of1 = jcal_sensor_push(&sensors[0], &readings[0]);
            const jcal_status_t of2 = jcal_sensor_push(&sensors[1], &readings[1]);
            if (of1 == JCAL_TICK && of2 == JCAL_TICK) {
                (void)jcal_functional_add(&joint, jcal_sensor_tick(&sensors[0]), jcal_sensor_tick(&sensors[1]));
            }
            (void)jcal_functional_step(&joint);
            check_joint(&joint, false);
            const jcal_quat_t q = jcal_sensor_orientation(&sensors[0]);
            require_within((q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z), 0.999f, 1.001f);
        }
    }
}

static void run_auto(const uint8_t *data, size_t size, reading_t reading, unsigned repeats)
{
    static jcal_hinge_auto_t hinge;
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    require(jcal_hinge_auto_init(&hinge, &config) == JCAL_OK);
    uint64_t t_us = UINT64_MAX - 1000000u;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 2; at + SAMPLE_BYTES <= size; at += SAMPLE_BYTES) {
            t_us += step_of(data + at, reading, 5000u);
            const jcal_pair_t pair = pair_at(data + at, reading, t_us);
            const jcal_status_t status = jcal_hinge_auto_update(&hinge, &pair);
            require(status == JCAL_OK || status == JCAL_REJECTED);
            jcal_hinge_auto_result_t result;
            require(jcal_hinge_auto_get(&hinge, &result) == JCAL_OK);
            check_auto(&result);
            const float flexion = jcal_hinge_auto_flexion(&hinge);
            require(isnan(flexion) || (flexion >= -PI && flexion <= PI));
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
    switch ((data[0] >> 1) % 3u) {
    case 0:
        run_auto(data, size, reading, (repeats + 3u) / 4u);
        break;
    case 1:
        run_sensors(data, size, reading, repeats);
        break;
    default:
        run_ticks(data, size, reading, 2u * repeats);
        break;
    }
    return 0;
}

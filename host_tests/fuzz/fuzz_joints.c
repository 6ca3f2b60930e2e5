/* SPDX-License-Identifier: MIT */
/* Any bytes as samples of joints with two axes, joint centres, and hip and knee: results keep what the headers promise. */
#include "bytes.h"
#include "jointcal/jointcal.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

enum { N_MAX = 60 };
#define SAMPLE_BYTES 62u /* 2 bytes of time step, 18 values and 3 orientations of 2 bytes each */

static jcal_two_dof_t two_dof;
static jcal_two_dof_window_t two_dof_window;
static uint64_t two_dof_storage[JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t) + 1u];
static jcal_center_t center;
static jcal_center_window_t center_window;
static uint64_t center_storage[JCAL_CENTER_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t) + 1u];
static jcal_chain_t chain;

static void require_counts(const uint32_t *by, uint32_t samples, uint32_t rejected, uint32_t pushed)
{
    uint32_t sum = 0;
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        sum += by[k];
    }
    require(samples == pushed && rejected == sum && sum <= pushed);
}

static void check_two_dof(const jcal_two_dof_result_t *r, uint32_t pushed)
{
    require_counts(r->head.rejected_by, r->head.samples, r->head.rejected, pushed);
    require_words(&r->head);
    require(!r->has_axes || (is_unit(r->axis1) && is_unit(r->axis2)));
    require_within(r->uncertainty1_rad, 0.0f, 1.5708f);
    require_within(r->uncertainty2_rad, 0.0f, 1.5708f);
    require_within(r->uncertainty_heading_rad, 0.0f, 1.5708f);
    require_within(r->heading_offset_rad, -3.1416f, 3.1416f);
    require_within(r->carrying_angle_rad, -1.5708f, 1.5708f);
    require_within(r->progress_axis1 + r->progress_axis2 + r->progress_heading, 0.0f, 3.0f);
    const float limit_rad = 2.0f * jcal_two_dof_config_default().max_bound_rad;
    require(r->head.status != JCAL_READY ||
            (r->has_axes && r->uncertainty1_rad < limit_rad && r->uncertainty2_rad < limit_rad));
}

static void check_center(const jcal_center_result_t *r, uint32_t pushed)
{
    require_counts(r->head.rejected_by, r->head.samples, r->head.rejected, pushed);
    require_words(&r->head);
    require(jcal_vec3_is_finite(r->joint_to_sensor1_m) && jcal_vec3_is_finite(r->joint_to_sensor2_m));
    require(jcal_vec3_is_finite(r->acc_bias1_m_s2) && jcal_vec3_is_finite(r->acc_bias2_m_s2));
    require_within(r->uncertainty1_m, 0.0f, JCAL_BOUND_UNKNOWN_M);
    require_within(r->uncertainty2_m, 0.0f, JCAL_BOUND_UNKNOWN_M);
    require_within(r->misfit, 0.0f, 1.0f);
    require_within(r->progress1 + r->progress2, 0.0f, 2.0f);
    const float limit_m = 2.0f * jcal_center_config_default().max_bound_m;
    require(r->head.status != JCAL_READY ||
            (r->has_center && r->uncertainty1_m < limit_m && r->uncertainty2_m < limit_m));
}

static void check_chain(uint32_t pushed)
{
    jcal_chain_result_t r;
    require(jcal_chain_get(&chain, &r) == JCAL_OK);
    require_counts(r.head.rejected_by, r.head.samples, r.head.rejected, pushed);
    require_words(&r.head);
    for (int k = 0; k < JCAL_CHAIN_PLACES; k++) {
        require(jcal_vec3_is_finite(r.place_m[k]));
        require_within(r.uncertainty_m[k], 0.0f, JCAL_BOUND_UNKNOWN_M);
    }
    require_within(r.segment_length_m, 0.0f, 1e6f);
    require_within(r.uncertainty_segment_m, 0.0f, 1e6f);
}

/* Of unit length if it is read as a sensor's. */
static jcal_quat_t quat_at(const uint8_t *data, reading_t reading)
{
    float v[4];
    for (size_t k = 0; k < 4; k++) {
        v[k] = component(data + 2 * k, reading, 1.0f);
    }
    const jcal_quat_t q = jcal_quat(v[0], v[1], v[2], v[3]);
    return (reading == AS_SENSOR) ? jcal_quat_normalise(q) : q;
}

static void require_push(jcal_status_t status)
{
    require(status == JCAL_OK || status == JCAL_REJECTED);
}

static void begin(uint8_t choice)
{
    jcal_two_dof_config_t two_dof_config = jcal_two_dof_config_default();
    jcal_two_dof_window_config_t two_dof_window_config = jcal_two_dof_window_config_default();
    jcal_center_config_t center_config = jcal_center_config_default();
    jcal_chain_config_t chain_config = jcal_chain_config_default();
    two_dof_config.constraint = (jcal_constraint_t)(choice % 3u);
    two_dof_window_config.two_dof.constraint =
        ((choice & 1u) != 0u) ? JCAL_CONSTRAINT_ROTATION : JCAL_CONSTRAINT_ORIENTATION;
    two_dof_window_config.n_max = N_MAX;
    center_config.method = (jcal_center_method_t)(choice % 3u);
    chain_config.center = center_config;
    chain_config.segment_length_m = ((choice & 4u) != 0u) ? 0.4f : 0.0f;
    const jcal_center_window_config_t center_window_config = {center_config, N_MAX};
    require(jcal_two_dof_init(&two_dof, &two_dof_config) == JCAL_OK);
    require(jcal_two_dof_window_init(&two_dof_window, &two_dof_window_config, two_dof_storage,
                                     sizeof two_dof_storage) == JCAL_OK);
    require(jcal_center_init(&center, &center_config) == JCAL_OK);
    require(jcal_center_window_init(&center_window, &center_window_config, center_storage, sizeof center_storage) ==
            JCAL_OK);
    require(jcal_chain_init(&chain, &chain_config) == JCAL_OK);
}

static void push_all(const uint8_t *data, reading_t reading, uint64_t t_us)
{
    const jcal_triple_t triple = {t_us, imu_at(data + 2, reading, 10.0f, 30.0f),
                                  imu_at(data + 14, reading, 10.0f, 30.0f), imu_at(data + 26, reading, 10.0f, 30.0f)};
    const jcal_triple_attitudes_t q = {quat_at(data + 38, reading), quat_at(data + 46, reading),
                                       quat_at(data + 54, reading)};
    const jcal_pair_t pair = {t_us, triple.imu1, triple.imu2};
    const jcal_attitudes_t attitudes = {q.q1, q.q2};
    const jcal_orientation_pair_t poses = {t_us, q.q1, q.q2};
    require_push(jcal_two_dof_update(&two_dof, &poses));
    require_push(jcal_two_dof_window_update(&two_dof_window, &poses));
    require_push(jcal_center_push_oriented(&center, &pair, &attitudes));
    (void)jcal_center_step(&center);
    require_push(jcal_center_window_push_oriented(&center_window, &pair, &attitudes));
    (void)jcal_center_window_step(&center_window);
    require_push(jcal_chain_push(&chain, &triple, &q));
    (void)jcal_chain_step(&chain);
}

static void check_all(uint32_t pushed)
{
    jcal_two_dof_result_t axes;
    jcal_center_result_t place;
    require(jcal_two_dof_get(&two_dof, &axes) == JCAL_OK);
    check_two_dof(&axes, pushed);
    require(jcal_two_dof_window_get(&two_dof_window, &axes) == JCAL_OK);
    check_two_dof(&axes, pushed);
    require(jcal_center_get(&center, &place) == JCAL_OK);
    check_center(&place, pushed);
    require(jcal_center_window_get(&center_window, &place) == JCAL_OK);
    check_center(&place, pushed);
    check_chain(pushed);
}

/* The first byte chooses the reading and how often the samples are repeated, the second one the methods; then come samples. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    if (size < 2) {
        return 0;
    }
    begin(data[1]);
    const reading_t reading = ((data[0] & 1u) != 0) ? AS_SENSOR : AS_FLOATS;
    const unsigned repeats = 1u + (data[0] >> 5);
    uint64_t t_us = (data[0] & 2u) != 0 ? UINT64_MAX - 1000000u : 0;
    uint32_t pushed = 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 2; at + SAMPLE_BYTES <= size; at += SAMPLE_BYTES) {
            t_us += step_of(data + at, reading, 5000u);
            push_all(data + at, reading, t_us);
            check_all(++pushed);
        }
    }
    return 0;
}

/* SPDX-License-Identifier: MIT */
/* Any bytes as samples: whatever is pushed, results keep what the headers promise. */
#include "bytes.h"
#include "jointcal/jointcal.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

/* Room for the config below, which is checked. */
#define STORAGE_BYTES 65536

static bool is_fraction(float value)
{
    return value >= 0.0f && value <= 1.0f;
}

static void check_counts(const jcal_hinge_result_t *result, uint32_t pushed)
{
    uint32_t sum = 0;
    for (int k = 0; k < JCAL_REJECT_COUNT; k++) {
        sum += result->head.rejected_by[k];
    }
    require(result->head.samples == pushed && result->head.rejected == sum && sum <= pushed);
}

static void check_result(const jcal_hinge_result_t *result, jcal_engine_t engine, uint32_t pushed)
{
    check_counts(result, pushed);
    require(result->head.engine == engine);
    require(result->head.status >= JCAL_COLLECTING && result->head.status <= JCAL_MOVED);
    require(jcal_calibration_string(result->head.status) != NULL);
    if (result->has_axes) {
        require(is_unit(result->axis1) && is_unit(result->axis2));
    } else {
        require(is_zero(result->axis1) && is_zero(result->axis2));
    }
    /* Written so that NaN fails. */
    require(result->uncertainty1_rad >= 0.0f && result->uncertainty1_rad <= 1.5708f);
    require(result->uncertainty2_rad >= 0.0f && result->uncertainty2_rad <= 1.5708f);
    require(result->sign_margin >= 0.0f);
    require(is_fraction(result->progress_axis1) && is_fraction(result->progress_axis2));
    require(is_fraction(result->progress_sign));
    if (result->head.status == JCAL_READY) {
        const float bound_rad = jcal_hinge_config_default().max_bound_rad;
        require(result->has_axes && result->uncertainty1_rad < 2.0f * bound_rad &&
                result->uncertainty2_rad < 2.0f * bound_rad);
    }
}

#define SAMPLE_BYTES 26u /* 2 bytes of time step, 12 values of 2 bytes */

static jcal_pair_t sample(const uint8_t *data, reading_t reading, uint64_t *t_us)
{
    *t_us += step_of(data, reading, 5000u);
    const jcal_pair_t pair = {*t_us, imu_at(data + 2, reading, 10.0f, 30.0f), imu_at(data + 14, reading, 10.0f, 30.0f)};
    return pair;
}

static void require_push(jcal_status_t status)
{
    require(status == JCAL_OK || status == JCAL_REJECTED);
}

static void check_both(const jcal_hinge_t *stream, const jcal_hinge_window_t *window, uint32_t pushed)
{
    jcal_hinge_result_t result;
    require(jcal_hinge_get(stream, &result) == JCAL_OK);
    check_result(&result, JCAL_ENGINE_STREAM, pushed);
    require(jcal_hinge_window_get(window, &result) == JCAL_OK);
    check_result(&result, JCAL_ENGINE_WINDOW, pushed);
}

/* The first byte chooses the reading and how often the samples are repeated; then come samples. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static jcal_hinge_t stream;
    static jcal_hinge_window_t window;
    static uint64_t storage[STORAGE_BYTES / sizeof(uint64_t)];
    const jcal_hinge_config_t stream_config = jcal_hinge_config_default();
    jcal_hinge_window_config_t window_config = jcal_hinge_window_config_default();
    window_config.n_max = 24; /* few samples: the same code in a fraction of the time, and the buffers fill */
    window_config.acc_min = 8;
    require(jcal_hinge_window_storage_bytes(&window_config) <= sizeof storage);
    require(jcal_hinge_init(&stream, &stream_config) == JCAL_OK);
    require(jcal_hinge_window_init(&window, &window_config, storage, sizeof storage) == JCAL_OK);
    if (size == 0) {
        return 0;
    }
    const reading_t reading = ((data[0] & 1u) != 0) ? AS_SENSOR : AS_FLOATS;
    const unsigned repeats = 1u + (data[0] >> 6);
    uint64_t t_us = (data[0] & 2u) != 0 ? UINT64_MAX - 1000000u : 0;
    uint32_t pushed = 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 1; at + SAMPLE_BYTES <= size; at += SAMPLE_BYTES) {
            const jcal_pair_t pair = sample(data + at, reading, &t_us);
            require_push(jcal_hinge_update(&stream, &pair));
            require_push(jcal_hinge_window_update(&window, &pair));
            check_both(&stream, &window, ++pushed);
        }
    }
    return 0;
}

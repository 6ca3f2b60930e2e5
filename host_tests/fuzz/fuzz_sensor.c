/* SPDX-License-Identifier: MIT */
/* Any bytes as readings of one sensor: orientation, bias and features keep what the headers promise. */
#include "bytes.h"
#include "jointcal/jointcal.h"

#include <math.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

#define READING_BYTES 14u /* 2 bytes of time step, 6 values of 2 bytes */

static jcal_reading_t reading_at(const uint8_t *data, reading_t kind, uint64_t *t_us)
{
    *t_us += step_of(data, kind, 1u);
    const jcal_reading_t reading = {*t_us, imu_at(data + 2, kind, 35.0f, 160.0f)};
    return reading;
}

static void check_tick(const jcal_tick_t *tick, uint64_t t_us)
{
    require(tick->t_us == t_us && tick->epoch > 0 && tick->dt_s > 0.0f && tick->dt_s < 0.16f);
    require(tick->since_s > 0.0f && tick->since_s <= 1000.0f && isfinite(tick->acc_level_m_s2));
    require(jcal_vec3_is_finite(tick->velocity) && jcal_vec3_is_finite(tick->gyr));
    for (int k = 0; k < 9; k++) {
        require(fabsf(tick->turn[k]) < 1.00001f && isfinite(tick->rate[k]) && isfinite(tick->lever[k]));
    }
}

static void check(const jcal_sensor_t *sensor)
{
    const jcal_quat_t q = jcal_sensor_orientation(sensor);
    const jcal_vec3_t b = jcal_sensor_gyr_bias(sensor);
    require(fabsf(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1.0f) < 1e-5f);
    require(fabsf(b.x) < 0.035f && fabsf(b.y) < 0.035f && fabsf(b.z) < 0.035f);
    require(sensor->bias.p[0] > 0.0f && sensor->bias.p[3] > 0.0f && sensor->bias.p[5] > 0.0f);
}

/* The first byte chooses the kind and how often the readings are repeated; then come readings. */
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static jcal_sensor_t sensor;
    require(jcal_sensor_init(&sensor) == JCAL_OK);
    if (size == 0) {
        return 0;
    }
    const reading_t kind = ((data[0] & 1u) != 0) ? AS_SENSOR : AS_FLOATS;
    const unsigned repeats = 1u + (data[0] >> 4);
    uint64_t t_us = (data[0] & 2u) != 0 ? UINT64_MAX - 1000000u : 0;
    for (unsigned repeat = 0; repeat < repeats; repeat++) {
        for (size_t at = 1; at + READING_BYTES <= size; at += READING_BYTES) {
            const jcal_reading_t reading = reading_at(data + at, kind, &t_us);
            const jcal_status_t status = jcal_sensor_push(&sensor, &reading);
            require(status == JCAL_OK || status == JCAL_REJECTED || status == JCAL_TICK);
            if (status == JCAL_TICK) {
                check_tick(jcal_sensor_tick(&sensor), reading.t_us);
            }
            check(&sensor);
        }
    }
    return 0;
}

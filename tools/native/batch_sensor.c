/* SPDX-License-Identifier: MIT */
/* Runs the sensor stage over arrays. */
#include "batch_sensor.h"

#include <string.h>

static void write_tick(const jcal_tick_t *tick, float row[static JCAL_BATCH_TICK_COLUMNS])
{
    memcpy(row, tick->turn, sizeof(tick->turn));
    memcpy(row + 9, tick->rate, sizeof(tick->rate));
    memcpy(row + 18, tick->lever, sizeof(tick->lever));
    const float rest[] = {tick->velocity.x, tick->velocity.y,     tick->velocity.z, tick->gyr.x,   tick->gyr.y,
                          tick->gyr.z,      tick->acc_level_m_s2, tick->dt_s,       tick->since_s, (float)tick->epoch};
    memcpy(row + 27, rest, sizeof(rest));
}

int32_t jcal_batch_sensor(const uint64_t *t_us, const float *values, size_t count, jcal_batch_sensor_out_t *out)
{
    jcal_sensor_t sensor;
    if (jcal_sensor_init(&sensor) != JCAL_OK) {
        return JCAL_BATCH_CONFIG;
    }
    out->tick_count = 0;
    for (size_t k = 0; k < count; k++) {
        const float *const v = values + k * 6;
        const jcal_reading_t reading = {t_us[k], {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
        if (jcal_sensor_push(&sensor, &reading) == JCAL_TICK) {
            const jcal_tick_t *const tick = jcal_sensor_tick(&sensor);
            out->tick_us[out->tick_count] = tick->t_us;
            write_tick(tick, out->ticks + out->tick_count * JCAL_BATCH_TICK_COLUMNS);
            out->tick_count++;
        }
        const jcal_quat_t q = sensor.attitude.q_s_e; /* R of the features; what is given is half a sample further on */
        const jcal_vec3_t b = jcal_sensor_gyr_bias(&sensor);
        const float orientation[] = {q.w, q.x, q.y, q.z};
        const float bias[] = {b.x, b.y, b.z};
        memcpy(out->orientations + k * 4, orientation, sizeof(orientation));
        memcpy(out->biases + k * 3, bias, sizeof(bias));
    }
    return JCAL_BATCH_DONE;
}

/* SPDX-License-Identifier: MIT */
/* Runs the pairing and the estimate of the lag over arrays. */
#include "batch_pairing.h"

#include "jointcal/lag.h"
#include "jointcal/sensor.h"

#include <string.h>

typedef struct {
    jcal_pairing_t pairing;
    jcal_lag_t lag;
    jcal_sensor_t sensor1, sensor2;
} run_t;

static bool begin(run_t *run, const jcal_batch_pairing_in_t *in)
{
    const jcal_pairing_config_t config = {in->period_s, in->gap_s};
    return (jcal_pairing_init(&run->pairing, &config) == JCAL_OK) && (jcal_lag_init(&run->lag) == JCAL_OK) &&
           (jcal_sensor_init(&run->sensor1) == JCAL_OK) && (jcal_sensor_init(&run->sensor2) == JCAL_OK);
}

static void learn(run_t *run, const jcal_pair_t *pair)
{
    const jcal_reading_t reading1 = {pair->t_us, pair->imu1};
    const jcal_reading_t reading2 = {pair->t_us, pair->imu2};
    const jcal_status_t of1 = jcal_sensor_push(&run->sensor1, &reading1);
    const jcal_status_t of2 = jcal_sensor_push(&run->sensor2, &reading2);
    if ((of1 == JCAL_TICK) && (of2 == JCAL_TICK)) {
        (void)jcal_lag_add(&run->lag, jcal_sensor_tick(&run->sensor1), jcal_sensor_tick(&run->sensor2));
    }
    (void)jcal_lag_step(&run->lag);
    (void)jcal_pairing_align(&run->pairing, &run->lag);
}

static void write(const run_t *run, const jcal_pair_t *pair, jcal_batch_pairing_out_t *out)
{
    const jcal_imu_t *const a = &pair->imu1;
    const jcal_imu_t *const b = &pair->imu2;
    const float row[JCAL_BATCH_PAIR_COLUMNS] = {a->gyr_rad_s.x, a->gyr_rad_s.y, a->gyr_rad_s.z, a->acc_m_s2.x,
                                                a->acc_m_s2.y,  a->acc_m_s2.z,  b->gyr_rad_s.x, b->gyr_rad_s.y,
                                                b->gyr_rad_s.z, b->acc_m_s2.x,  b->acc_m_s2.y,  b->acc_m_s2.z};
    jcal_lag_result_t lag = {0};
    (void)jcal_lag_get(&run->lag, &lag);
    const float known[JCAL_BATCH_LAG_COLUMNS] = {
        lag.lag_known ? 1.0f : 0.0f, lag.lag_s, lag.bound_s, lag.taken_s, lag.left, lag.motion_s};
    out->t_us[out->count] = pair->t_us;
    memcpy(out->pairs + out->count * JCAL_BATCH_PAIR_COLUMNS, row, sizeof(row));
    memcpy(out->lags + out->count * JCAL_BATCH_LAG_COLUMNS, known, sizeof(known));
    out->count++;
}

int32_t jcal_batch_pairing(const jcal_batch_pairing_in_t *in, jcal_batch_pairing_out_t *out)
{
    run_t run;
    if (!begin(&run, in)) {
        return JCAL_BATCH_CONFIG;
    }
    out->count = 0;
    for (size_t k = 0; k < in->count; k++) {
        const float *const v = in->values + k * 6;
        const jcal_reading_t reading = {in->t_us[k], {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}}};
        (void)jcal_pairing_push(&run.pairing, in->which[k], &reading);
        jcal_pair_t pair;
        while ((out->count < out->room) && (jcal_pairing_pull(&run.pairing, &pair) == JCAL_OK)) {
            if (in->with_lag != 0) {
                learn(&run, &pair);
            }
            write(&run, &pair, out);
        }
    }
    return JCAL_BATCH_DONE;
}

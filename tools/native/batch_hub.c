/* SPDX-License-Identifier: MIT */
/* Runs a hub over arrays of packets. */
#include "batch_hub.h"

#include "jointcal/sensor.h"

#include <math.h>
#include <string.h>

#define SLOTS 16u
/* What a hinge learnt with times that were off by less it keeps, s. */
#define ANEW_S 0.02f

typedef struct {
    jcal_packets_t packets[2];
    jcal_pairing_t pairing;
    jcal_sensor_t sensor[2];
    jcal_lag_t lag;
    jcal_hinge_auto_t hinge;
    bool knew_lag;
    unsigned char storage[2][JCAL_PACKETS_STORAGE_BYTES(SLOTS, JCAL_PACKET_READINGS_MAX, JCAL_PACKET_SI)];
} hub_t;

static bool begin_sender(hub_t *hub, unsigned k, const jcal_batch_sender_t *sender)
{
    jcal_packet_config_t config = jcal_packet_config_default();
    config.period_ns = sender->period_ns;
    config.counter_bits = (uint8_t)sender->counter_bits;
    config.per_packet = (uint8_t)sender->per_packet;
    config.packets = SLOTS;
    config.max_delay_s = sender->max_delay_s;
    config.values = (sender->is_raw != 0) ? JCAL_PACKET_RAW : JCAL_PACKET_SI;
    const bool has_scale =
        (sender->is_raw == 0) || (jcal_chip_scale("LSM6DSV", 2000.0f, 16.0f, &config.scale) == JCAL_OK);
    return has_scale &&
           (jcal_packets_init(&hub->packets[k], &config, hub->storage[k], sizeof(hub->storage[k])) == JCAL_OK) &&
           (jcal_sensor_init(&hub->sensor[k]) == JCAL_OK);
}

static bool begin_hinge(hub_t *hub)
{
    const jcal_hinge_auto_config_t config = jcal_hinge_auto_config_default();
    return jcal_hinge_auto_init(&hub->hinge, &config) == JCAL_OK;
}

static bool begin(hub_t *hub, const jcal_batch_hub_in_t *in)
{
    const jcal_pairing_config_t config = jcal_pairing_config_default();
    hub->knew_lag = false;
    return (jcal_pairing_init(&hub->pairing, &config) == JCAL_OK) && (jcal_lag_init(&hub->lag) == JCAL_OK) &&
           begin_hinge(hub) && begin_sender(hub, 0, &in->sender[0]) && begin_sender(hub, 1, &in->sender[1]);
}

static void learn(hub_t *hub, const jcal_pair_t *pair, jcal_batch_hub_out_t *out)
{
    const jcal_reading_t reading1 = {pair->t_us, pair->imu1};
    const jcal_reading_t reading2 = {pair->t_us, pair->imu2};
    const jcal_status_t of1 = jcal_sensor_push(&hub->sensor[0], &reading1);
    const jcal_status_t of2 = jcal_sensor_push(&hub->sensor[1], &reading2);
    if ((of1 == JCAL_TICK) && (of2 == JCAL_TICK)) {
        (void)jcal_lag_add(&hub->lag, jcal_sensor_tick(&hub->sensor[0]), jcal_sensor_tick(&hub->sensor[1]));
    }
    (void)jcal_lag_step(&hub->lag);
    jcal_pairing_result_t before;
    jcal_pairing_result_t after;
    (void)jcal_pairing_get(&hub->pairing, &before);
    if (jcal_pairing_align(&hub->pairing, &hub->lag) == JCAL_OK) {
        (void)jcal_pairing_get(&hub->pairing, &after);
        out->taken++;
        if (fabsf(after.shift_s - before.shift_s) > ANEW_S) {
            (void)begin_hinge(hub);
        }
    }
}

static void write(const hub_t *hub, const jcal_lag_result_t *lag, const jcal_pair_t *pair, jcal_batch_hub_out_t *out)
{
    jcal_hinge_auto_result_t r = {0};
    (void)jcal_hinge_auto_get(&hub->hinge, &r);
    const jcal_hinge_result_t *const h = &r.hinge;
    const float row[JCAL_BATCH_HUB_COLUMNS] = {(float)h->head.status,
                                               (float)r.ready_for,
                                               (float)r.model,
                                               h->axis1.x,
                                               h->axis1.y,
                                               h->axis1.z,
                                               h->axis2.x,
                                               h->axis2.y,
                                               h->axis2.z,
                                               h->uncertainty1_rad,
                                               h->uncertainty2_rad,
                                               r.flexion_uncertainty_rad,
                                               lag->lag_known ? 1.0f : 0.0f,
                                               lag->lag_s,
                                               lag->bound_s,
                                               lag->taken_s};
    out->pair_us[out->pair_count] = pair->t_us;
    memcpy(out->rows + out->pair_count * JCAL_BATCH_HUB_COLUMNS, row, sizeof(row));
    out->pair_count++;
}

static void pairs_of(hub_t *hub, unsigned which, const jcal_reading_t *reading, jcal_batch_hub_out_t *out)
{
    jcal_pair_t pair;
    (void)jcal_pairing_push(&hub->pairing, which, reading);
    while ((out->pair_count < out->room) && (jcal_pairing_pull(&hub->pairing, &pair) == JCAL_OK)) {
        jcal_lag_result_t lag = {0};
        learn(hub, &pair, out);
        (void)jcal_lag_get(&hub->lag, &lag);
        hub->knew_lag = hub->knew_lag || lag.lag_known;
        if (hub->knew_lag) {
            (void)jcal_hinge_auto_update(&hub->hinge, &pair);
        }
        write(hub, &lag, &pair, out);
    }
}

static void keep(jcal_batch_hub_readings_t *to, const jcal_reading_t *reading)
{
    if (to->count < to->room) {
        const jcal_imu_t *const imu = &reading->imu;
        const float values[6] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                                 imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
        to->t_us[to->count] = reading->t_us;
        memcpy(to->values + to->count * 6u, values, sizeof(values));
    }
    to->count++;
}

int32_t jcal_batch_hub(const jcal_batch_hub_in_t *in, jcal_batch_hub_out_t *out)
{
    static hub_t hub;
    if (!begin(&hub, in)) {
        return JCAL_BATCH_CONFIG;
    }
    for (size_t k = 0; k < in->count; k++) {
        const unsigned from = in->which[k];
        const jcal_batch_sender_t *const sender = &in->sender[from];
        const size_t at = 6u * (size_t)in->at[k];
        const jcal_packet_t packet = {in->arrival_us[k], in->counter[k], in->readings[k],
                                      (sender->is_raw != 0) ? sender->raw + at : NULL,
                                      (sender->is_raw != 0) ? NULL : sender->si + at};
        (void)jcal_packets_push(&hub.packets[from], &packet);
        jcal_reading_t reading;
        jcal_status_t status = JCAL_OK;
        while (status == JCAL_OK || status == JCAL_REJECTED) {
            status = jcal_packets_pull(&hub.packets[from], &reading);
            if (status == JCAL_OK) {
                keep(&out->readings[from], &reading);
                pairs_of(&hub, from + 1u, &reading, out);
            }
        }
    }
    (void)jcal_packets_get(&hub.packets[0], &out->packets[0]);
    (void)jcal_packets_get(&hub.packets[1], &out->packets[1]);
    (void)jcal_pairing_get(&hub.pairing, &out->pairing);
    return JCAL_BATCH_DONE;
}

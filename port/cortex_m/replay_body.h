/* SPDX-License-Identifier: MIT */
/* A body for replay.c: sensor 0 reads what sensor 1 of the recording reads, the fifteen others what its sensor 2 does, so that all joints are
 * busy at the same moments. Packets of four raw readings, whose turns are spread over the sensors. With REPLAY_IN_STEP no lag is looked for. */
#ifndef REPLAY_BODY_H
#define REPLAY_BODY_H

#include "jointcal/body.h"

enum { BODY_SENSORS = 16, BODY_JOINTS = 15, BODY_SLOTS = 8, BODY_PER_PACKET = 4, BODY_UNITS = 80 };

typedef jcal_pair_t sample_t;
typedef jcal_body_joint_result_t result_t;

/* All that a body needs. */
typedef struct {
    jcal_body_t body;
    jcal_body_sensor_t sensors[BODY_SENSORS];
    jcal_body_joint_t joints[BODY_JOINTS];
    jcal_functional_t hinges[BODY_JOINTS];
    unsigned char storage[BODY_SENSORS][JCAL_PACKETS_STORAGE_BYTES(BODY_SLOTS, BODY_PER_PACKET, JCAL_PACKET_RAW)];
    jcal_body_shared_t shared;
    jcal_health_t health;
} whole_body_t;

static whole_body_t replayed;
/* On a hub these would be constants. */
static jcal_packet_config_t body_packets;
static jcal_body_sensor_spec_t body_sensors[BODY_SENSORS];
static jcal_body_joint_spec_t body_joints[BODY_JOINTS];
static int16_t body_raw[BODY_SENSORS][BODY_PER_PACKET * JCAL_PACKET_VALUES];
static uint32_t body_counter;

static jcal_status_t engine_init(void)
{
    const jcal_functional_config_t settings = jcal_functional_config_default();
    const jcal_body_config_t config = jcal_body_config_default();
    body_packets = jcal_packet_config_default();
    body_packets.per_packet = BODY_PER_PACKET;
    body_packets.packets = BODY_SLOTS;
    body_packets.values = JCAL_PACKET_RAW;
    jcal_status_t status = jcal_chip_scale("LSM6DSV", 2000.0f, 16.0f, &body_packets.scale);
    for (unsigned s = 0; s < BODY_SENSORS; ++s) {
        const jcal_body_sensor_spec_t spec = {NULL, &body_packets, replayed.storage[s], sizeof(replayed.storage[s]),
                                              0u};
        body_sensors[s] = spec;
    }
    for (unsigned j = 0; (j < BODY_JOINTS) && (status == JCAL_OK); ++j) {
        const jcal_body_joint_spec_t spec = {
            NULL, 0u, (uint8_t)(j + 1u), JCAL_BODY_HINGE, {.hinge = &replayed.hinges[j]}};
        body_joints[j] = spec;
        status = jcal_functional_init(&replayed.hinges[j], &settings);
    }
#ifdef REPLAY_IN_STEP
    jcal_body_shared_t *const shared = NULL;
#else
    jcal_body_shared_t *const shared = &replayed.shared;
#endif
    const jcal_body_table_t table = {body_sensors, replayed.sensors, BODY_SENSORS,     body_joints, replayed.joints,
                                     BODY_JOINTS,  shared,           &replayed.health, NULL};
    return (status == JCAL_OK) ? jcal_body_init(&replayed.body, &table, &config) : status;
}

/* The joint that was first to be looked at. */
static jcal_status_t engine_get(const whole_body_t *self, result_t *out)
{
    return jcal_body_joint(&self->body, 0u, out);
}

static int16_t raw_of(float value, float scale)
{
    const float raw = value / scale;
    return (int16_t)((raw > 32767.0f) ? 32767.0f : ((raw < -32768.0f) ? -32768.0f : raw));
}

static void write_raw(unsigned sensor, unsigned place, const jcal_imu_t *imu)
{
    const float values[JCAL_PACKET_VALUES] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                                              imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    int16_t *const to = &body_raw[sensor][place * JCAL_PACKET_VALUES];
    for (unsigned k = 0; k < JCAL_PACKET_VALUES; ++k) {
        to[k] = raw_of(values[k], (k < 3u) ? body_packets.scale.gyr_rad_s : body_packets.scale.acc_m_s2);
    }
}

/* One hundredth of a second: the packets that are full are pushed, and a step is made. */
static void tick_body(const sample_t *pair, void (*begin)(void), void (*end)(void))
{
    jcal_packet_t packets[BODY_SENSORS];
    unsigned full[BODY_SENSORS];
    unsigned count = 0;
    for (unsigned s = 0; s < BODY_SENSORS; ++s) {
        const uint32_t number = body_counter + s;
        const unsigned place = number % BODY_PER_PACKET;
        write_raw(s, place, (s == 0u) ? &pair->imu1 : &pair->imu2);
        if ((place + 1u) == BODY_PER_PACKET) {
            const jcal_packet_t packet = {pair->t_us, number + 1u - BODY_PER_PACKET, BODY_PER_PACKET, body_raw[s],
                                          NULL};
            packets[count] = packet;
            full[count] = s;
            ++count;
        }
    }
    ++body_counter;
    begin();
    for (unsigned k = 0; k < count; ++k) {
        (void)jcal_body_push(&replayed.body, full[k], &packets[k]);
    }
    (void)jcal_body_step(&replayed.body, pair->t_us, BODY_UNITS);
    end();
}

#endif /* REPLAY_BODY_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A body of up to four sensors in a chain, whose packets have one reading each.
#ifndef JCAL_TEST_BODY_FIXTURE_H
#define JCAL_TEST_BODY_FIXTURE_H

#include "jointcal/body.h"
#include "unit/functional/fixture.h"

#include <string.h>

enum { CHAIN_MAX = 4, WAITING = 64, BODY_PERIOD_US = 10000 };

typedef struct {
    unsigned char storage[CHAIN_MAX][JCAL_PACKETS_STORAGE_BYTES(WAITING, 1u, JCAL_PACKET_SI)];
    jcal_packet_config_t packets;
    jcal_body_sensor_spec_t sensors[CHAIN_MAX];
    jcal_body_sensor_t sensor_states[CHAIN_MAX];
    jcal_body_joint_spec_t joints[CHAIN_MAX];
    jcal_body_joint_t joint_states[CHAIN_MAX];
    jcal_functional_t hinges[CHAIN_MAX];
    jcal_body_shared_t shared;
    jcal_health_t health;
    jcal_body_table_t table;
    jcal_body_config_t config;
    jcal_body_t body;
    uint32_t counter[CHAIN_MAX];
} body_fixture_t;

/// A chain of hinges: joint j between sensors j and j + 1.
static inline void body_fill(body_fixture_t *f, unsigned sensors)
{
    memset(f, 0, sizeof *f);
    f->packets = jcal_packet_config_default();
    f->packets.packets = WAITING;
    f->config = jcal_body_config_default();
    const jcal_functional_config_t settings = jcal_functional_config_default();
    for (unsigned s = 0u; s < sensors; ++s) {
        const jcal_body_sensor_spec_t sensor = {NULL, &f->packets, f->storage[s], sizeof f->storage[s], 0u};
        f->sensors[s] = sensor;
    }
    for (unsigned j = 0u; j + 1u < sensors; ++j) {
        const jcal_body_joint_spec_t joint = {
            NULL, (uint8_t)j, (uint8_t)(j + 1u), JCAL_BODY_HINGE, {.hinge = &f->hinges[j]}};
        f->joints[j] = joint;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_functional_init(&f->hinges[j], &settings));
    }
    const jcal_body_table_t table = {f->sensors,   f->sensor_states, sensors,    f->joints, f->joint_states,
                                     sensors - 1u, &f->shared,       &f->health, NULL};
    f->table = table;
}

static inline void body_begin(body_fixture_t *f)
{
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_init(&f->body, &f->table, &f->config));
}

/// What a sensor of a hinge reads at t; real sensors do not repeat themselves at rest.
static inline void body_read_at(const hinge_t *hinge, double t, unsigned sensor, float values[6])
{
    hinge_sensor_t s;
    hinge_sensor(hinge, t, (int)sensor + 1, &s);
    for (int i = 0; i < 3; ++i) {
        values[i] = (float)(s.gyr[i] + 1e-3 * sin((1100.0 + 200.0 * sensor) * t + i));
        values[i + 3] = (float)(s.force[i] + 1e-2 * sin((1700.0 + 200.0 * sensor) * t + i));
    }
}

/// A packet of one reading, that arrives at arrival_us.
static inline void body_send(body_fixture_t *f, unsigned sensor, uint64_t arrival_us, const float values[6])
{
    const jcal_packet_t packet = {arrival_us, f->counter[sensor], 1u, NULL, values};
    f->counter[sensor] += 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_push(&f->body, sensor, &packet));
}

/// Everything that is left to do; returns the number of calls.
static inline unsigned body_work(body_fixture_t *f, uint64_t now_us)
{
    unsigned calls = 1u;
    while (jcal_body_step(&f->body, now_us, 50u) == JCAL_OK) {
        ++calls;
        TEST_ASSERT_TRUE(calls < 10000u);
    }
    return calls;
}

static inline jcal_body_joint_result_t body_joint(const body_fixture_t *f, unsigned joint)
{
    jcal_body_joint_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_joint(&f->body, joint, &out));
    return out;
}

static inline jcal_body_sensor_result_t body_sensor(const body_fixture_t *f, unsigned sensor)
{
    jcal_body_sensor_result_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_sensor(&f->body, sensor, &out));
    return out;
}

static inline jcal_body_status_t body_status(const body_fixture_t *f)
{
    jcal_body_status_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_body_status(&f->body, &out));
    return out;
}

#endif

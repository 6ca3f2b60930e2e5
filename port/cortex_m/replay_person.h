/* SPDX-License-Identifier: MIT */
/* A whole person for replay.c: sixteen sensors and fifteen hinges, fed with packets as they came. A sample is a packet that arrived; after
 * each hundredth of a second what came is pushed, and one step is made. Samples without readings only let time pass.
 *
 * With REPLAY_ROWS also writes, to the working directory: `rows.bin`, every quarter of a second a person_row_t of each joint; `events.bin`, a
 * person_event_t of each; and at the end `ends.bin`, counters of the body and of each sensor. */
#ifndef REPLAY_PERSON_H
#define REPLAY_PERSON_H

#include "body_row.h"
#include "jointcal/body.h"

#include <stdio.h>
#include <string.h>

enum {
    PERSON_SENSORS = 16,
    PERSON_JOINTS = 15,
    PERSON_SLOTS = 8,
    PERSON_PER_PACKET = 4,
    PERSON_UNITS = 80,
    PERSON_STEP_US = 10000,
    PERSON_STEPS_PER_ROW = 25,
    PERSON_PENDING = 64 /* packets of one step */
};

/* A packet that arrived. */
typedef struct {
    uint64_t arrival_us;
    uint32_t counter;
    uint8_t sensor;
    uint8_t count; /* readings; 0: none, time only */
    uint16_t zero;
    int16_t raw[PERSON_PER_PACKET * JCAL_PACKET_VALUES];
} sample_t;

typedef jcal_body_joint_result_t result_t;

typedef char sample_has_no_padding[(sizeof(sample_t) == 64) ? 1 : -1];

/* All that a body needs. */
typedef struct {
    jcal_body_t body;
    jcal_body_sensor_t sensors[PERSON_SENSORS];
    jcal_body_joint_t joints[PERSON_JOINTS];
    jcal_functional_t hinges[PERSON_JOINTS];
    unsigned char storage[PERSON_SENSORS][JCAL_PACKETS_STORAGE_BYTES(PERSON_SLOTS, PERSON_PER_PACKET, JCAL_PACKET_RAW)];
    jcal_body_shared_t shared;
    jcal_health_t health;
} whole_person_t;

/* The sensor that each joint's distal one hangs on: pelvis, waist, chest, head; arms; legs; feet. */
static const uint8_t PERSON_PROXIMAL[PERSON_JOINTS] = {0, 1, 2, 2, 4, 5, 2, 7, 8, 0, 10, 11, 0, 13, 14};

static whole_person_t replayed;
/* On a hub these would be constants. */
static jcal_packet_config_t person_packets;
static jcal_body_sensor_spec_t person_sensors[PERSON_SENSORS];
static jcal_body_joint_spec_t person_joints[PERSON_JOINTS];

static jcal_status_t engine_init(void)
{
    const jcal_functional_config_t settings = jcal_functional_config_default();
    jcal_body_config_t config = jcal_body_config_default();
    config.wait_s = 0.25f; /* what is under way and what waits find room in PERSON_SLOTS packets */
    person_packets = jcal_packet_config_default();
    person_packets.per_packet = PERSON_PER_PACKET;
    person_packets.packets = PERSON_SLOTS;
    person_packets.values = JCAL_PACKET_RAW;
    person_packets.max_delay_s = 0.5f;
    jcal_status_t status = jcal_chip_scale("LSM6DSV", 2000.0f, 16.0f, &person_packets.scale);
    for (unsigned s = 0; s < PERSON_SENSORS; ++s) {
        const jcal_body_sensor_spec_t spec = {NULL, &person_packets, replayed.storage[s], sizeof(replayed.storage[s]),
                                              0u};
        person_sensors[s] = spec;
    }
    for (unsigned j = 0; (j < PERSON_JOINTS) && (status == JCAL_OK); ++j) {
        const jcal_body_joint_spec_t spec = {
            NULL, PERSON_PROXIMAL[j], (uint8_t)(j + 1u), JCAL_BODY_HINGE, {.hinge = &replayed.hinges[j]}};
        person_joints[j] = spec;
        status = jcal_functional_init(&replayed.hinges[j], &settings);
    }
    const jcal_body_table_t table = {person_sensors, replayed.sensors, PERSON_SENSORS,   person_joints, replayed.joints,
                                     PERSON_JOINTS,  &replayed.shared, &replayed.health, NULL};
    return (status == JCAL_OK) ? jcal_body_init(&replayed.body, &table, &config) : status;
}

/* The joints in turn: one after each packet. */
static jcal_status_t engine_get(const whole_person_t *self, result_t *out)
{
    static unsigned joint = 0;
    joint = (joint + 1u) % PERSON_JOINTS;
    return jcal_body_joint(&self->body, joint, out);
}

#ifdef REPLAY_ROWS
typedef struct {
    uint64_t now_us, t_us;
    float values[BODY_ROW_COLUMNS];
} person_row_t;

typedef struct {
    uint64_t t_us;
    float values[5]; /* kind, joint, sensor, what, value */
    uint32_t zero;
} person_event_t;

static FILE *person_rows, *person_events;

static FILE *person_file(FILE *file, const char *name)
{
    FILE *const found = (file != NULL) ? file : fopen(name, "wb");
    if (found == NULL) {
        puts("cannot write");
        exit(EXIT_FAILURE);
    }
    return found;
}

/* NaNs differ between targets in bits that mean nothing. */
static void copy_floats(float *to, const float *from, size_t count)
{
    static const uint32_t NAN_BITS = 0x7FC00000u;
    for (size_t k = 0; k < count; ++k) {
        (void)memcpy(&to[k], isnan(from[k]) ? (const void *)&NAN_BITS : (const void *)&from[k], sizeof(float));
    }
}

static void write_row(unsigned joint, uint64_t now_us)
{
    jcal_body_joint_result_t r;
    jcal_functional_result_t f;
    jcal_body_sensor_result_t first;
    (void)jcal_body_joint(&replayed.body, joint, &r);
    (void)jcal_functional_get(&replayed.hinges[joint], &f);
    (void)jcal_body_sensor(&replayed.body, 0u, &first);
    person_row_t row = {now_us, first.t_us, {0.0f}};
    body_row(&r, f.for_axes, row.values);
    (void)fwrite(&row, sizeof(row), 1u, person_rows);
}

static void write_ends(void)
{
    static jcal_body_sensor_result_t sensor;
    static jcal_body_status_t status;
    FILE *const file = person_file(NULL, "ends.bin");
    (void)jcal_body_status(&replayed.body, &status);
    (void)fwrite(&status, sizeof(status), 1u, file);
    for (unsigned s = 0; s < PERSON_SENSORS; ++s) {
        (void)jcal_body_sensor(&replayed.body, s, &sensor);
        (void)fwrite(&sensor, sizeof(sensor), 1u, file);
    }
    (void)fclose(file);
    (void)fflush(person_rows);
    (void)fflush(person_events);
}

static void write_what_is_new(unsigned long step, uint64_t now_us)
{
    person_rows = person_file(person_rows, "rows.bin");
    person_events = person_file(person_events, "events.bin");
    jcal_body_event_t e;
    while (jcal_body_event(&replayed.body, &e) == JCAL_OK) {
        const float values[5] = {(float)e.kind, (float)e.joint, (float)e.sensor, (float)e.what, e.value};
        person_event_t event = {e.t_us, {0.0f}, 0u};
        copy_floats(event.values, values, 5u);
        (void)fwrite(&event, sizeof(event), 1u, person_events);
    }
    for (unsigned j = 0; (j < PERSON_JOINTS) && ((step % PERSON_STEPS_PER_ROW) == 0u); ++j) {
        write_row(j, now_us);
    }
}
#endif

/* What comes until the next step. */
static sample_t person_pending[PERSON_PENDING];
static unsigned person_waiting;

static void step_person(uint64_t now_us, void (*begin)(void), void (*end)(void))
{
    begin();
    for (unsigned k = 0; k < person_waiting; ++k) {
        const sample_t *const p = &person_pending[k];
        const jcal_packet_t packet = {p->arrival_us, p->counter, p->count, p->raw, NULL};
        (void)jcal_body_push(&replayed.body, p->sensor, &packet);
    }
    (void)jcal_body_step(&replayed.body, now_us, PERSON_UNITS);
    end();
    person_waiting = 0u;
}

static void take_packet(const sample_t *packet, void (*begin)(void), void (*end)(void))
{
    static uint64_t now_us = 0u;
    static unsigned long steps = 0u;
    now_us = (now_us == 0u) ? packet->arrival_us : now_us;
    while (packet->arrival_us > now_us) {
        step_person(now_us, begin, end);
        ++steps;
#ifdef REPLAY_ROWS
        write_what_is_new(steps, now_us);
#endif
        now_us += PERSON_STEP_US;
    }
    if (packet->count == 0u) {
        return;
    }
    if (person_waiting == PERSON_PENDING) {
        puts("more packets in one step than there is room for");
        exit(EXIT_FAILURE);
    }
    person_pending[person_waiting] = *packet;
    ++person_waiting;
}

#endif /* REPLAY_PERSON_H */

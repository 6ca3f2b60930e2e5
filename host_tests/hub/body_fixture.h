/* SPDX-License-Identifier: MIT */
/// @file
/// A hub, a flash in RAM that outlasts it, and the sender of a body session: what it sends, and what it has heard.
#ifndef JCAL_TEST_HUB_BODY_FIXTURE_H
#define JCAL_TEST_HUB_BODY_FIXTURE_H

#include "hub.h"

#include <string.h>
#include <unity.h>

#define TEST_SLOT_BYTES 2048u
#define TEST_TYPES 256u

static hub_t hub;
static uint8_t flash_bytes[2][TEST_SLOT_BYTES];
static uint32_t next_number;

/* What has come from the hub: how often each type, in which order, and the last of each. */
static struct {
    frame_decoder_t decoder;
    unsigned count[TEST_TYPES];
    unsigned events[16];
    unsigned bad, unordered, frames;
    uint32_t sequence; /* of the next frame */
    uint32_t limit;
    uint32_t sum; /* over all frames but credit, with their types */
    uint8_t order[64];
    message_hello_t hello;
    message_counters_t counters;
    message_table_t table;
    jcal_body_event_t event;
    message_joint_state_t joint;
    message_sensor_state_t sensor;
    message_body_state_t body;
    message_flexions_t flexions;
    message_orientations_t orientations;
    message_advice_t advice;
    message_kept_t kept;
    uint8_t refused_version;
} seen;

static inline bool test_erase(void *context, unsigned slot)
{
    (void)context;
    memset(flash_bytes[slot], 0xFF, TEST_SLOT_BYTES);
    return true;
}

static inline bool test_program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    for (uint32_t k = 0; k < n; k++) {
        flash_bytes[slot][offset + k] &= bytes[k];
    }
    return true;
}

static inline bool test_read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    (void)context;
    memcpy(bytes, &flash_bytes[slot][offset], n);
    return true;
}

/* The power comes: flash is as it was, nothing else is. */
static inline void power_on(bool has_flash, bool is_deaf)
{
    const jcal_flash_t flash = {NULL, TEST_SLOT_BYTES, 4u, test_erase, test_program, test_read};
    memset(&seen, 0, sizeof seen);
    hub_init(&hub);
    if (has_flash) {
        hub_set_flash(&hub, &flash, is_deaf);
    }
}

static inline void note_event(const frame_t *frame)
{
    TEST_ASSERT_TRUE(message_read_event(frame, &seen.event));
    TEST_ASSERT_TRUE(seen.event.kind < 16u);
    seen.events[seen.event.kind]++;
}

/* What comes beside states. */
static inline bool take_other(const frame_t *frame)
{
    switch (frame->type) {
    case FRAME_HELLO:
        seen.limit = 1u + HUB_CREDIT; /* begins are number 0 here */
        return message_read_hello(frame, &seen.hello);
    case FRAME_CREDIT:
        return message_read_number(frame, &seen.limit);
    case FRAME_TABLE:
        return message_read_table(frame, &seen.table);
    case FRAME_KEPT:
        return message_read_kept(frame, &seen.kept);
    case FRAME_OTHER_VERSION:
        return message_read_other_version(frame, &seen.refused_version);
    default:
        return false;
    }
}

static inline bool take(const frame_t *frame)
{
    message_estimate_t estimate;
    switch (frame->type) {
    case FRAME_ESTIMATE:
        return message_read_estimate(frame, &estimate);
    case FRAME_COUNTERS:
        return message_read_counters(frame, &seen.counters);
    case FRAME_JOINT_STATE:
        return message_read_joint_state(frame, &seen.joint);
    case FRAME_SENSOR_STATE:
        return message_read_sensor_state(frame, &seen.sensor);
    case FRAME_BODY_STATE:
        return message_read_body_state(frame, &seen.body);
    case FRAME_FLEXIONS:
        return message_read_flexions(frame, &seen.flexions);
    case FRAME_ORIENTATIONS:
        return message_read_orientations(frame, &seen.orientations);
    case FRAME_ADVICE:
        return message_read_advice(frame, &seen.advice);
    case FRAME_EVENT:
        note_event(frame);
        return true;
    default:
        return take_other(frame);
    }
}

static inline void note(const frame_t *frame)
{
    TEST_ASSERT_TRUE(take(frame));
    seen.unordered += (frame->type != FRAME_HELLO && frame->sequence != seen.sequence) ? 1u : 0u;
    seen.sequence = frame->sequence + 1u;
    seen.count[frame->type]++;
    if (frame->type != FRAME_CREDIT) {
        uint8_t bytes[FRAME_PAYLOAD_MAX + 5u] = {(uint8_t)seen.sum, (uint8_t)(seen.sum >> 8), (uint8_t)(seen.sum >> 16),
                                                 (uint8_t)(seen.sum >> 24), frame->type};
        memcpy(bytes + 5, frame->payload, frame->size);
        seen.sum = frame_crc32(bytes, frame->size + 5u);
        seen.order[seen.frames % sizeof seen.order] = frame->type;
        seen.frames++;
    }
}

static inline void listen(void)
{
    uint8_t byte = 0;
    frame_t frame;
    while (hub_send(&hub, &byte)) {
        const frame_event_t event = frame_decode(&seen.decoder, byte, &frame);
        seen.bad += (event == FRAME_BAD) ? 1u : 0u;
        if (event == FRAME_GOOD) {
            note(&frame);
        }
    }
}

static inline void work(void)
{
    do {
        listen();
    } while (hub_work(&hub));
    listen();
}

/* Within the credit: a hub that is slow is waited for. */
static inline void send(frame_type_t type, const frame_writer_t *payload)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t size = frame_encode(wire, type, next_number, payload->bytes, payload->size);
    TEST_ASSERT_TRUE(payload->ok && size > 0);
    next_number++;
    for (size_t k = 0; k < size; k++) {
        hub_receive(&hub, wire[k]);
    }
}

static inline void send_number(frame_type_t type, uint32_t number)
{
    frame_writer_t payload;
    message_write_number(&payload, number);
    send(type, &payload);
}

static inline void send_begin(uint32_t nonce, unsigned sensors, unsigned joints, unsigned flags)
{
    const message_begin_t begin = {nonce, 0, 0, (uint8_t)sensors, (uint8_t)joints, (uint8_t)flags};
    frame_writer_t payload;
    next_number = 0;
    message_write_begin(&payload, &begin);
    send(FRAME_BEGIN, &payload);
}

#define TEST_GYR_RAD_S 0.001f
#define TEST_ACC_M_S2 0.005f

static inline message_sensor_t usual_sensor(unsigned number)
{
    message_sensor_t sensor = {.number = (uint8_t)number, .serial = 100u + number, .name = "sensor"};
    sensor.packets = jcal_packet_config_default();
    sensor.packets.period_ns = 10000000u;
    sensor.packets.counter_bits = 16u;
    sensor.packets.per_packet = 4u;
    sensor.packets.scale = (jcal_scale_t){TEST_GYR_RAD_S, TEST_ACC_M_S2, INT16_MAX, INT16_MAX};
    sensor.name[6] = (char)('a' + (int)number);
    return sensor;
}

static inline message_joint_t usual_joint(unsigned number)
{
    const message_joint_t joint = {.number = (uint8_t)number,
                                   .kind = (uint8_t)(number % 3u),
                                   .proximal = (uint8_t)number,
                                   .distal = (uint8_t)(number + 1u),
                                   .name = "joint"};
    return joint;
}

static inline void send_sensor(const message_sensor_t *sensor)
{
    frame_writer_t payload;
    message_write_sensor(&payload, sensor);
    send(FRAME_SENSOR, &payload);
    work();
}

static inline void send_joint(const message_joint_t *joint)
{
    frame_writer_t payload;
    message_write_joint(&payload, joint);
    send(FRAME_JOINT, &payload);
    work();
}

/* A chain: joint j between sensors j and j + 1, kinds in turn. */
static inline void send_table(unsigned sensors)
{
    for (unsigned s = 0; s < sensors; s++) {
        const message_sensor_t sensor = usual_sensor(s);
        send_sensor(&sensor);
    }
    for (unsigned j = 0; j + 1u < sensors; j++) {
        const message_joint_t joint = usual_joint(j);
        send_joint(&joint);
    }
}

static inline void open_session(unsigned sensors, unsigned flags)
{
    send_begin(1, sensors, sensors - 1u, flags);
    work();
    send_table(sensors);
    TEST_ASSERT_EQUAL_UINT(1, seen.count[FRAME_TABLE]);
    TEST_ASSERT_FALSE(seen.table.refused);
}

static inline void ask_kept(frame_type_t type, uint32_t token, unsigned joint)
{
    const message_ask_kept_t ask = {token, (uint8_t)joint};
    frame_writer_t payload;
    message_write_ask_kept(&payload, &ask);
    send(type, &payload);
}

#endif

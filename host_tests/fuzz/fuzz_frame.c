/* SPDX-License-Identifier: MIT */
/* Any bytes as frames: decoder and hub stay in bounds, count every piece once, and never stop.
 *
 * The first byte says how the rest is read: as bytes of the wire, or as chunks (length, type, payload) that are made into
 * frames with right CRCs, so that the fuzzer gets behind the CRC; and whether a body session with three sensors is open before. */
#include "hub.h"

#include <stdlib.h>
#include <string.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

static struct {
    frame_decoder_t decoder;
    uint8_t before; /* last byte fed */
    uint32_t pieces;
} seen;

static void check_link(const frame_counts_t *counts)
{
    require(counts->received == counts->taken + counts->repeated + counts->reordered + counts->stale);
}

/* What the hub says is well-formed, whatever it was told. */
static void drain(hub_t *hub)
{
    uint8_t byte = 0;
    frame_t frame;
    while (hub_send(hub, &byte)) {
        const frame_event_t event = frame_decode(&seen.decoder, byte, &frame);
        message_estimate_t estimate;
        message_counters_t counters;
        require(event != FRAME_BAD);
        if (event == FRAME_GOOD && frame.type == FRAME_ESTIMATE) {
            require(message_read_estimate(&frame, &estimate));
        } else if (event == FRAME_GOOD && frame.type == FRAME_COUNTERS) {
            require(message_read_counters(&frame, &counters));
        }
    }
}

static void work(hub_t *hub)
{
    do {
        drain(hub);
    } while (hub_work(hub));
    drain(hub);
    require(!hub_waiting(hub));
}

static void feed(hub_t *hub, uint8_t byte)
{
    const bool linked = hub->linked;
    const uint32_t before = hub->link.counts.received + hub->link.counts.corrupted;
    seen.pieces += (byte == 0 && seen.before != 0) ? 1u : 0u;
    seen.before = byte;
    hub_receive(hub, byte);
    const uint32_t after = hub->link.counts.received + hub->link.counts.corrupted;
    if (linked && after != 1u) { /* a start begins anew with one */
        require(after - before <= 1u);
    }
    check_link(&hub->link.counts);
}

static void feed_frame(hub_t *hub, frame_type_t type, uint32_t sequence, const uint8_t *payload, size_t size)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t count = frame_encode(wire, type, sequence, payload, size);
    for (size_t k = 0; k < count; k++) {
        feed(hub, wire[k]);
    }
}

/* Three sensors, a hinge and a ball; all flags. */
static uint32_t open_body(hub_t *hub)
{
    const message_begin_t begin = {1, 100000u, 50000u, 3, 2, 7};
    frame_writer_t payload;
    uint32_t sequence = 0;
    message_write_begin(&payload, &begin);
    feed_frame(hub, FRAME_BEGIN, sequence++, payload.bytes, payload.size);
    for (unsigned n = 0; n < 3u; n++) {
        message_sensor_t sensor = {.number = (uint8_t)n, .serial = n + 1u, .packets = jcal_packet_config_default()};
        message_write_sensor(&payload, &sensor);
        feed_frame(hub, FRAME_SENSOR, sequence++, payload.bytes, payload.size);
    }
    for (unsigned n = 0; n < 2u; n++) {
        const message_joint_t joint = {(uint8_t)n, (uint8_t)n, (uint8_t)n, (uint8_t)(n + 1u), 0.0f, "joint"};
        message_write_joint(&payload, &joint);
        feed_frame(hub, FRAME_JOINT, sequence++, payload.bytes, payload.size);
    }
    work(hub);
    return sequence - 1u;
}

static void feed_frames(hub_t *hub, uint32_t sequence, const uint8_t *data, size_t size)
{
    static const uint8_t TYPES[16] = {FRAME_START,  FRAME_SAMPLE, FRAME_REQUEST,  0x55,
                                      FRAME_BEGIN,  FRAME_SENSOR, FRAME_JOINT,    FRAME_PACKET,
                                      FRAME_PACKET, FRAME_TIME,   FRAME_PUT_KEPT, FRAME_GET_KEPT,
                                      FRAME_FORGET, FRAME_SLEEP,  FRAME_PACKET,   FRAME_HELLO};
    for (size_t at = 0; at + 2u <= size;) {
        const uint8_t how = data[at];
        size_t length = data[at + 1u];
        at += 2u;
        length = (length > size - at) ? size - at : length;
        length = (length > FRAME_PAYLOAD_MAX) ? FRAME_PAYLOAD_MAX : length;
        sequence += ((how & 0x60u) == 0) ? 1u : (uint32_t)(int32_t)(int8_t)how;
        feed_frame(hub, (frame_type_t)TYPES[how & 15u], sequence, data + at, length);
        at += length;
        if ((how & 0x10u) != 0) {
            (void)hub_work(hub);
            drain(hub);
        }
    }
}

static uint8_t flash_bytes[2][2048];

static bool flash_erase(void *context, unsigned slot)
{
    (void)context;
    memset(flash_bytes[slot], 0xFF, sizeof flash_bytes[slot]);
    return true;
}

static bool flash_program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    memcpy(flash_bytes[slot] + offset, bytes, n);
    return true;
}

static bool flash_read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    (void)context;
    memcpy(bytes, flash_bytes[slot] + offset, n);
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static hub_t hub;
    hub_init(&hub);
    memset(&seen, 0, sizeof seen);
    if (size == 0) {
        return 0;
    }
    memset(flash_bytes, 0xFF, sizeof flash_bytes);
    const jcal_flash_t flash = {NULL, sizeof flash_bytes[0], 4u, flash_erase, flash_program, flash_read};
    hub_set_flash(&hub, &flash, false);
    const uint32_t sequence = ((data[0] & 4u) != 0) ? open_body(&hub) : 0u;
    if ((data[0] & 1u) != 0) {
        feed_frames(&hub, sequence, data + 1, size - 1u);
    } else {
        for (size_t k = 1; k < size; k++) {
            feed(&hub, data[k]);
            if (data[k] == 0 && (data[0] & 2u) != 0) {
                (void)hub_work(&hub);
                drain(&hub);
            }
        }
    }
    work(&hub);
    return 0;
}

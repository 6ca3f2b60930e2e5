/* SPDX-License-Identifier: MIT */
/* Any bytes as frames: decoder and hub stay in bounds, count every piece once, and never stop.
 *
 * The first byte says how the rest is read: as bytes of the wire, or as chunks (length, type, payload) that are made into
 * frames with right CRCs, so that the fuzzer gets behind the CRC. */
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

static void feed_frames(hub_t *hub, const uint8_t *data, size_t size)
{
    static const uint8_t TYPES[] = {FRAME_START, FRAME_SAMPLE, FRAME_REQUEST, 0x55};
    uint32_t sequence = 0;
    for (size_t at = 0; at + 2u <= size;) {
        uint8_t wire[FRAME_WIRE_MAX];
        const uint8_t how = data[at];
        size_t length = data[at + 1u];
        at += 2u;
        length = (length > size - at) ? size - at : length;
        length = (length > FRAME_PAYLOAD_MAX) ? FRAME_PAYLOAD_MAX : length;
        sequence += ((how & 0x0Cu) == 0) ? 1u : (uint32_t)(int32_t)(int8_t)how;
        const size_t count = frame_encode(wire, (frame_type_t)TYPES[how & 3u], sequence, data + at, length);
        at += length;
        for (size_t k = 0; k < count; k++) {
            feed(hub, wire[k]);
        }
        if ((how & 0x10u) != 0) {
            (void)hub_work(hub);
            drain(hub);
        }
    }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static hub_t hub;
    hub_init(&hub);
    memset(&seen, 0, sizeof seen);
    if (size == 0) {
        return 0;
    }
    if ((data[0] & 1u) != 0) {
        feed_frames(&hub, data + 1, size - 1u);
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

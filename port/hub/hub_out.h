/* SPDX-License-Identifier: MIT */
/// @file
/// Answers that wait for transmission.
#ifndef JCAL_HUB_HUB_OUT_H
#define JCAL_HUB_HUB_OUT_H

#include "frame.h"

/// Bytes that may wait for transmission; a power of two.
#define HUB_OUT_BYTES 1024u

/// Private. All zero is its start.
typedef struct {
    uint8_t bytes[HUB_OUT_BYTES];
    uint32_t written, taken;
    uint32_t sequence;  ///< Of the next frame to send.
} hub_out_t;

/// Room left, bytes.
static inline uint32_t hub_out_room(const hub_out_t *self)
{
    return HUB_OUT_BYTES - (self->written - self->taken);
}

/// Puts a frame; the caller has looked for room of FRAME_WIRE_MAX.
static inline void hub_out_put(hub_out_t *self, frame_type_t type, const frame_writer_t *payload)
{
    uint8_t wire[FRAME_WIRE_MAX];
    const size_t size = frame_encode(wire, type, self->sequence, payload->bytes, payload->size);
    self->sequence++;
    for (size_t k = 0; k < size; k++) {
        self->bytes[self->written % HUB_OUT_BYTES] = wire[k];
        self->written++;
    }
}

#endif

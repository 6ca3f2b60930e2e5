/* SPDX-License-Identifier: MIT */
/// @file
/// Slots in storage of the caller, which push fills and pull empties: the rules of sample/ring.h, with a capacity of their own. Private.
///
/// A slot is a head and the values behind it, as bytes: nothing in it need be aligned.
#ifndef JCAL_PACKET_QUEUE_H
#define JCAL_PACKET_QUEUE_H

#include "jointcal/packet.h"
#include "sample/ring.h"

/// Bytes of a slot.
static inline size_t jcal_queue_slot_bytes(const jcal_packet_config_t *cfg)
{
    return JCAL_PACKETS_STORAGE_BYTES(1u, cfg->per_packet, cfg->values);
}

/// Push: the free slot, or null; then the packet is counted as lost. jcal_ring_publish() ends it.
static inline unsigned char *jcal_queue_room(jcal_packets_t *self)
{
    uint32_t slot;
    if (!jcal_ring_room_of(&self->ring, self->cfg.packets, &slot)) {
        return NULL;
    }
    return &self->storage[(size_t)slot * jcal_queue_slot_bytes(&self->cfg)];
}

/// Pull: the oldest slot, or null. jcal_ring_release() ends it.
static inline const unsigned char *jcal_queue_peek(const jcal_packets_t *self)
{
    uint32_t slot;
    if (!jcal_ring_peek_of(&self->ring, self->cfg.packets, &slot)) {
        return NULL;
    }
    return &self->storage[(size_t)slot * jcal_queue_slot_bytes(&self->cfg)];
}

#endif /* JCAL_PACKET_QUEUE_H */

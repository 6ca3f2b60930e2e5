/* SPDX-License-Identifier: MIT */
/// @file
/// Hands samples from push to step: one producer, maybe in an interrupt, another task or on another core, and one consumer. Private.
///
/// The slots are arrays of the owner, one or more, all under the same index. A slot belongs to push from jcal_ring_room() to
/// jcal_ring_publish() and to step from jcal_ring_peek() to jcal_ring_release(): whoever has a slot may read and write all of it, and
/// nobody else does. So step copies what it needs before it gives the slot back, and looks into a slot only after it has peeked.
///
/// Each index is written by one side only. The barriers keep what is done to a slot between the two calls that enclose it, for
/// compiler and cores; 16-bit loads and stores must be atomic, as they are on any Cortex-M.
#ifndef JCAL_RING_H
#define JCAL_RING_H

#include "jointcal/private/ring.h"

#include <stdbool.h>

/// Push: is there a free slot of `capacity`, a power of two? If so `slot` is its index, else the sample is counted as lost.
static inline bool jcal_ring_room_of(jcal_ring_t *self, uint32_t capacity, uint32_t *slot)
{
    const uint16_t at = self->written;
    if ((uint16_t)(at - self->taken) >= capacity) {
        self->overrun += 1u;
        return false;
    }
    JCAL_BARRIER(); /* step has read the slot before it was said to be free */
    *slot = at & (capacity - 1u);
    return true;
}

/// The same of an inbox.
static inline bool jcal_ring_room(jcal_ring_t *self, uint32_t *slot)
{
    return jcal_ring_room_of(self, JCAL_INBOX_CAPACITY, slot);
}

/// Push: the slot of jcal_ring_room() is filled. A push that fails does not call this and leaves no trace.
static inline void jcal_ring_publish(jcal_ring_t *self)
{
    JCAL_BARRIER(); /* all of the slot is written before it is said to be there */
    self->written = (uint16_t)(self->written + 1u);
}

/// Step: is there a sample in one of `capacity` slots? If so `slot` is the index of the oldest.
static inline bool jcal_ring_peek_of(const jcal_ring_t *self, uint32_t capacity, uint32_t *slot)
{
    const uint16_t at = self->taken;
    if (at == self->written) {
        return false;
    }
    JCAL_BARRIER(); /* the slot is read after it was said to be there */
    *slot = at & (capacity - 1u);
    return true;
}

/// The same of an inbox.
static inline bool jcal_ring_peek(const jcal_ring_t *self, uint32_t *slot)
{
    return jcal_ring_peek_of(self, JCAL_INBOX_CAPACITY, slot);
}

/// Step: the slot of jcal_ring_peek() is copied.
static inline void jcal_ring_release(jcal_ring_t *self)
{
    JCAL_BARRIER(); /* all of the slot is read before it is said to be free */
    self->taken = (uint16_t)(self->taken + 1u);
}

/// How many samples wait; for step and get.
static inline uint32_t jcal_ring_waiting(const jcal_ring_t *self)
{
    return (uint16_t)(self->written - self->taken);
}

#endif /* JCAL_RING_H */

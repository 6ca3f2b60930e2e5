/* SPDX-License-Identifier: MIT */
/// @file
/// Hands sample pairs from push to step. Private.
///
/// One producer (push, maybe in an interrupt) and one consumer (step). Each index is written by one side only and
/// read by the other, so on one core no lock is needed as long as 32-bit stores are atomic, as on any Cortex-M. The
/// indices are volatile so that the compiler publishes a slot before it publishes the index.
#ifndef JCAL_INBOX_PRIVATE_H
#define JCAL_INBOX_PRIVATE_H

#include "jointcal/private/inbox.h"

/// Room for one more pair?
static inline bool jcal_inbox_full(const jcal_inbox_t *self)
{
    return (self->written - self->taken) >= JCAL_INBOX_CAPACITY;
}

/// Puts a pair in; the caller has checked for room. A failed push must leave no trace.
static inline void jcal_inbox_put(jcal_inbox_t *self, const jcal_pair_t *pair)
{
    const uint32_t at = self->written;
    volatile jcal_pair_t *const slot = &self->slots[at % JCAL_INBOX_CAPACITY];
    *slot = *pair;
    self->written = at + 1u;
}

/// Takes the oldest pair out; false if there is none.
static inline bool jcal_inbox_take(jcal_inbox_t *self, jcal_pair_t *out)
{
    const uint32_t at = self->taken;
    if (at == self->written) {
        return false;
    }
    const volatile jcal_pair_t *const slot = &self->slots[at % JCAL_INBOX_CAPACITY];
    *out = *slot;
    self->taken = at + 1u;
    return true;
}

#endif /* JCAL_INBOX_PRIVATE_H */

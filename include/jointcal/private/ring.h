/* SPDX-License-Identifier: MIT */
/// @file
/// Indices of what push hands to step; lib/sample/ring.h has the rules. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_RING_H
#define JCAL_PRIVATE_RING_H

#include "jointcal/config.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Who waits in JCAL_INBOX_CAPACITY slots.
typedef struct {
    volatile uint16_t written;  ///< Samples ever put in; written by push only.
    volatile uint16_t taken;    ///< Samples ever taken out; written by step only.
    uint32_t overrun;           ///< Samples that found no room; written by push only.
} jcal_ring_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_RING_H */

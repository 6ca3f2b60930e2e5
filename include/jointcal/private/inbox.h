/* SPDX-License-Identifier: MIT */
/// @file
/// Layout of the queue between push and step. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_INBOX_H
#define JCAL_PRIVATE_INBOX_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Pairs that may wait between two calls of step; a power of two.
#define JCAL_INBOX_CAPACITY 4u

/// Pairs that wait for step.
typedef struct {
    jcal_pair_t slots[JCAL_INBOX_CAPACITY];
    volatile uint32_t written;  ///< Pairs ever put in; written by push only.
    volatile uint32_t taken;    ///< Pairs ever taken out; written by step only.
} jcal_inbox_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_INBOX_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Layout of the queue of sample pairs between push and step. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_INBOX_H
#define JCAL_PRIVATE_INBOX_H

#include "jointcal/private/ring.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Pairs that wait for step.
typedef struct {
    jcal_pair_t slots[JCAL_INBOX_CAPACITY];
    jcal_ring_t ring;
} jcal_inbox_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_INBOX_H */

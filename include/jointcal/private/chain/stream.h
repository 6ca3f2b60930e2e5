/* SPDX-License-Identifier: MIT */
/// @file
/// State of hip and knee. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_CHAIN_STREAM_H
#define JCAL_PRIVATE_CHAIN_STREAM_H

#include "jointcal/chain_config.h"
#include "jointcal/private/center/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_chain_config_t cfg;
    jcal_center_t hip;
    jcal_center_t knee;
    uint8_t judged[2];  ///< Judgements of hip and knee that `was_ready` follows.
    bool was_ready;     ///< The status was `ready` after them.
    uint32_t samples;
    uint32_t overrun;  ///< Triples that found one of the inboxes full.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} jcal_chain_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CHAIN_STREAM_H */

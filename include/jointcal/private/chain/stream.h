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
    float
        calm_m[2];  ///< Bounds of hip and knee, each by itself, with play: what breathes less than that does not show.
    uint32_t samples;
    uint32_t overrun;  ///< Triples that found one of the inboxes full.
    uint32_t rejected_by[JCAL_REJECT_COUNT];
} jcal_chain_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CHAIN_STREAM_H */

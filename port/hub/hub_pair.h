/* SPDX-License-Identifier: MIT */
/// @file
/// A pair session of the hub: one hinge, both sensors' readings at the same times. The rest of the hub calls this; see hub.h.
#ifndef JCAL_HUB_HUB_PAIR_H
#define JCAL_HUB_HUB_PAIR_H

#include "hub_out.h"
#include "messages.h"

/// All members are private.
typedef struct {
    jcal_hinge_auto_t hinge;
    message_start_t config;
    bool running;
    bool has_time;
    jcal_calibration_t status;
    uint64_t latest_us;  ///< Largest time of a sample.
    uint64_t next_us;    ///< When an estimate is due.
    uint64_t pair_us;    ///< Time of the last sample, for one without.
} hub_pair_t;

/// Begins; false if the library does not accept the configuration.
bool hub_pair_begin(hub_pair_t *self, const message_start_t *start);

/// A sample, all of its work, and the estimate if one is due or its status changed. True if counters are due too.
bool hub_pair_sample(hub_pair_t *self, hub_out_t *out, const jcal_pair_t *pair);

/// Answers a request with an estimate.
void hub_pair_estimate(hub_pair_t *self, hub_out_t *out, uint8_t events, uint32_t token);

/// Counts samples and rejections.
void hub_pair_count(const hub_pair_t *self, message_counters_t *counters);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// A body as a whole. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_BODY_BODY_H
#define JCAL_PRIVATE_BODY_BODY_H

#include "jointcal/body_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A body. Caller-owned; all members are private. Its states are in the caller's arrays, so it is not to be copied.
typedef struct {
    jcal_body_table_t table;
    jcal_body_pace_t pace;
    jcal_body_round_t round;
    jcal_body_probe_t probe;
    jcal_body_exchange_t exchange;
    jcal_body_exam_t exam;
    jcal_body_restore_t restore;
    jcal_body_events_t events;
    uint32_t rounds;        ///< Common times so far.
    uint32_t restarts;      ///< Times that the hub's clock began anew.
    uint32_t lags_refused;  ///< Lags that would have shifted a sensor too far.
    uint64_t units;         ///< Units of work so far.
    uint8_t next;           ///< Joint whose slice is next.
    bool slices_due;        ///< A joint, the lag or an examination may have work.
    bool slices_next;       ///< A slice is next, else the round.
    bool is_ready;          ///< False: never prepared.
} jcal_body_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_BODY_BODY_H */

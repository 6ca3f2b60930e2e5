/* SPDX-License-Identifier: MIT */
/// @file
/// State of the gate for orientations. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_ORIENTATION_H
#define JCAL_PRIVATE_ORIENTATION_H

#include "jointcal/private/clock.h"
#include "jointcal/reject.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Checks orientations as jcal_gate_t checks readings, with the same causes and counters; nothing is ever `saturated`.
/// Caller-owned, plain, copyable; all members are private.
typedef struct {
    jcal_attitudes_t last;
    jcal_clock_t clock;
    float still1_s;  ///< How long q1 has not changed by a bit.
    float still2_s;
    uint32_t samples;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    float bad_share;  ///< Share of rejected samples, averaged over about 50 of them.
    bool has_last;
} jcal_orientation_gate_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_ORIENTATION_H */

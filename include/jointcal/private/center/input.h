/* SPDX-License-Identifier: MIT */
/// @file
/// From readings to samples.
#ifndef JCAL_PRIVATE_CENTER_INPUT_H
#define JCAL_PRIVATE_CENTER_INPUT_H

#include "jointcal/gate.h"
#include "jointcal/private/inbox.h"
#include "jointcal/private/kinematics.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The last orientations, and when each of them last changed, us.
typedef struct {
    jcal_attitudes_t last;
    uint64_t changed1_us, changed2_us;
} jcal_center_attitudes_t;

/// From readings to samples.
typedef struct {
    jcal_gate_t gate;
    jcal_center_attitudes_t watched;
    jcal_inbox_t inbox;
    jcal_attitudes_t attitudes[JCAL_INBOX_CAPACITY];  ///< Of the pairs in the inbox.
    jcal_kinematics_t kinematics;
} jcal_center_input_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_INPUT_H */

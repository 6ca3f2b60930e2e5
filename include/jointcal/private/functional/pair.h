/* SPDX-License-Identifier: MIT */
/// @file
/// State of a functional joint with sensor stages of its own. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_FUNCTIONAL_PAIR_H
#define JCAL_PRIVATE_FUNCTIONAL_PAIR_H

#include "jointcal/gate.h"
#include "jointcal/private/functional/stream.h"
#include "jointcal/sensor.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_gate_config_t limits;
    jcal_gate_t gate;
    jcal_sensor_t sensor1, sensor2;
    jcal_functional_t joint;
    uint64_t last_us;  ///< Time of the last reading.
} jcal_functional_pair_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_FUNCTIONAL_PAIR_H */

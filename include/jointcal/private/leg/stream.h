/* SPDX-License-Identifier: MIT */
/// @file
/// State of a person's hip and knee. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_LEG_STREAM_H
#define JCAL_PRIVATE_LEG_STREAM_H

#include "jointcal/gate.h"
#include "jointcal/leg_config.h"
#include "jointcal/private/ball/stream.h"
#include "jointcal/sensor.h"
#include "jointcal/triple.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_leg_config_t cfg;
    jcal_gate_config_t limits;
    jcal_gate_t gate[2];      ///< Of pelvis and thigh, of thigh and shank.
    jcal_sensor_t sensor[3];  ///< Pelvis, thigh, shank.
    jcal_ball_t joint[2];     ///< Hip, knee.
    uint64_t last_us;         ///< Time of the last triple that was followed.
    uint32_t samples;
    uint32_t rejected_by[JCAL_REJECT_COUNT];
    bool was_known[JCAL_CHAIN_PLACES];  ///< At the last tick: what is known may become worse by the hysteresis.
    uint8_t turn;                       ///< The joint whose slice is next.
} jcal_leg_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_LEG_STREAM_H */

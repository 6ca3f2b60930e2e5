/* SPDX-License-Identifier: MIT */
/// @file
/// State of two sensors whose readings come in pairs. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_SENSOR_PAIR_H
#define JCAL_PRIVATE_SENSOR_PAIR_H

#include "jointcal/gate.h"
#include "jointcal/sensor.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    jcal_gate_config_t limits;
    jcal_gate_t gate;
    jcal_sensor_t sensor1, sensor2;
    uint64_t last_us;  ///< Time of the last reading.
} jcal_sensor_pair_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_SENSOR_PAIR_H */

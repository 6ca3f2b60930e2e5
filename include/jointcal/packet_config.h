/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a sensor's packets. Start from jcal_packet_config_default().
#ifndef JCAL_PACKET_CONFIG_H
#define JCAL_PACKET_CONFIG_H

#include "jointcal/chips.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the values of a packet are.
typedef enum {
    JCAL_PACKET_SI = 0,  ///< Floats in rad/s and m/s^2 (default).
    JCAL_PACKET_RAW = 1  ///< 16-bit integers, of which `scale` says what they are worth.
} jcal_packet_values_t;

/// Settings of the packets of one sensor.
typedef struct {
    uint32_t period_ns;    ///< The sensor's period by its own clock, ns. Range [500000, 1000000000], default 10 ms.
    uint8_t counter_bits;  ///< Bits of the sensor's counter, which counts readings. Range [8, 32], default 16.
    uint8_t per_packet;    ///< Most readings of one packet. Range [1, 16], default 1. Larger: more storage.
    uint16_t packets;      ///< Packets that may wait for pull: 2, 4, 8 ... 256, default 16.
    jcal_packet_values_t values;  ///< Default JCAL_PACKET_SI.
    /// What raw values are worth, from jcal_chip_scale() or the sheet of the sensor; not looked at for SI. Factors in (0, 100].
    jcal_scale_t scale;
    /// Longest that a packet may be under way beyond the fastest, s: what comes later, or so much too early, fits nothing. Range
    /// [0.02, 10], default 2, and at most half of the time after which the counter begins anew. Too short: what the radio sent again after
    /// an outage is taken for a sensor that began anew.
    float max_delay_s;
    /// Largest drift of the sensor's clock against the hub's, ppm. Range [10, 1000], default 500.
    float max_drift_ppm;
} jcal_packet_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_packet_config_t jcal_packet_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_packet_config_check(const jcal_packet_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PACKET_CONFIG_H */

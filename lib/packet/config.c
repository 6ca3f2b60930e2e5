/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a sensor's packets. See packet_config.h.
#include "jointcal/packet_config.h"

#include "jointcal/packet.h"
#include "math/limits.h"
#include "math/scalar.h"

#include <stddef.h>

#define PACKETS_MIN 2u
#define PACKETS_MAX 256u

jcal_packet_config_t jcal_packet_config_default(void)
{
    const jcal_packet_config_t config = {
        .period_ns = 10000000u,
        .counter_bits = 16u,
        .per_packet = 1u,
        .packets = 16u,
        .values = JCAL_PACKET_SI,
        .scale = {0.0f, 0.0f, 0, 0},
        .max_delay_s = 2.0f,
        .max_drift_ppm = 500.0f,
    };
    return config;
}

/// Of raw values.
static const char *check_scale(const jcal_scale_t *scale)
{
    const float largest = 100.0f;
    const char *wrong = NULL;
    wrong = (scale->acc_rail > 0) ? wrong : "scale.acc_rail";
    wrong = (scale->gyr_rail > 0) ? wrong : "scale.gyr_rail";
    wrong = (jcal_within(scale->acc_m_s2, 0.0f, largest) && (scale->acc_m_s2 > 0.0f)) ? wrong : "scale.acc_m_s2";
    wrong = (jcal_within(scale->gyr_rad_s, 0.0f, largest) && (scale->gyr_rad_s > 0.0f)) ? wrong : "scale.gyr_rad_s";
    return wrong;
}

/// Of what is an integer.
static const char *check_counts(const jcal_packet_config_t *config)
{
    const uint16_t n = config->packets;
    const bool is_power = (n >= PACKETS_MIN) && (n <= PACKETS_MAX) && ((n & (n - 1u)) == 0u);
    if ((config->period_ns < 500000u) || (config->period_ns > 1000000000u)) {
        return "period_ns";
    }
    if ((config->counter_bits < 8u) || (config->counter_bits > 32u)) {
        return "counter_bits";
    }
    if ((config->per_packet < 1u) || (config->per_packet > JCAL_PACKET_READINGS_MAX)) {
        return "per_packet";
    }
    if (!is_power) {
        return "packets";
    }
    return ((config->values == JCAL_PACKET_SI) || (config->values == JCAL_PACKET_RAW)) ? NULL : "values";
}

const char *jcal_packet_config_check(const jcal_packet_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *wrong = check_counts(config);
    if ((wrong == NULL) && (config->values == JCAL_PACKET_RAW)) {
        wrong = check_scale(&config->scale);
    }
    if (wrong != NULL) {
        return wrong;
    }
    const uint64_t round_ns = ((uint64_t)1u << config->counter_bits) * config->period_ns;
    const float half_round_s = 0.5e-9f * (float)round_ns;
    const jcal_limit_t fields[] = {
        {"max_delay_s", config->max_delay_s, 0.02f, jcal_min(10.0f, half_round_s)},
        {"max_drift_ppm", config->max_drift_ppm, 10.0f, 1000.0f},
    };
    return jcal_limits_check(fields, sizeof fields / sizeof fields[0]);
}

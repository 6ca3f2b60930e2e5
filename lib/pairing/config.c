/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the pairing: defaults and ranges.
#include "jointcal/pairing_config.h"

#include "math/limits.h"

#include <stddef.h>

jcal_pairing_config_t jcal_pairing_config_default(void)
{
    const jcal_pairing_config_t config = {0.01f, 0.1f};
    return config;
}

const char *jcal_pairing_config_check(const jcal_pairing_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t limits[] = {
        {"period_s", config->period_s, 0.004f, 0.05f},
        {"gap_s", config->gap_s, 0.005f, 0.1f},
    };
    return jcal_limits_check(limits, sizeof limits / sizeof limits[0]);
}

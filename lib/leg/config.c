/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a person's hip and knee: defaults and ranges.
#include "jointcal/leg_config.h"

#include "math/angle.h"
#include "math/limits.h"
#include "math/scalar.h"

#include <stddef.h>

jcal_leg_config_t jcal_leg_config_default(void)
{
    const jcal_leg_config_t config = {0.06f, 15.0f * JCAL_RAD_PER_DEG, 0.0f};
    return config;
}

const char *jcal_leg_config_check(const jcal_leg_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t limits[] = {
        {"max_lever_m", config->max_lever_m, 0.001f, 1.0f},
        {"max_heading_rad", config->max_heading_rad, 0.01f, 1.0f},
    };
    const char *const wrong = jcal_limits_check(limits, sizeof limits / sizeof limits[0]);
    if (wrong != NULL) {
        return wrong;
    }
    const bool is_length = (config->thigh_length_m == 0.0f) || jcal_within(config->thigh_length_m, 0.1f, 1.0f);
    return is_length ? NULL : "thigh_length_m";
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the ball joint: defaults and ranges.
#include "jointcal/ball_config.h"

#include "math/angle.h"
#include "math/limits.h"

#include <stddef.h>

jcal_ball_config_t jcal_ball_config_default(void)
{
    const jcal_ball_config_t config = {15.0f * JCAL_RAD_PER_DEG, 0.06f, 100.0f};
    return config;
}

const char *jcal_ball_config_check(const jcal_ball_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t limits[] = {
        {"max_heading_rad", config->max_heading_rad, 0.01f, 1.0f},
        {"max_lever_m", config->max_lever_m, 0.001f, 1.0f},
        {"slices_per_s", config->slices_per_s, 20.0f, 800.0f},
    };
    return jcal_limits_check(limits, sizeof limits / sizeof limits[0]);
}

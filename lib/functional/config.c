/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the functional joint: defaults and ranges.
#include "jointcal/functional_config.h"

#include "joint/sign.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/limits.h"

#include <stddef.h>

jcal_functional_config_t jcal_functional_config_default(void)
{
    jcal_functional_config_t config;
    config.max_bound_rad = 3.0f * JCAL_RAD_PER_DEG;
    config.max_flexion_rad = 3.0f * JCAL_RAD_PER_DEG;
    config.sign_hint = JCAL_SIGN_UNKNOWN;
    config.axis1_toward = jcal_vec3(0.0f, 0.0f, 0.0f);
    config.slices_per_s = 100.0f;
    return config;
}

const char *jcal_functional_config_check(const jcal_functional_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t limits[] = {
        {"max_bound_rad", config->max_bound_rad, 0.001f, 0.5f},
        {"max_flexion_rad", config->max_flexion_rad, 0.001f, 0.5f},
        {"slices_per_s", config->slices_per_s, 20.0f, 800.0f},
    };
    const char *const wrong = jcal_limits_check(limits, sizeof limits / sizeof limits[0]);
    return (wrong != NULL) ? wrong : jcal_sign_check(config->sign_hint, config->axis1_toward);
}

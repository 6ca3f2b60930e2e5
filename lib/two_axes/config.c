/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a person's joint with two axes: defaults and ranges.
#include "jointcal/two_axes_config.h"

#include "joint/sign.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/limits.h"

#include <stddef.h>

jcal_two_axes_config_t jcal_two_axes_config_default(void)
{
    const jcal_vec3_t nowhere = jcal_vec3(0.0f, 0.0f, 0.0f);
    const jcal_two_axes_config_t config = {jcal_ball_config_default(), 15.0f * JCAL_RAD_PER_DEG, nowhere, nowhere};
    return config;
}

const char *jcal_two_axes_config_check(const jcal_two_axes_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *const wrong = jcal_ball_config_check(&config->ball);
    if (wrong != NULL) {
        return wrong;
    }
    if (!jcal_sign_may_be_toward(config->axis1_toward)) {
        return "axis1_toward";
    }
    if (!jcal_sign_may_be_toward(config->axis2_toward)) {
        return "axis2_toward";
    }
    const jcal_limit_t limits[] = {{"max_bound_rad", config->max_bound_rad, 0.01f, 0.5f}};
    return jcal_limits_check(limits, sizeof limits / sizeof limits[0]);
}

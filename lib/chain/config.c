/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of hip and knee. See chain_config.h.
#include "jointcal/chain_config.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"
#include "math/sphere.h"

#include <stddef.h>

jcal_chain_config_t jcal_chain_config_default(void)
{
    const jcal_chain_config_t config = {
        .center = jcal_center_config_default(),
        .segment_tolerance_m = 0.005f,
        .plane_tolerance_m = 0.03f,
    };
    return config;
}

static bool is_zero(jcal_vec3_t v)
{
    return jcal_vec3_dot(v, v) == 0.0f;
}

const char *jcal_chain_config_check(const jcal_chain_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *const wrong = jcal_center_config_check(&config->center);
    if (wrong != NULL) {
        return wrong;
    }
    if (!is_zero(config->center.hinge_axis1)) {
        return "hinge_axis1";
    }
    if ((config->segment_length_m != 0.0f) && !jcal_within(config->segment_length_m, 0.05f, 1.0f)) {
        return "segment_length_m";
    }
    if (!jcal_within(config->segment_tolerance_m, 1e-4f, 0.1f)) {
        return "segment_tolerance_m";
    }
    if (!jcal_sphere_is_axis_or_none(config->plane_normal)) {
        return "plane_normal";
    }
    if (!jcal_within(config->plane_tolerance_m, 1e-4f, 0.2f)) {
        return "plane_tolerance_m";
    }
    if (!jcal_sphere_is_axis_or_none(config->knee_axis2)) {
        return "knee_axis2";
    }
    return (jcal_sphere_is_axis_or_none(config->knee_axis3) &&
            (is_zero(config->knee_axis2) == is_zero(config->knee_axis3)))
               ? NULL
               : "knee_axis3";
}

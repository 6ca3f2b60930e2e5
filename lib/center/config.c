/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of both engines of the joint centre. See center_config.h.
#include "jointcal/center_config.h"

#include "jointcal/vec3.h"
#include "math/limits.h"
#include "math/sphere.h"

#include <stddef.h>

jcal_center_config_t jcal_center_config_default(void)
{
    const jcal_center_config_t config = {
        .gate = jcal_gate_config_default(),
        .method = JCAL_CENTER_SS,
        .kinematics = {.derivative = JCAL_DERIVATIVE_FIVE_POINT, .smoothing_s = 0.12f},
        .max_bound_m = 0.01f,
        .mismatch_m = 0.002f,
        .rate_mismatch = 0.002f,
        .acc_noise_m_s2 = 0.05f,
        .turn_error = 0.01f,
        .acc_bias_m_s2 = 0.3f,
        .min_rate_rad_s = 0.0f,
        .memory_s = 300.0f,
    };
    return config;
}

const char *jcal_center_config_check(const jcal_center_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t fields[] = {
        {"max_bound_m", config->max_bound_m, 0.001f, 0.1f},
        {"mismatch_m", config->mismatch_m, 0.0f, 0.05f},
        {"rate_mismatch", config->rate_mismatch, 0.0f, 0.05f},
        {"acc_noise_m_s2", config->acc_noise_m_s2, 1e-3f, 10.0f},
        {"turn_error", config->turn_error, 0.0f, 0.5f},
        {"acc_bias_m_s2", config->acc_bias_m_s2, 0.0f, 2.0f},
        {"min_rate_rad_s", config->min_rate_rad_s, 0.0f, 20.0f},
        {"smoothing_s", config->kinematics.smoothing_s, 0.0f, 2.0f},
        {"memory_s", config->memory_s, 10.0f, 3600.0f},
    };
    const char *const out = jcal_limits_check(fields, sizeof fields / sizeof fields[0]);
    if (out != NULL) {
        return out;
    }
    const int method = (int)config->method;
    if ((method < (int)JCAL_CENTER_SS) || (method > (int)JCAL_CENTER_LS)) {
        return "method";
    }
    const int derivative = (int)config->kinematics.derivative;
    if ((derivative < (int)JCAL_DERIVATIVE_FIVE_POINT) || (derivative > (int)JCAL_DERIVATIVE_SYMMETRIC)) {
        return "derivative";
    }
    if (!jcal_sphere_is_axis_or_none(config->hinge_axis1)) {
        return "hinge_axis1";
    }
    if (!jcal_sphere_is_axis_or_none(config->hinge_axis2) ||
        ((jcal_vec3_dot(config->hinge_axis1, config->hinge_axis1) > 0.0f) !=
         (jcal_vec3_dot(config->hinge_axis2, config->hinge_axis2) > 0.0f))) {
        return "hinge_axis2";
    }
    return jcal_gate_config_check(&config->gate);
}

jcal_center_window_config_t jcal_center_window_config_default(void)
{
    const jcal_center_window_config_t config = {.center = jcal_center_config_default(), .n_max = 500u};
    return config;
}

const char *jcal_center_window_config_check(const jcal_center_window_config_t *config)
{
    const char *const wrong = jcal_center_config_check((config == NULL) ? NULL : &config->center);
    if (wrong != NULL) {
        return wrong;
    }
    return ((config->n_max < 50u) || (config->n_max > 20000u)) ? "n_max" : NULL;
}

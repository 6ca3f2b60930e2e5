/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of both engines of the joint with two axes. See two_dof_config.h.
#include "jointcal/two_dof_config.h"

#include "joint/sign.h"
#include "math/angle.h"
#include "math/limits.h"

#include <stddef.h>

jcal_two_dof_config_t jcal_two_dof_config_default(void)
{
    const jcal_two_dof_config_t config = {
        .gate = jcal_gate_config_default(),
        .constraint = JCAL_CONSTRAINT_COMBINED,
        .max_bound_rad = 3.0f * JCAL_RAD_PER_DEG,
        .mismatch_rad = 0.75f * JCAL_RAD_PER_DEG,
        .rate_noise_rad_s = 0.02f,
        .rate_error = 0.02f,
        .angle_noise_rad = 0.013f,
        .heading_drift_rad_s = 3.0f * JCAL_RAD_PER_DEG / 60.0f,
        .memory_s = 5.0f,
    };
    return config;
}

const char *jcal_two_dof_config_check(const jcal_two_dof_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t fields[] = {
        {"max_bound_rad", config->max_bound_rad, 0.001f, 0.5f},
        {"mismatch_rad", config->mismatch_rad, 0.0f, 0.1f},
        {"rate_noise_rad_s", config->rate_noise_rad_s, 1e-3f, 1.0f},
        {"rate_error", config->rate_error, 0.0f, 0.5f},
        {"angle_noise_rad", config->angle_noise_rad, 1e-3f, 0.5f},
        {"heading_drift_rad_s", config->heading_drift_rad_s, 0.0f, 0.05f},
        {"memory_s", config->memory_s, 2.0f, 600.0f},
    };
    const char *const out = jcal_limits_check(fields, sizeof fields / sizeof fields[0]);
    if (out != NULL) {
        return out;
    }
    const int constraint = (int)config->constraint;
    if ((constraint < (int)JCAL_CONSTRAINT_COMBINED) || (constraint > (int)JCAL_CONSTRAINT_ORIENTATION)) {
        return "constraint";
    }
    if (!jcal_sign_may_be_toward(config->axis1_toward)) {
        return "axis1_toward";
    }
    if (!jcal_sign_may_be_toward(config->axis2_toward)) {
        return "axis2_toward";
    }
    return jcal_gate_config_check(&config->gate);
}

jcal_two_dof_window_config_t jcal_two_dof_window_config_default(void)
{
    jcal_two_dof_window_config_t config = {
        .two_dof = jcal_two_dof_config_default(),
        .n_max = 200u,
    };
    config.two_dof.constraint = JCAL_CONSTRAINT_ROTATION;
    return config;
}

const char *jcal_two_dof_window_config_check(const jcal_two_dof_window_config_t *config)
{
    const char *const wrong = jcal_two_dof_config_check((config == NULL) ? NULL : &config->two_dof);
    if (wrong != NULL) {
        return wrong;
    }
    if (config->two_dof.constraint == JCAL_CONSTRAINT_COMBINED) {
        return "constraint";
    }
    return ((config->n_max < 20u) || (config->n_max > 10000u)) ? "n_max" : NULL;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of both engines of the hinge. See hinge_config.h.
#include "jointcal/hinge_config.h"

#include "joint/sign.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/limits.h"
#include "math/scalar.h"

#include <stddef.h>

jcal_hinge_config_t jcal_hinge_config_default(void)
{
    jcal_hinge_config_t config;
    config.gate = jcal_gate_config_default();
    config.max_bound_rad = 3.0f * JCAL_RAD_PER_DEG;
    config.rate_mismatch = 0.002f;
    config.gyr_noise_rad_s = 0.03f;
    config.acc_noise_m_s2 = 1.5f;
    config.lever_arm_m = 1.0f;
    config.gyr_bias_rad_s = 0.007f;
    config.acc_bias_m_s2 = 0.5f;
    config.sign_hint = JCAL_SIGN_UNKNOWN;
    config.axis1_toward = jcal_vec3(0.0f, 0.0f, 0.0f);
    config.slices_per_s = 200.0f;
    return config;
}

jcal_status_t jcal_hinge_config_set_gyroscope(jcal_hinge_config_t *config, jcal_gyr_grade_t grade)
{
    if ((config == NULL) || ((unsigned)grade > (unsigned)JCAL_GYR_AS_IT_COMES)) {
        return JCAL_ERR_ARG;
    }
    config->rate_mismatch = (grade == JCAL_GYR_AS_IT_COMES) ? 0.01f : 0.002f;
    return JCAL_OK;
}

const char *jcal_hinge_config_check(const jcal_hinge_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const jcal_limit_t fields[] = {
        {"max_bound_rad", config->max_bound_rad, 0.001f, 0.5f},
        {"rate_mismatch", config->rate_mismatch, 0.0f, 0.05f},
        {"gyr_noise_rad_s", config->gyr_noise_rad_s, 1e-4f, 1.0f},
        {"acc_noise_m_s2", config->acc_noise_m_s2, 1e-3f, 10.0f},
        {"lever_arm_m", config->lever_arm_m, 0.0f, 5.0f},
        {"gyr_bias_rad_s", config->gyr_bias_rad_s, 1e-5f, 0.2f},
        {"acc_bias_m_s2", config->acc_bias_m_s2, 1e-4f, 5.0f},
        {"slices_per_s", config->slices_per_s, 20.0f, 800.0f},
    };
    const char *const out = jcal_limits_check(fields, sizeof fields / sizeof fields[0]);
    if (out != NULL) {
        return out;
    }
    const char *const sign = jcal_sign_check(config->sign_hint, config->axis1_toward);
    return (sign != NULL) ? sign : jcal_gate_config_check(&config->gate);
}

jcal_hinge_window_config_t jcal_hinge_window_config_default(void)
{
    const jcal_hinge_window_config_t config = {
        .hinge = jcal_hinge_config_default(),
        .n_max = 500u,
        .half_window = 21u,
        .w0 = 50.0f,
        .energy_max_rad2_s2 = 1.0f,
        .acc_min = 250u,
        .accept_bound_rad = 3.0f * JCAL_RAD_PER_DEG,
        .accept_count = 10u,
        .solve_period_s = 1.0f,
        .seed = 2020u,
    };
    return config;
}

const char *jcal_hinge_window_config_check(const jcal_hinge_window_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const char *wrong = jcal_hinge_config_check(&config->hinge);
    if (wrong != NULL) {
        return wrong;
    }
    wrong = ((config->n_max < 20u) || (config->n_max > 10000u)) ? "n_max" : wrong;
    wrong = (config->half_window > 100u) ? "half_window" : wrong;
    wrong = jcal_within(config->w0, 1e-3f, 1e10f) ? wrong : "w0";
    wrong = (jcal_within(config->energy_max_rad2_s2, 0.0f, 1e4f) && (config->energy_max_rad2_s2 > 0.0f))
                ? wrong
                : "energy_max_rad2_s2";
    wrong = (config->acc_min > 10000u) ? "acc_min" : wrong;
    wrong = jcal_within(config->accept_bound_rad, 0.001f, 0.5f) ? wrong : "accept_bound_rad";
    wrong = ((config->accept_count < 1u) || (config->accept_count > 100u)) ? "accept_count" : wrong;
    wrong = jcal_within(config->solve_period_s, 0.1f, 60.0f) ? wrong : "solve_period_s";
    return wrong;
}

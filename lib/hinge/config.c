/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the hinge that both engines share: defaults and ranges.
#include "jointcal/hinge_config.h"

#include "joint/sign.h"
#include "jointcal/vec3.h"

#include <stddef.h>

#define DEGREE 0.0174532925f

jcal_hinge_config_t jcal_hinge_config_default(void)
{
    jcal_hinge_config_t config;
    config.gate = jcal_gate_config_default();
    config.max_bound_rad = 3.0f * DEGREE;
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

typedef struct {
    const char *name;
    float value, low, high;
} field_t;

const char *jcal_hinge_config_check(const jcal_hinge_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    const field_t fields[] = {
        {"max_bound_rad", config->max_bound_rad, 0.001f, 0.5f},
        {"rate_mismatch", config->rate_mismatch, 0.0f, 0.05f},
        {"gyr_noise_rad_s", config->gyr_noise_rad_s, 1e-4f, 1.0f},
        {"acc_noise_m_s2", config->acc_noise_m_s2, 1e-3f, 10.0f},
        {"lever_arm_m", config->lever_arm_m, 0.0f, 5.0f},
        {"gyr_bias_rad_s", config->gyr_bias_rad_s, 1e-5f, 0.2f},
        {"acc_bias_m_s2", config->acc_bias_m_s2, 1e-4f, 5.0f},
        {"slices_per_s", config->slices_per_s, 20.0f, 800.0f},
    };
    for (size_t i = 0u; i < (sizeof fields / sizeof fields[0]); ++i) {
        if (!((fields[i].value >= fields[i].low) && (fields[i].value <= fields[i].high))) {
            return fields[i].name;
        }
    }
    const int hint = (int)config->sign_hint;
    if ((hint < (int)JCAL_SIGN_UNKNOWN) || (hint > (int)JCAL_SIGN_OPPOSITE)) {
        return "sign_hint";
    }
    if (!jcal_sign_may_be_toward(config->axis1_toward)) {
        return "axis1_toward";
    }
    return jcal_gate_config_check(&config->gate);
}

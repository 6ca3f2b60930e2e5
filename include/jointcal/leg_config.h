/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a person's hip and knee. Start from jcal_leg_config_default().
#ifndef JCAL_LEG_CONFIG_H
#define JCAL_LEG_CONFIG_H

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of a person's hip and knee.
typedef struct {
    /// A vector is known with a bound below this, m. Range [0.001, 1], default 0.06: larger says sooner and less.
    float max_lever_m;
    /// A joint is known with a bound of its heading below this, rad. Range [0.01, 1], default 15 deg.
    float max_heading_rad;
    /// Distance of hip and knee, m, if it is known. Range 0 (default, unknown) or [0.1, 1]. Both vectors on the thigh are scaled to it.
    float thigh_length_m;
} jcal_leg_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_leg_config_t jcal_leg_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_leg_config_check(const jcal_leg_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_LEG_CONFIG_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the ball joint. Start from jcal_ball_config_default().
#ifndef JCAL_BALL_CONFIG_H
#define JCAL_BALL_CONFIG_H

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of the ball joint.
typedef struct {
    float
        max_heading_rad;  ///< Ready needs the bound of the heading below this, rad. Range [0.01, 1.0], default 15 deg.
    float
        max_lever_m;  ///< The joint's centre is known from a sensor with a bound below this, m. Range [0.001, 1], default 0.06.
    float slices_per_s;  ///< Slices of work per second, a quarter of it once `ready`. Range [20, 800], default 100.
} jcal_ball_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_ball_config_t jcal_ball_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_ball_config_check(const jcal_ball_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_BALL_CONFIG_H */

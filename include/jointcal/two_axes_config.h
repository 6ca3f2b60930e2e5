/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of a person's joint with two axes. Start from jcal_two_axes_config_default().
#ifndef JCAL_TWO_AXES_CONFIG_H
#define JCAL_TWO_AXES_CONFIG_H

#include "jointcal/ball_config.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of a person's joint with two axes.
typedef struct {
    jcal_ball_config_t ball;  ///< Of heading and levers.
    float max_bound_rad;      ///< An axis is known with a bound below this, rad. Range [0.01, 0.5], default 15 deg.
    /// Directions in sensor frames 1 and 2: each axis is reported with the sign that makes its product with them positive. Zeros, the
    /// default: its largest component is positive. Both hold until the axis is known; then the sign stays. Components in [-1e6, 1e6].
    jcal_vec3_t axis1_toward, axis2_toward;
} jcal_two_axes_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_two_axes_config_t jcal_two_axes_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_two_axes_config_check(const jcal_two_axes_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_AXES_CONFIG_H */

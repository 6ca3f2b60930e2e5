/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of hip and knee. Start from jcal_chain_config_default().
#ifndef JCAL_CHAIN_CONFIG_H
#define JCAL_CHAIN_CONFIG_H

#include "jointcal/center_config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Settings. Start from jcal_chain_config_default().
typedef struct {
    jcal_center_config_t center;  ///< Of both joints; its hinge axes must be zero.
    /// Distance of hip and knee, m, if it is known. Range 0 (default, unknown) or [0.05, 1].
    float segment_length_m;
    float segment_tolerance_m;  ///< Standard deviation of that. Range [1e-4, 0.1], default 0.005.
    /// Unit vector in sensor frame 2 across the plane of both flexion axes, (14a) of [SAL15]: the thigh lies in it. Zero (default): none.
    jcal_vec3_t plane_normal;
    float
        plane_tolerance_m;  ///< Standard deviation of that. Range [1e-4, 0.2], default 0.03: axes are known to 4 deg or so.
    /// A knee that is a hinge: its axis in sensor frames 2 and 3, unit vectors; both zero (default) for other knees.
    jcal_vec3_t knee_axis2;
    jcal_vec3_t knee_axis3;
} jcal_chain_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_chain_config_t jcal_chain_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_chain_config_check(const jcal_chain_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CHAIN_CONFIG_H */

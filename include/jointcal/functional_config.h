/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of the functional joint. Start from jcal_functional_config_default().
#ifndef JCAL_FUNCTIONAL_CONFIG_H
#define JCAL_FUNCTIONAL_CONFIG_H

#include "jointcal/hinge_config.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Settings of the functional joint.
typedef struct {
    float
        max_bound_rad;  ///< Ready for axes needs both bounds of the axes below this, rad. Range [0.001, 0.5], default 3 deg.
    float
        max_flexion_rad;  ///< Ready for flexion needs the error of the angle below this, rad rms. Range [0.001, 0.5], default 3 deg.
    jcal_sign_hint_t sign_hint;  ///< What the user knows about the pairing of signs. Default JCAL_SIGN_UNKNOWN.
    /// A direction in sensor frame 1: axis1 is reported with the sign that makes axis1 . axis1_toward positive. Zeros, the default: its
    /// largest component is positive. Both hold until `ready`; then the sign stays. Components in [-1e6, 1e6].
    jcal_vec3_t axis1_toward;
    float slices_per_s;  ///< Slices of work per second, a quarter of it once `ready`. Range [20, 800], default 100.
} jcal_functional_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_functional_config_t jcal_functional_config_default(void);

/// Name of the first field that is out of its range, "config" for null, or null if the config is valid.
/// Threads:  no state.
const char *jcal_functional_config_check(const jcal_functional_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_FUNCTIONAL_CONFIG_H */

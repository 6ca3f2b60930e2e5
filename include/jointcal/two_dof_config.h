/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of both engines of the joint with two axes. Start from jcal_two_dof_config_default() or
/// jcal_two_dof_window_config_default().
#ifndef JCAL_TWO_DOF_CONFIG_H
#define JCAL_TWO_DOF_CONFIG_H

#include "jointcal/gate.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Which constraint of the joint is used.
typedef enum {
    JCAL_CONSTRAINT_COMBINED = 0,    ///< Both of the following (default).
    JCAL_CONSTRAINT_ROTATION = 1,    ///< The segments do not turn against each other about j1 x j2: (7) of [LAI22].
    JCAL_CONSTRAINT_ORIENTATION = 2  ///< The angle between j1 and j2 does not change: (13) of [LAI22].
} jcal_constraint_t;

/// Settings that both engines share. Start from jcal_two_dof_config_default().
typedef struct {
    jcal_gate_config_t gate;       ///< Of it, frozen_s and gap_s.
    jcal_constraint_t constraint;  ///< Default JCAL_CONSTRAINT_COMBINED.
    float max_bound_rad;           ///< `ready` needs all bounds below this, rad. Range [0.001, 0.5], default 3 deg.
    /// What the model leaves out (scale, misalignment, inclination errors): added to every bound, rad. Range [0, 0.1], default 0.75 deg.
    float mismatch_rad;
    /// Usual violation of the rotation-based constraint at rest, rad/s; grows by rate_error. Range [1e-3, 1], default 0.02.
    float rate_noise_rad_s;
    float
        rate_error;  ///< Growth of that violation with the rates of both sensors, share. Range [0, 0.5], default 0.02.
    float
        angle_noise_rad;  ///< Usual violation of the orientation-based constraint, rad. Range [1e-3, 0.5], default 0.013.
    float heading_drift_rad_s;  ///< How fast the heading offset may drift. Range [0, 0.05], default 3 deg/min.
    /// How long the heading offset is remembered once the status is `ready`, s: older data count for the axes only. Range [2, 600],
    /// default 5.
    float memory_s;
    /// Where the reported axes shall point, in sensor frames 1 and 2, of any length, each in the half-space around its direction. Zero
    /// (default): its largest component is positive. Components of at most 1e6.
    jcal_vec3_t axis1_toward;
    jcal_vec3_t axis2_toward;
} jcal_two_dof_config_t;

/// Settings of the window engine. Start from jcal_two_dof_window_config_default().
typedef struct {
    /// What both engines share. Here `constraint` is JCAL_CONSTRAINT_ROTATION (default) or JCAL_CONSTRAINT_ORIENTATION; memory_s
    /// has no meaning.
    jcal_two_dof_config_t two_dof;
    /// M: samples kept. Range [20, 10000], default 200: 10 s. With less than 2 s of motion in the buffer the status is never `ready`.
    uint16_t n_max;
} jcal_two_dof_window_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_two_dof_config_t jcal_two_dof_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_two_dof_config_check(const jcal_two_dof_config_t *config);

/// The defaults described at each field.
/// Threads:  no state.
jcal_two_dof_window_config_t jcal_two_dof_window_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_two_dof_window_config_check(const jcal_two_dof_window_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_DOF_CONFIG_H */

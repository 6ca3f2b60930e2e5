/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of both engines of the joint centre. Start from jcal_center_config_default() or jcal_center_window_config_default().
#ifndef JCAL_CENTER_CONFIG_H
#define JCAL_CENTER_CONFIG_H

#include "jointcal/gate.h"
#include "jointcal/kinematics.h"

#ifdef __cplusplus
extern "C" {
#endif

/// No place is told that is further than this from a sensor, m: a thigh is 0.5 m long, and what lies further away than twice that is an
/// estimate on its way, from data that say too little.
#define JCAL_CENTER_REACH_M 1.0f

/// What is minimised.
typedef enum {
    JCAL_CENTER_SS = 0,  ///< The sum of squared differences: (15), (16) of [OLS17] (default).
    JCAL_CENTER_SA = 1,  ///< The sum of absolute differences: (20) of [OLS17]; knocks count less.
    /// Vectors instead of lengths, turned by the sensors' orientations: (9) to (14) of [OLS17]. For research: hardly ever ready, because
    /// a degree of tilt is 0.17 m/s^2 in the vectors and nothing in the lengths.
    JCAL_CENTER_LS = 2
} jcal_center_method_t;

/// Settings that both engines share. Start from jcal_center_config_default().
typedef struct {
    jcal_gate_config_t gate;              ///< Limits of single samples.
    jcal_center_method_t method;          ///< Default JCAL_CENTER_SS.
    jcal_kinematics_config_t kinematics;  ///< Angular accelerations and smoothing.
    float max_bound_m;  ///< `ready` needs both bounds below this, m. Range [0.001, 0.1], default 0.01.
    /// What the model leaves out (scale, timing, the place of the accelerometer in its case): the floor of every bound, m.
    /// Range [0, 0.05], default 0.002.
    float mismatch_m;
    /// Error of the gyroscopes' scales, share. One of s moves the centre by s to 2 s times its distance from that sensor; bounds hold 2 s of it.
    /// Range [0, 0.05], default 0.002; for a gyroscope as it comes from the factory 0.01 to 0.02, with which long levers take longer.
    float rate_mismatch;
    /// Usual difference of the two magnitudes in slow motion, m/s^2. Range [1e-3, 10], default 0.05.
    float acc_noise_m_s2;
    /// Growth of that difference with what the turning segments add, share. Range [0, 0.5], default 0.01.
    float turn_error;
    /// Standard deviation of each component of an accelerometer's bias, m/s^2. Range [0, 2], default 0.3; 0 turns these states off.
    float acc_bias_m_s2;
    /// Samples with both rates below this are left out, rad/s; 1.2 in [OLS17]. Range [0, 20], default 0: rest tells of biases.
    float min_rate_rad_s;
    /// Memory of the stream engine for what wanders, s: the accelerometers' biases, and with JCAL_CENTER_LS the heading, for which it is
    /// never more than 60 s. Data of twice this time count half. Range [10, 3600], default 300.
    float memory_s;
    /// Hinges: the joint axis in both sensor frames, unit vectors; both zero (default) for other joints. Any point on the axis is a
    /// centre; results are those next to both sensors, (11) and (12) of [SAL15], and bounds are those across the axis.
    jcal_vec3_t hinge_axis1;
    jcal_vec3_t hinge_axis2;
} jcal_center_config_t;

/// Settings of the window engine. Start from jcal_center_window_config_default().
typedef struct {
    jcal_center_config_t center;  ///< What both engines share.
    uint16_t n_max;               ///< Samples in the window. Range [50, 20000], default 500, as in [OLS17].
} jcal_center_window_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_center_config_t jcal_center_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_center_config_check(const jcal_center_config_t *config);

/// The defaults described at each field.
/// Threads:  no state.
jcal_center_window_config_t jcal_center_window_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_center_window_config_check(const jcal_center_window_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_CENTER_CONFIG_H */

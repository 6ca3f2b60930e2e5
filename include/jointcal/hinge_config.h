/* SPDX-License-Identifier: MIT */
/// @file
/// Settings of both hinge engines. Start from jcal_hinge_config_default() or jcal_hinge_window_config_default().
#ifndef JCAL_HINGE_CONFIG_H
#define JCAL_HINGE_CONFIG_H

#include "jointcal/gate.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the user knows about the sign pairing beforehand.
typedef enum {
    JCAL_SIGN_UNKNOWN = 0,  ///< Find it out (default).
    JCAL_SIGN_SAME = 1,     ///< The largest components of axis1 and axis2 have the same sign.
    JCAL_SIGN_OPPOSITE = 2  ///< They have opposite signs.
} jcal_sign_hint_t;

/// How well the gyroscopes are known: sets `rate_mismatch`.
typedef enum {
    JCAL_GYR_CALIBRATED = 0,  ///< Each one on a turntable: scale to 0.2 %, axes to 0.1 deg (default). 0.002.
    JCAL_GYR_AS_IT_COMES =
        1  ///< A MEMS chip as it is sold: scale to 2 %, axes to 1 deg. 0.01; ready takes about twice as long.
} jcal_gyr_grade_t;

/// Settings that both hinge engines share. Start from jcal_hinge_config_default().
///
/// The noise and bias fields set how much each kind of data counts and what may be blamed on a bias; bounds are made
/// from the residuals that are really met, so that a wrong value here costs sharpness, not honesty.
typedef struct {
    jcal_gate_config_t gate;  ///< Limits of single samples.
    float max_bound_rad;      ///< `ready` needs both bounds below this, rad. Range [0.001, 0.5], default 3 deg.
    /// What the model leaves out (scale, misalignment, timing of the gyroscopes), as a share of the rate: the floor
    /// of every bound. Range [0, 0.05], default 0.002. Larger: wider bounds. jcal_hinge_config_set_gyroscope knows two values.
    float rate_mismatch;
    /// Usual disagreement of the two rates across the axis, rad/s. Range [1e-4, 1], default 0.03.
    float gyr_noise_rad_s;
    /// Usual disagreement of the two specific forces along the axis in slow motion, m/s^2, with what it lasts longer
    /// than that of the rates. Range [1e-3, 10], default 1.5.
    float acc_noise_m_s2;
    /// Growth of that disagreement with the product of the rates, m: the distance from the joint axis, again with its
    /// longer duration. Range [0, 5], default 1.
    float lever_arm_m;
    float gyr_bias_rad_s;        ///< Standard deviation of each component of a gyroscope's bias, rad/s.
                                 ///< Range [1e-5, 0.2], default 0.007 (0.4 deg/s). 1e-5 turns the bias states off.
    float acc_bias_m_s2;         ///< The same of an accelerometer, m/s^2. Range [1e-4, 5], default 0.5.
    jcal_sign_hint_t sign_hint;  ///< Default JCAL_SIGN_UNKNOWN.
    /// A direction in sensor frame 1, of any length: axis1 is reported with the sign that makes axis1 . axis1_toward positive. Zeros,
    /// the default: its largest component is positive. Both hold until `ready`; then the sign stays. Components in [-1e6, 1e6].
    jcal_vec3_t axis1_toward;
    /// Slices of work per second of sample time, a quarter of it once `ready`; at most 10 in one step. Range [20, 800], default
    /// 200. Fewer: less work in the busiest step, longer until `ready`; docs/METHOD.md, section 8, has the measured trade.
    float slices_per_s;
} jcal_hinge_config_t;

/// Settings of the window engine. Start from jcal_hinge_window_config_default().
typedef struct {
    /// What both engines share.
    jcal_hinge_config_t hinge;
    /// Samples kept per sensor kind. Range [20, 10000], default 500. [OLS20] 7.3 tried 125 to 1000.
    uint16_t n_max;
    /// n of (44) and (45): windows of 2n + 1 samples. Range [0, 100], default 21: 43 samples, as the paper's text says.
    /// Its "0.42 s" and its public code mean 21 samples in all: 10. Larger is more cautious about outliers and
    /// transitions, and needs longer calm for the accelerometers.
    uint16_t half_window;
    /// Weight ratio of (70). Range [1e-3, 1e10], default 50. Larger trusts the gyroscopes more.
    float w0;
    /// E_th of Algorithm 3. Range (0, 1e4], default 1. Larger admits faster motion.
    float energy_max_rad2_s2;
    /// Accelerometer samples kept whatever E_th says. Range [0, 10000], default 250; at most n_max of them count.
    /// 0 is the paper's: on lively motion few or none are left, and the sign pairing is a guess.
    uint16_t acc_min;
    /// E_max of Algorithm 4. Range [0.001, 0.5], default 3 deg.
    float accept_bound_rad;
    /// n_min of Algorithm 4. Range [1, 100], default 10.
    uint16_t accept_count;
    /// Seconds of sample time between full solves. Range [0.1, 60], default 1.
    float solve_period_s;
    /// Seed of the random starts, any value; default 2020. Equal seeds and samples give equal results.
    uint32_t seed;
} jcal_hinge_window_config_t;

/// The defaults described at each field.
/// Threads:  no state.
jcal_hinge_config_t jcal_hinge_config_default(void);

/// Sets `rate_mismatch` to what gyroscopes of this grade need for the bounds to hold: docs/measurements/sensor_faults.md.
///
/// Errors:   JCAL_ERR_ARG (null, or no such grade); nothing is changed then.
/// Threads:  no state.
JCAL_MUST_CHECK jcal_status_t jcal_hinge_config_set_gyroscope(jcal_hinge_config_t *config, jcal_gyr_grade_t grade);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_hinge_config_check(const jcal_hinge_config_t *config);

/// The defaults described at each field.
/// Threads:  no state.
jcal_hinge_window_config_t jcal_hinge_window_config_default(void);

/// Name of the first field that is out of its range, or null if the config is valid; "config" if that is null itself.
/// Threads:  no state.
const char *jcal_hinge_window_config_check(const jcal_hinge_window_config_t *config);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_CONFIG_H */

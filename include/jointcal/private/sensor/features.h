/* SPDX-License-Identifier: MIT */
/// @file
/// State of the filters that make the features; lib/imu/features.h has the equations.
#ifndef JCAL_PRIVATE_SENSOR_FEATURES_H
#define JCAL_PRIVATE_SENSOR_FEATURES_H

#include "jointcal/tick.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Signals that are low-passed at every sample: R [w]x (9), R a - g (3), w (3).
#define JCAL_FEATURE_SIGNALS 15

/// The filters, and the last tick.
typedef struct {
    float chain[JCAL_FEATURE_SIGNALS][3];  ///< Three one-poles in series each.
    /// I: integral of v since the last tick. Between the first sample and the second, whose distance tells the coefficients: half of the
    /// first R a - g, m/s^2.
    jcal_vec3_t way_m_s;
    float lever_high[9][3];     ///< Three high-passes of Q; what came before is rate and lever of the tick.
    float velocity_high[3][3];  ///< u and two high-passes of it.
    jcal_tick_t tick;
} jcal_features_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_SENSOR_FEATURES_H */

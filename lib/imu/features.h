/* SPDX-License-Identifier: MIT */
/// @file
/// Filters that make the features of tick.h. Private.
///
/// Every sample, a = 1 - exp(-2 pi 5 Hz dt), L3 three times y <- y + a (x - y):
///
///     Q = L3(R [w]x),   v = L3(R a - g),   wl = L3(w),   I <- I + dt (v + v before) / 2.
///
/// Every tick, b = 1 - exp(-2 pi 0.4 Hz T), c = 1 - exp(-2 pi 3 Hz T), H: h <- (1 - b)(h + x - x before), L: y <- y + c (x - y):
///
///     u <- (1 - b)(u + I), I <- 0,   U = L H H u,   B = L H H H Q.
///
/// The derivative of R is R [w]x, so B is R through the same filters as the position r would go: one high-pass of Q is what u is of v. All
/// begin as if the first sample had always been: Q and wl at its values, each high-pass with x before = its first x. v begins at 0, and its
/// first value counts half, as the first one of a trapezoidal rule does: without it I and the change of Q would differ by dt v / 2.
#ifndef JCAL_IMU_FEATURES_H
#define JCAL_IMU_FEATURES_H

#include "jointcal/private/sensor/stage.h"

/// The first sample of an epoch: R, w less its bias, a and R a. The tick keeps its count of epochs.
void jcal_features_begin(jcal_features_t *self, const float r[9], const jcal_imu_t *imu, jcal_vec3_t force_m_s2);

/// Before the second sample of an epoch, whose distance tells how the first one is taken in.
void jcal_features_second(jcal_features_t *self, const jcal_sample_rates_t *rates);

/// Coefficients for samples `dt_s` apart, and for ticks.
void jcal_features_set_sample(jcal_sample_rates_t *rates);
void jcal_features_set_tick(jcal_tick_rates_t *rates);

/// Takes in a sample: R, w less its bias, a and R a.
void jcal_features_sample(jcal_features_t *self, const jcal_sample_rates_t *rates, const float r[9],
                          const jcal_imu_t *imu, jcal_vec3_t force_m_s2);

/// Makes a tick.
void jcal_features_tick(jcal_features_t *self, const jcal_tick_rates_t *rates, const float r[9]);

#endif /* JCAL_IMU_FEATURES_H */

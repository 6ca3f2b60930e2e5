/* SPDX-License-Identifier: MIT */
/// @file
/// Bias of a gyroscope: measured at rest, and in motion by how the inclination must be corrected. Private.
///
/// A Kalman filter of three states, b, whose covariance P grows by V at every tick; z = C b + noise, one component after the other:
///
/// - at rest (both readings within limits of their own low-passed ones for 2 s): z is the low-passed rate, C = I;
/// - in motion: a bias that was not taken off turns the orientation by R (b - b'), b' what was taken off, and the inclination is corrected
///   against that, as the low-pass L lets it through: L(R) b = L(R b') - correction / T, x and y. Of the vertical part nothing is known
///   but that it is small: 0 = z of L(R) b with a variance 10,000 times as large, so that P stays bounded.
///
/// Source: [VQF] section 3.4 and 3.5, with its parameters but two, which bias.c names. Differs from it in: once a tick; rest by one-poles of 0.5 s; in motion only
/// after the low-pass has settled.
#ifndef JCAL_IMU_BIAS_H
#define JCAL_IMU_BIAS_H

#include "imu/lowpass.h"
#include "jointcal/private/sensor/bias.h"
#include "jointcal/private/sensor/stage.h"

/// No bias is known.
void jcal_bias_begin(jcal_gyr_bias_t *self);

/// The first sample, and the first one after a gap; what is known of the bias stays.
void jcal_bias_restart(jcal_gyr_bias_t *self, const jcal_imu_t *imu);

/// Follows rest.
void jcal_bias_sample(jcal_gyr_bias_t *self, const jcal_imu_t *imu, const jcal_sample_rates_t *rates);

/// What a tick of `dt_s` tells. correction_rad: of the inclination, in the earth frame; null if there was none.
void jcal_bias_tick(jcal_gyr_bias_t *self, float dt_s, const jcal_lowpass_t *by, const float r[9],
                    const jcal_vec3_t *correction_rad);

#endif /* JCAL_IMU_BIAS_H */

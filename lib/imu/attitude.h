/* SPDX-License-Identifier: MIT */
/// @file
/// 6D orientation filter: rates turn it, the specific force levels it. Private.
///
/// Every sample: q <- q exp(w dt / 2), w the mean of the rates, less the bias, at both ends of dt. Every tick: f, the mean of R a since
/// the last one, goes through a second-order low-pass; the direction that comes out is turned to z by the smallest rotation, which is about
/// a horizontal axis and so changes no heading. The low-pass is to see a frame that does not turn: where the orientation is corrected, its
/// states are turned too. So they hold R a in the earth frame of now, and what is to be levelled is small in them.
///
/// Source: [VQF] section 3.1 to 3.3. Differs from it in: levelled every tick, not every sample (with tau = 3 s that is nothing, and
/// three quarters of the work); mean of two rates, for rate and specific force of a sample belong to one instant; states turned
/// instead of a second quaternion.
#ifndef JCAL_IMU_ATTITUDE_H
#define JCAL_IMU_ATTITUDE_H

#include "imu/lowpass.h"
#include "jointcal/private/sensor/attitude.h"
#include "jointcal/quat.h"

/// The first sample, and the first one after a gap: levels the orientation by it alone; its heading stays.
void jcal_attitude_begin(jcal_attitude_t *self, jcal_vec3_t gyr_rad_s, jcal_vec3_t acc_m_s2);

/// Turns by the rate, less its bias, over `dt_s`. Outputs: r, the matrix; returns R a.
jcal_vec3_t jcal_attitude_turn(jcal_attitude_t *self, jcal_vec3_t gyr_rad_s, jcal_vec3_t acc_m_s2, float dt_s,
                               float r[9]);

/// Levels by the mean since the last tick, `dt_s` ago. Outputs: correction, rad: the rotation vector in the earth frame; its z is 0. False if the
/// specific force has no direction (free fall); then nothing is corrected.
bool jcal_attitude_level(jcal_attitude_t *self, const jcal_lowpass_t *by, float dt_s, jcal_vec3_t *correction_rad);

#endif /* JCAL_IMU_ATTITUDE_H */

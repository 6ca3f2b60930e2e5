/* SPDX-License-Identifier: MIT */
/// @file
/// The orientation filter VQF [VQF] behind C functions: angular rate and specific force in, orientation out.
///
/// Six axes, no magnetometer: the inclination is that of gravity; the heading is arbitrary at the start and drifts slowly.
/// Single precision, with double precision inside VQF's low-pass filters. The parameters are VQF's defaults.
#ifndef JCAL_VQF_H
#define JCAL_VQF_H

#include "jointcal/status.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Bytes of state per sensor.
#define JCAL_VQF_BYTES 856
/// Sample periods that init accepts, s.
#define JCAL_VQF_PERIOD_MIN_S 1e-4f
#define JCAL_VQF_PERIOD_MAX_S 0.1f

/// State of one filter; the caller owns it and looks at no member.
typedef union {
    uint64_t align;
    unsigned char bytes[JCAL_VQF_BYTES];
} jcal_vqf_t;

/// Starts a filter. JCAL_ERR_ARG if self is null; JCAL_ERR_CONFIG if a period (s) is outside
/// [JCAL_VQF_PERIOD_MIN_S, JCAL_VQF_PERIOD_MAX_S] or not finite; the state is then as before.
/// Threads: one at a time per state.
JCAL_MUST_CHECK jcal_status_t jcal_vqf_init(jcal_vqf_t *self, float gyr_period_s, float acc_period_s);

/// Takes one sample: gyr in rad/s, acc in m/s^2, both in the sensor's frame.
///
/// quat (w, x, y, z) becomes the orientation that takes vectors from the sensor's frame to an earth frame whose z points up.
/// JCAL_ERR_ARG if a pointer is null; JCAL_REJECTED if a component is not finite: state and quat are then as before.
/// An acc of exactly zero only skips the correction by gravity. Needs init. Threads: one at a time per state.
JCAL_MUST_CHECK jcal_status_t jcal_vqf_update(jcal_vqf_t *self, const float gyr[3], const float acc[3], float quat[4]);

/// Forgets all samples and keeps the periods. JCAL_ERR_ARG if self is null. Needs init. Threads: one at a time per state.
JCAL_MUST_CHECK jcal_status_t jcal_vqf_reset(jcal_vqf_t *self);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_VQF_H */

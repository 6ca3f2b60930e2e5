/* SPDX-License-Identifier: MIT */
/// @file
/// Share of a one-pole low-pass, without an exponential of libm.
#ifndef JCAL_DECAY_H
#define JCAL_DECAY_H

#ifdef __cplusplus
extern "C" {
#endif

/// 1 - e^-x for 0 <= x <= 5, relative error below 5e-7: what a one-pole takes over of a new value after x time constants.
///
/// Method:   series for x/8, then (1 - e^-2y) = p (2 - p) three times; nothing is subtracted that is nearly equal.
/// Cost:     17 multiplications.
float jcal_taken_over(float x);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_DECAY_H */

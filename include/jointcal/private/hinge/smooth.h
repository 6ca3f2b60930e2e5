/* SPDX-License-Identifier: MIT */
/// @file
/// Rates on their way through the low-pass; lib/hinge/smooth.h.
#ifndef JCAL_PRIVATE_HINGE_SMOOTH_H
#define JCAL_PRIVATE_HINGE_SMOOTH_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Rates of both sensors behind the first low-pass and behind the second one, rad/s.
typedef struct {
    jcal_vec3_t half[2];
    jcal_vec3_t whole[2];
} jcal_hinge_smooth_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_SMOOTH_H */

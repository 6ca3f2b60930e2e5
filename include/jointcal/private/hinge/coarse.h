/* SPDX-License-Identifier: MIT */
/// @file
/// The coarse estimate: the sums, and their best minimum so far.
#ifndef JCAL_PRIVATE_HINGE_COARSE_H
#define JCAL_PRIVATE_HINGE_COARSE_H

#include "jointcal/private/hinge/moments.h"
#include "jointcal/private/hinge/point.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The coarse estimate: the sums, and their best minimum so far.
typedef struct {
    jcal_hinge_moments_t moments;
    jcal_hinge_point_t point;  ///< Minimum of the moments: where the refined axes begin.
    float damping;
    float acc_constant_m_s2;  ///< Estimate of c = j1 . b_a1 - j2 . b_a2.
    bool has_point;
} jcal_hinge_coarse_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_COARSE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// What the functional joint is judged by. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_FUNCTIONAL_VERDICT_H
#define JCAL_PRIVATE_FUNCTIONAL_VERDICT_H

#include "jointcal/private/functional/point.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// What has been found out about the estimate.
typedef struct {
    float hessian[10];  ///< Information about both axes, two tangents each, on its way (4 x 4, packed).
    float slope[4];     ///< Of the cost by the same tangents, on its way.
    float block_share[JCAL_FUNCTIONAL_BLOCKS];  ///< Share of each block in all motion when these were begun.
    float bound1_rad, bound2_rad;               ///< 95 % bounds of the axes.
    float flexion_rad;                          ///< Error that the axes make in the joint's angle, rms.
    float evidence[JCAL_FAMILIES];  ///< Logarithm of the odds for this pairing of signs, of each kind of residual.
    float opposite;                 ///< Mean square that the other pairing leaves of the lever residual, (m/s)^2.
    float share;                    ///< Share of the relative rate that is along the axis.
    float bend_rad;                 ///< How far the joint bent, rms.
    float stiffness;                ///< What one fixed rotation between the rates leaves of the smaller one.
    uint8_t status, reason, weak, hint;
    uint8_t agreed;    ///< Judgements in a row that found nothing against `ready`.
    bool is_one_axis;  ///< Nothing says that there is no axis, whatever else keeps it from being ready.
    bool for_axes;     ///< The bounds of the axes are within their limit.
    bool for_flexion;  ///< The error of the angle is.
} jcal_functional_verdict_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_FUNCTIONAL_VERDICT_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Sums at the estimate; lib/center/sums.h has the equations.
#ifndef JCAL_PRIVATE_CENTER_SUMS_H
#define JCAL_PRIVATE_CENTER_SUMS_H

#include "jointcal/private/center/point.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Sums at the estimate; lib/center/sums.h has the equations.
typedef struct {
    jcal_center_point_t point;   ///< The estimate.
    jcal_center_place_t anchor;  ///< Where it was when the sums began.
    float matrix[78];            ///< Packed 12 x 12.
    float gradient[12];          ///< Half the gradient at `point`, without that of the biases' prior.
    float scatter[78];           ///< Sum over blocks of gradient gradient' ...
    float closed[12];            ///< ... and of their gradients.
    float block[12];             ///< Gradient of the block that is being summed.
    float block_s;               ///< Its time.
    float blocks;                ///< Blocks in `scatter`.
    float cost;                  ///< Sum of squared residuals at `point`, weighted.
    float effect;                ///< The same of what the joint-to-sensor vectors explain: the residuals at r = 0.
    float noise;                 ///< The same of what the config calls usual.
    float weight;                ///< Sum of the weights, 1 / (m/s^2)^2.
    float raw;                   ///< Sum of squared residuals as they came in, weighted ...
    float lagged;                ///< ... and of products of those that are four samples apart.
    float recent[3][4];          ///< The last residuals, each part of them, m/s^2.
    float time_s;                ///< Time in the sums.
    float turn1, turn2;          ///< Integral of each sensor's squared rate.
} jcal_center_sums_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_SUMS_H */

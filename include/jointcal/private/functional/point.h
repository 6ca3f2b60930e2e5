/* SPDX-License-Identifier: MIT */
/// @file
/// A solution of the functional joint. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_FUNCTIONAL_POINT_H
#define JCAL_PRIVATE_FUNCTIONAL_POINT_H

#include "jointcal/private/functional/sums.h"
#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Kinds of residuals: of orientations, of rates across the axis, of the joint centre's motion.
typedef enum { JCAL_FAMILY_TURN = 0, JCAL_FAMILY_RATE = 1, JCAL_FAMILY_LEVER = 2 } jcal_family_t;
#define JCAL_FAMILIES 3u

/// One solution, with what its residuals are like.
typedef struct {
    jcal_vec3_t j1, j2;                            ///< Axes, each in its sensor frame.
    jcal_vec3_t r1, r2;                            ///< Joint to sensor, each in its sensor frame, m.
    jcal_plane_t heading[JCAL_FUNCTIONAL_BLOCKS];  ///< L2 to L1 about z, a unit complex number per block.
    float turn[JCAL_FUNCTIONAL_BLOCKS][9];         ///< D: L2 to L1 as the rates see it, row-major.
    float size[JCAL_FAMILIES];    ///< Mean squares of the residuals, above their floors: rad^2, 1, (m/s)^2.
    float weight[JCAL_FAMILIES];  ///< What a unit of each sum counts.
    float lack;                   ///< Sum of squares that the levers leave, (m/s)^2 s.
    float speed2;                 ///< Mean square of both sides of the lever equation, (m/s)^2.
    float energy;                 ///< Mean logarithm of the odds against it, per second of motion: less is better.
} jcal_functional_point_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_FUNCTIONAL_POINT_H */

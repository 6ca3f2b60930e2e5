/* SPDX-License-Identifier: MIT */
/// @file
/// The unknowns of a joint centre.
#ifndef JCAL_PRIVATE_CENTER_POINT_H
#define JCAL_PRIVATE_CENTER_POINT_H

#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Number of features of the squared residual; lib/center/model.h says which.
#define JCAL_CENTER_FEATURES 19

/// Unknowns: r1, r2, biases of the accelerometers.
#define JCAL_CENTER_UNKNOWNS 12

/// Both joint-to-sensor vectors.
typedef struct {
    jcal_vec3_t r1, r2;
} jcal_center_place_t;

/// A place and the other unknowns: with lengths the accelerometers' biases, with orientations the heading offset.
typedef struct {
    jcal_center_place_t place;
    jcal_vec3_t b1, b2;
    jcal_plane_t heading;  ///< Turns earth frame 2 to earth frame 1.
    bool is_oriented;      ///< Unknown 6 is the heading; biases are zero.
} jcal_center_point_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_POINT_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// A pair of axes of the hinge.
#ifndef JCAL_PRIVATE_HINGE_POINT_H
#define JCAL_PRIVATE_HINGE_POINT_H

#include "jointcal/types.h"

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// One axis and a direction across it.
typedef struct {
    jcal_vec3_t j;
    jcal_vec3_t u;
} jcal_hinge_axis_t;

/// A point of the parameter space.
typedef struct {
    jcal_hinge_axis_t axis1;
    jcal_hinge_axis_t axis2;
} jcal_hinge_point_t;

/// A point without its tangent directions.
typedef struct {
    jcal_vec3_t j1, j2;
} jcal_hinge_place_t;

/// An axis that is kept for later, to 0.002 deg; lib/hinge/point.h.
typedef struct {
    int16_t c[3];
} jcal_hinge_note_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_POINT_H */

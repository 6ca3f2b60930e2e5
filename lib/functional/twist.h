/* SPDX-License-Identifier: MIT */
/// @file
/// The twist of a joint about its axes, from a zero that each sensor's own axes fix. Private.
#ifndef JCAL_FUNCTIONAL_TWIST_H
#define JCAL_FUNCTIONAL_TWIST_H

#include "jointcal/types.h"
#include "math/plane.h"

#include <stdint.h>

/// Axes in their sensor's frame, and what the angle counts from: the sensors' axes number `zero`, 0 to 2. While those stay, the angle
/// follows the joint's axes without a step as they improve, as long as neither comes near the sensor's axis that its zero is. Both joint
/// axes with the other sign give the same angle with the other sign.
typedef struct {
    jcal_vec3_t axis1, axis2;
    uint8_t zero[2];
} jcal_twist_t;

/// The sensor's axis that is farthest from this one.
uint8_t jcal_twist_zero(jcal_vec3_t axis);

/// Twist of R1' Rz(heading) R2 about the axes, rad. Cost: 90 multiply-adds and an arc tangent.
float jcal_twist_angle(const jcal_twist_t *twist, jcal_plane_t heading, jcal_quat_t orientation1,
                       jcal_quat_t orientation2);

#endif /* JCAL_FUNCTIONAL_TWIST_H */

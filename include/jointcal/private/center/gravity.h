/* SPDX-License-Identifier: MIT */
/// @file
/// What both specific forces say of gravity and of each other; lib/center/gravity.h has the equations.
#ifndef JCAL_PRIVATE_CENTER_GRAVITY_H
#define JCAL_PRIVATE_CENTER_GRAVITY_H

#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What both specific forces say of gravity and of each other; lib/center/gravity.h has the equations.
typedef struct {
    uint64_t last_us;  ///< Time of the last sample.
    jcal_vec3_t mean1,
        mean2;              ///< Means of the specific forces in frames that do not turn, over some seconds, m/s^2 ...
    float chain_s;          ///< ... and the time since they began.
    float level1, level2;   ///< Mean lengths of these, m/s^2 ...
    float time_s;           ///< ... and the time in them.
    jcal_plane_t turned;    ///< Sum of products of the horizontal forces at the joint, one conjugated ...
    jcal_plane_t mirrored;  ///< ... the same of one that is mirrored ...
    float power;            ///< ... of their lengths' products ...
    float power_s;          ///< ... and the time in these three.
} jcal_center_gravity_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_GRAVITY_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// State of what follows the heading offset. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_HEADING_H
#define JCAL_PRIVATE_HEADING_H

#include "jointcal/private/clock.h"
#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Follows the heading offset with known axes. Caller-owned, plain, copyable; all members are private.
typedef struct {
    jcal_vec3_t axis1, axis2;  ///< Unit axes in sensor frames 1 and 2.
    float sin_carrying;
    float memory_s;
    bool hinge;
    bool has_time;
    uint64_t t_us;  ///< Time of the last pair.
    jcal_clock_t clock;
    float weight;  ///< Fading sum of time, s.
    float sums
        [6];  ///< Fading sums: products of (G_c, G_s, G_1), upper triangle row by row; of a hinge the first two only.
    jcal_heading_t last;
} jcal_joint_heading_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HEADING_H */

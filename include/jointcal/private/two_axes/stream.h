/* SPDX-License-Identifier: MIT */
/// @file
/// State of a person's joint with two axes. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_TWO_AXES_STREAM_H
#define JCAL_PRIVATE_TWO_AXES_STREAM_H

#include "jointcal/private/ball/stream.h"
#include "jointcal/two_axes_config.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Half a window.
typedef struct {
    float seen
        [2]
        [6];  ///< Sum of the relative rate's outer products, in the frames of sensor 1 and of sensor 2 (3 x 3, packed).
    float mean[9];         ///< Sum of R1' Rz R2, times seconds.
    jcal_plane_t heading;  ///< At its first tick.
    float carried2;        ///< Squared rate of the proximal segment, weighted as the relative one.
    float motion_s;        ///< Seconds in which the joint moves.
    float time_s;
    jcal_vec3_t main[2];  ///< Main directions of `seen`, once it is closed.
} jcal_axis_part_t;

/// An axis that was found: the first in frame 1, the second in frame 2.
typedef struct {
    float seen[6];      ///< Of all windows that agree (3 x 3, packed).
    jcal_vec3_t axis;   ///< Its main direction.
    float bound_rad;    ///< 95 % bound of it.
    float heading_rad;  ///< What the heading's error may add, mean of all windows.
    uint8_t windows;    ///< How many agree; those before the last twelve do not count.
    uint8_t against;    ///< How many in a row did not.
    bool in_doubt;      ///< The joint was lost since: unknown until another window agrees.
    int8_t kept_sign;
} jcal_axis_found_t;

/// Windows of 5 s, each of two parts: what one motion dominates shows an axis.
typedef struct {
    jcal_axis_part_t part[3];  ///< 0 open, 1 the last one, 2 the one before.
    jcal_axis_found_t found[2];
    jcal_vec3_t main[2];  ///< Main directions of the window, on their way.
    float sideways[2];    ///< Second eigenvalue over the first, on their way.
    uint8_t slice;        ///< Next slice of the work on a window.
    uint8_t kind;         ///< Axis that the window is of.
} jcal_axis_windows_t;

/// A person's joint with two axes. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_two_axes_config_t cfg;
    jcal_ball_t ball;
    jcal_axis_windows_t windows;
} jcal_two_axes_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_AXES_STREAM_H */

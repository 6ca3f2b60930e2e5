/* SPDX-License-Identifier: MIT */
/// @file
/// Axes from windows that one motion dominates. Private.
///
/// The relative rate w = Rz R2 w2 - R1 w1 is summed as w w' in both sensor frames, in parts of 2.5 s; two parts are a window. A window shows
/// an axis if its second eigenvalue is at most 12 % of the first in both frames, if both halves show the same direction, and if the joint
/// bends by 0.2 rad rms. Which axis it is, is seen beside the levers: about the forearm's own line it is turning, across it bending; about
/// the upper arm's own line it is skin, and nothing. Source: docs/METHOD_PEOPLE.md, section 11.
#ifndef JCAL_TWO_AXES_WINDOWS_H
#define JCAL_TWO_AXES_WINDOWS_H

#include "jointcal/private/two_axes/stream.h"
#include "jointcal/tick.h"

#include <stdbool.h>

/// What a window is judged with.
typedef struct {
    jcal_vec3_t r1, r2;    ///< Levers.
    jcal_plane_t heading;  ///< That of this moment, and its bound.
    float heading_rad;
    float bound2_m;  ///< Bound of r2.
    bool is_joint;   ///< Nothing speaks against one joint.
} jcal_window_context_t;

/// Adds a tick with the heading of its moment. Closes a part that is long enough; what it shows is worked off by `step`. Cost: 150
/// multiply-adds.
void jcal_axis_windows_add(jcal_axis_windows_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                           jcal_plane_t heading);

/// The next slice of the work on a window; false if there is none. Cost: the eigenvectors of a 3 x 3 matrix.
bool jcal_axis_windows_step(jcal_axis_windows_t *self, const jcal_window_context_t *context);

/// Both parts are given up: what comes does not follow them.
void jcal_axis_windows_cut(jcal_axis_windows_t *self);

#endif /* JCAL_TWO_AXES_WINDOWS_H */

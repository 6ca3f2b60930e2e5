/* SPDX-License-Identifier: MIT */
/// @file
/// Rows of a recording as pairs of orientations: from the columns q1_w ... q2_z, or by VQF from rates and specific forces.
///
/// VQF wants a constant sample period. It is the median of the time steps of the first rows, which are held back until it is
/// known. A row that the gate refuses, or one that is missing, is a turn that nobody saw: the filters get the reading before it
/// once more for every period, so that a lost packet costs the change of the rate and not the turn. After a gap they go on as they
/// are: the inclination comes back by itself, the heading has lost what happened meanwhile.
#ifndef JCAL_CLI_ORIENTATIONS_H
#define JCAL_CLI_ORIENTATIONS_H

#include "input.h"
#include "jointcal/jointcal.h"
#include "recording.h"
#include "timeline.h"

/// Rows that the sample period is found from.
#define ORIENTATIONS_AHEAD 50u

/// A row with its orientations.
typedef struct {
    recording_row_t row;
    timeline_t timeline;           ///< After this row.
    jcal_orientation_pair_t pair;  ///< At the library's time. Of no use if the row is refused for anything but a gap.
    jcal_reject_t reject;  ///< What the gate of readings says; JCAL_REJECT_NONE where orientations come from columns.
} oriented_row_t;

typedef struct orientations orientations_t;

/// Prepares to read an open recording. Null if memory ran out.
orientations_t *orientations_open(recording_t *recording);

/// True if the recording has orientations, or this program has the filter that finds them; else it complains.
bool orientations_possible(const input_t *input, const recording_t *recording);

/// True if they come from the recording's own columns.
bool orientations_from_columns(const orientations_t *orientations);

/// Reads one row; RECORDING_BAD also where the sample period is none that VQF can work with.
recording_event_t orientations_next(orientations_t *orientations, oriented_row_t *out);

/// Releases memory, not the recording.
void orientations_close(orientations_t *orientations);

#endif

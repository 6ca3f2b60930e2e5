/* SPDX-License-Identifier: MIT */
/// @file
/// Orientations of the rows of a recording: from its columns, or from its rates and specific forces by the filter VQF [VQF].
///
/// The filter gets a sample per sample period, whatever happened to the rows. The period is the median time step of the first
/// rows, which wait for it and are then delivered in order; a step of another length is shared out by scaling the rates, so
/// that an orientation turns by rate times time of the file.
///
/// A row that the library's gate rejects has no orientations, and the filter gets it only if it is merely clipped (the clipped
/// rate is the best one known), comes after a hole, or repeats the reading before it. Repeated readings stand for lost packets; they
/// are fed as they are, so that orientations and their headings are those that VQF gives for the recording anywhere else. (Bridging
/// them, as below, would turn 9 of 10 lost packets right to 0.16 deg, a third of the error; on rig_2D_05, 254 of them in 5 minutes
/// of fast motion, the headings then part by 4 deg from VQF's on the rows as they stand.)
///
/// Up to 0.15 s without a row are filled by straight lines between the neighbours: right to 3.3 deg over 0.14 s in 9 of 10 holes cut
/// into fast motion, 11 deg over 0.26 s. After a longer hole nobody knows where the sensors have turned: the filter starts again, and
/// so must what builds on the headings (`restarted`).
#ifndef JCAL_CLI_INPUT_ORIENTATIONS_H
#define JCAL_CLI_INPUT_ORIENTATIONS_H

#include "input/recording.h"
#include "input/row_clock.h"
#include "jointcal/gate.h"

/// Rows that are waited for to learn the sample period.
#define ORIENTATIONS_WAIT 50

/// Most sensors of a recording.
#define ORIENTATIONS_SENSORS 3

/// Where orientations come from.
typedef enum {
    ORIENTATIONS_FROM_COLUMNS,
    ORIENTATIONS_FROM_FILTER,
    ORIENTATIONS_FROM_JOINT  ///< The joint's engine has filters of its own: rows come without, `reject` as with a filter.
} orientations_source_t;

/// A row with its orientations.
typedef struct {
    recording_row_t row;   ///< As in the file, but q1 and q2 are unit quaternions if `reject` is JCAL_REJECT_NONE.
    jcal_reject_t reject;  ///< Why the row has no orientations; JCAL_REJECT_NONE if it has.
    bool restarted;        ///< Headings have nothing to do with those of the rows before.
} oriented_row_t;

/// One sensor's filter and what it got last. Private.
typedef struct orientations_filter orientations_filter_t;

typedef struct {
    orientations_source_t source;

    /* Private. */
    recording_t *recording;
    orientations_filter_t *filters; /* one for each sensor, or null */
    jcal_gate_t gate;
    jcal_gate_t gate3; /* of sensors 1 and 3, if there are three */
    jcal_gate_config_t gate_config;
    float missing_share; /* of rows without orientations in the columns, averaged over about 50 rows */
    row_clock_t clock;
    int64_t period_us;
    int64_t fed_us; /* time in the file of what the filters got last */
    bool has_fed;
    bool restart_due;                        /* the filters started again and no row has told of it yet */
    recording_row_t rows[ORIENTATIONS_WAIT]; /* rows that wait */
    size_t row_count;
    size_t row_at;
    recording_event_t event; /* what followed the rows that wait */
    bool waited;
} orientations_t;

/// Prepares for a recording that has been opened. Where there are no columns VQF computes orientations, unless `joint_has_own`. RECORDING_ROW; RECORDING_BAD with the recording's fault set (a sensor has only some
/// of its columns; or there are none, and the program was built without the filter); RECORDING_FAILED if memory ran out.
recording_event_t orientations_open(orientations_t *self, recording_t *recording, bool joint_has_own);

/// Next row, as recording_next, which must not be called any more.
recording_event_t orientations_next(orientations_t *self, oriented_row_t *row);

/// What is wrong with the readings as a whole, as the library's gate has it; JCAL_REASON_NONE for orientations from columns.
jcal_reason_t orientations_complaint(const orientations_t *self);

/// Where the orientations come from, in words.
const char *orientations_words(const orientations_t *self);

/// Releases memory.
void orientations_close(orientations_t *self);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Rows of joint angles: zero and signs applied, as CSV or as an OpenSim storage file.
///
/// Rows are written as they come where that is possible. Where a pose or the range of the whole recording decides, or the
/// number of rows must stand in the header, they wait in a temporary file: memory does not grow with the recording.
#ifndef JCAL_CLI_ANGLES_OUTPUT_H
#define JCAL_CLI_ANGLES_OUTPUT_H

#include "angles_options.h"
#include "message.h"

#include <stdio.h>

/// One row of the recording.
typedef struct {
    int64_t t_us;  ///< As in the recording.
    bool has_time;
    bool known;  ///< The angles are.
    jcal_joint_angles_t angles;
    float heading_rad;
} angles_row_t;

typedef struct {
    const angles_options_t *options;
    FILE *file;
    const char *name;
    FILE *waiting;  ///< Rows that wait for the end, or null.
    /* Private: what is done to each row. */
    bool zeroed;
    jcal_joint_angles_t zero; /* angles of the reference pose, as they come */
    float sign_flexion, sign_pronation;
} angles_output_t;

/// Opens the file. EXIT_READY, or another status after a message.
exit_status_t angles_output_open(angles_output_t *output, const angles_options_t *options);

/// Takes in one row.
exit_status_t angles_output_row(angles_output_t *output, const angles_row_t *row);

/// Writes what waits.
exit_status_t angles_output_end(angles_output_t *output);

/// Closes files; what was not written is lost.
void angles_output_close(angles_output_t *output);

#endif

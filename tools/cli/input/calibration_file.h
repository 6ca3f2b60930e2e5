/* SPDX-License-Identifier: MIT */
/// @file
/// The result of an earlier calibration, read back from a line of `--json` output.
///
/// Own reader instead of a JSON library: it reads only what this program writes, one flat object per line and five of its keys, and the
/// program then builds on bare machines without a further package. Anything else is an error.
#ifndef JCAL_CLI_INPUT_CALIBRATION_FILE_H
#define JCAL_CLI_INPUT_CALIBRATION_FILE_H

#include "jointcal/types.h"

#include <stdint.h>

typedef struct {
    bool ready;
    bool has_axes;
    bool has_carrying_angle;  ///< The key is there and its value is known.
    bool is_hinge;            ///< The line is of `jointcal hinge`.
    bool is_two_dof;          ///< The line is of `jointcal two-dof`.
    jcal_vec3_t axis1, axis2;
    float carrying_angle_rad;
} calibration_t;

/// Longest line in bytes, far longer than any that this program writes.
#define CALIBRATION_LINE_MAX 8192

/// Reads one line. Returns null, or what is wrong with it.
const char *calibration_parse(const char *line, calibration_t *calibration);

/// Reads a file and takes its last line that holds axes and is ready. False after a message to standard error.
bool calibration_load(const char *name, bool hinge, calibration_t *calibration);

/// Takes the axes of a hinge from a file, or leaves them if `name` is null. False after a message to standard error.
bool calibration_axes(const char *name, jcal_vec3_t *axis1, jcal_vec3_t *axis2);

#endif

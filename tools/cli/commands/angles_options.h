/* SPDX-License-Identifier: MIT */
/// @file
/// What the command line of `jointcal angles` can say.
#ifndef JCAL_CLI_COMMANDS_ANGLES_OPTIONS_H
#define JCAL_CLI_COMMANDS_ANGLES_OPTIONS_H

#include "options/common.h"
#include "output/angle_table.h"
#include "run/angle_source.h"

#include <stdbool.h>

/// What was given; all zero before.
typedef struct {
    bool has_joint, has_sequence;
    const char *calibration;  ///< File name, or null.
    angle_source_config_t source;
    angle_table_config_t table;
} angles_options_t;

/// For common_parse, with an angles_options_t.
extern const command_line_t ANGLES_LINE;

#endif

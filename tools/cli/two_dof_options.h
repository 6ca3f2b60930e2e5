/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal two-dof`.
#ifndef JCAL_CLI_TWO_DOF_OPTIONS_H
#define JCAL_CLI_TWO_DOF_OPTIONS_H

#include "jointcal/jointcal.h"

typedef struct {
    const char *recording;  ///< File name, "-" for standard input.
    bool json;
    int64_t every_us;  ///< 0 if not asked for.
    jcal_two_dof_config_t config;
} two_dof_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
two_dof_options_t two_dof_options(int argc, char **argv);

#endif

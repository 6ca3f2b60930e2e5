/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal two-dof`.
#ifndef JCAL_CLI_TWO_DOF_OPTIONS_H
#define JCAL_CLI_TWO_DOF_OPTIONS_H

#include "calibrate.h"
#include "two_dof_engine.h"

typedef struct {
    calibrate_options_t common;
    two_dof_engine_config_t engine;  ///< Valid for its engine.
} two_dof_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
two_dof_options_t two_dof_options(int argc, char **argv);

#endif

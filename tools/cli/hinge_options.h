/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal hinge`.
#ifndef JCAL_CLI_HINGE_OPTIONS_H
#define JCAL_CLI_HINGE_OPTIONS_H

#include "calibrate.h"
#include "engine.h"

typedef struct {
    calibrate_options_t common;
    engine_config_t engine;  ///< Valid for its engine.
} hinge_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
hinge_options_t hinge_options(int argc, char **argv);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal center`.
#ifndef JCAL_CLI_CENTER_OPTIONS_H
#define JCAL_CLI_CENTER_OPTIONS_H

#include "calibrate.h"
#include "center_engine.h"

typedef struct {
    calibrate_options_t common;
    center_engine_config_t engine;  ///< Valid for its engine, but for the axes of a hinge.
    const char *calibration;        ///< File with the axes of a hinge; null if not given.
} center_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
center_options_t center_options(int argc, char **argv);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal hinge`.
#ifndef JCAL_CLI_HINGE_OPTIONS_H
#define JCAL_CLI_HINGE_OPTIONS_H

#include "engine.h"

typedef struct {
    const char *recording;  ///< File name, "-" for standard input.
    bool json;
    int64_t every_us;        ///< 0 if not asked for.
    engine_config_t engine;  ///< Valid for its engine.
} hinge_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
hinge_options_t hinge_options(int argc, char **argv);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal chain`.
#ifndef JCAL_CLI_CHAIN_OPTIONS_H
#define JCAL_CLI_CHAIN_OPTIONS_H

#include "calibrate.h"
#include "jointcal/jointcal.h"

typedef struct {
    calibrate_options_t common;
    jcal_chain_config_t config;  ///< Valid, but for the axes of the knee.
    const char *calibration;     ///< File with the axes of the knee; null if not given.
} chain_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
chain_options_t chain_options(int argc, char **argv);

#endif

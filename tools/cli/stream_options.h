/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal stream`.
#ifndef JCAL_CLI_STREAM_OPTIONS_H
#define JCAL_CLI_STREAM_OPTIONS_H

#include "jointcal/jointcal.h"

typedef struct {
    const char *recording;  ///< File name, "-" for standard input.
    const char *target;     ///< Where the hub is.
    unsigned long baud;     ///< Of a serial line.
    float speed;            ///< Times real time; 0: as fast as the hub can.
    int64_t every_us;       ///< 0 if not asked for.
    int64_t timeout_us;     ///< How long the hub may be silent.
    bool counters;          ///< Tell the hub's counters at the end.
    float max_bound_rad;
    jcal_sign_hint_t sign_hint;
} stream_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
stream_options_t stream_options(int argc, char **argv);

#endif

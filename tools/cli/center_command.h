/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal center RECORDING.csv [options]`.
#ifndef JCAL_CLI_CENTER_COMMAND_H
#define JCAL_CLI_CENTER_COMMAND_H

/// Runs the subcommand; argv[0] is its name. Returns the exit status.
int center_command(int argc, char **argv);

#endif

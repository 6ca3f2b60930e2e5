/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal hinge RECORDING.csv [options]`.
#ifndef JCAL_CLI_HINGE_COMMAND_H
#define JCAL_CLI_HINGE_COMMAND_H

/// Runs the subcommand; argv[0] is its name. Returns the exit status.
int hinge_command(int argc, char **argv);

#endif

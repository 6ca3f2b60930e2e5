/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal angles`.
#ifndef JCAL_CLI_ANGLES_COMMAND_H
#define JCAL_CLI_ANGLES_COMMAND_H

/// Runs the subcommand; returns the exit status of the program.
int angles_command(int argc, char **argv);

#endif

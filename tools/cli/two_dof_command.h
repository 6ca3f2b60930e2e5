/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal two-dof RECORDING.csv [options]`.
#ifndef JCAL_CLI_TWO_DOF_COMMAND_H
#define JCAL_CLI_TWO_DOF_COMMAND_H

/// Runs the subcommand; argv[0] is its name. Returns the exit status.
int two_dof_command(int argc, char **argv);

#endif

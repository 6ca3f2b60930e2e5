/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal chain RECORDING.csv [options]`.
#ifndef JCAL_CLI_CHAIN_COMMAND_H
#define JCAL_CLI_CHAIN_COMMAND_H

/// Runs the subcommand; argv[0] is its name. Returns the exit status.
int chain_command(int argc, char **argv);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// `jointcal stream RECORDING.csv --to HUB [options]`.
#ifndef JCAL_CLI_STREAM_COMMAND_H
#define JCAL_CLI_STREAM_COMMAND_H

/// Runs the subcommand; argv[0] is its name. Returns the exit status.
int stream_command(int argc, char **argv);

#endif

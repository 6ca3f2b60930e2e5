/* SPDX-License-Identifier: MIT */
/// @file
/// The subcommands. Each runs with argv[0] as its name and returns the exit status.
#ifndef JCAL_CLI_COMMANDS_COMMANDS_H
#define JCAL_CLI_COMMANDS_COMMANDS_H

int angles_command(int argc, char **argv);
int ball_command(int argc, char **argv);
int center_command(int argc, char **argv);
int chain_command(int argc, char **argv);
int check_command(int argc, char **argv);
int hinge_command(int argc, char **argv);
int stream_command(int argc, char **argv);
int two_dof_command(int argc, char **argv);

#endif

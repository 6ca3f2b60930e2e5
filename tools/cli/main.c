/* SPDX-License-Identifier: MIT */
/* The program `jointcal`: picks the subcommand. */
#include "commands/commands.h"
#include "output/message.h"

#include "jointcal/jointcal.h"

#include <argp.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const char *name;
    int (*run)(int argc, char **argv);
} command_t;

static const command_t COMMANDS[] = {
    {"angles", angles_command}, {"ball", ball_command},   {"center", center_command}, {"chain", chain_command},
    {"check", check_command},   {"hinge", hinge_command}, {"stream", stream_command}, {"two-dof", two_dof_command}};

#define COMMAND_COUNT (sizeof COMMANDS / sizeof COMMANDS[0])

/* Where the subcommand stands. */
typedef struct {
    const command_t *command;
    int index;
} choice_t;

static void print_version(FILE *stream, struct argp_state *state)
{
    (void)state;
    (void)fprintf(stream, "jointcal %s\n", jcal_version());
}

static const command_t *find_command(const char *name)
{
    for (size_t k = 0; k < COMMAND_COUNT; k++) {
        if (strcmp(name, COMMANDS[k].name) == 0) {
            return &COMMANDS[k];
        }
    }
    return NULL;
}

/* Stops at the first argument that is no option: the rest belongs to the subcommand. */
static error_t parse(int key, char *argument, struct argp_state *state)
{
    choice_t *choice = state->input;
    if (key == 'h') {
        argp_state_help(state, stdout, ARGP_HELP_STD_HELP); /* ends the program */
    }
    if (key == ARGP_KEY_ARG) {
        choice->command = find_command(argument);
        choice->index = state->next - 1;
        if (choice->command == NULL) {
            argp_error(state,
                       "no subcommand '%s'; there is: angles, ball, center, chain, check, hinge, stream, two-dof",
                       argument);
        }
        state->next = state->argc;
        return 0;
    }
    if (key == ARGP_KEY_NO_ARGS) {
        argp_error(state, "which subcommand? There is: angles, ball, center, chain, check, hinge, stream, two-dof");
    }
    return ARGP_ERR_UNKNOWN;
}

static const struct argp_option OPTIONS[] = {{"h", 'h', NULL, OPTION_HIDDEN, "", 0}, {NULL, 0, NULL, 0, NULL, 0}};

static const struct argp PARSER = {
    .options = OPTIONS,
    .parser = parse,
    .args_doc =
        "angles RECORDING.csv --joint KIND [OPTION...]\nball RECORDING.csv [OPTION...]\ncenter RECORDING.csv [OPTION...]\nchain RECORDING.csv [OPTION...]\ncheck RECORDING.csv [OPTION...]\nhinge RECORDING.csv [OPTION...]\nstream RECORDING.csv --to HUB [OPTION...]\n"
        "two-dof RECORDING.csv [OPTION...]",
    .doc =
        "Finds out how the IMUs of a recording sit on the two sides of a joint.\v"
        "Subcommands:\n"
        "  angles   the angles of a joint, from these axes\n"
        "  ball     how both sensors of a person's hip or shoulder stand to each other, and the joint's centre\n"
        "  center   where both sensors sit relative to the centre of a joint\n"
        "  chain    the same for hip and knee together, three sensors\n"
        "  check    what the sensors do, and what is wrong with a recording as a whole\n"
        "  hinge    both axes of a joint with one axis, like a knee or a finger joint\n"
        "  stream   plays a recording to a hub and writes what the hub finds\n"
        "  two-dof  both axes of a joint with two axes, like elbow and forearm, and the heading offset\n"
        "\n"
        "'jointcal hinge --help' and so on tell all about them. angles, ball, center, hinge and two-dof also take two files, one of each "
        "sensor.",
};

int main(int argc, char **argv)
{
    argp_program_version_hook = print_version;
    argp_err_exit_status = EXIT_INPUT;
    /* A closed pipe shall be an error that we can report, not a silent end. */
    (void)signal(SIGPIPE, SIG_IGN);

    choice_t choice = {NULL, 0};
    (void)argp_parse(&PARSER, argc, argv, ARGP_IN_ORDER, NULL, &choice);
    if (choice.command == NULL) {
        return EXIT_INPUT;
    }
    /* argp shows argv[0] in its messages. */
    char full_name[32];
    (void)snprintf(full_name, sizeof full_name, "jointcal %s", choice.command->name);
    argv[choice.index] = full_name;
    return choice.command->run(argc - choice.index, argv + choice.index);
}

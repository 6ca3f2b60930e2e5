/* SPDX-License-Identifier: MIT */
/// @file
/// The one description of the options that commands share: recording, engine, n-max, window, every, max-bound, sign-hint,
/// axis1-toward, json, sort, lag.
///
/// A command says which of them it has and in what words, adds a table of its own options, and gets all of them parsed and checked as far
/// as that does not depend on its joint.
#ifndef JCAL_CLI_OPTIONS_COMMON_H
#define JCAL_CLI_OPTIONS_COMMON_H

#include "jointcal/hinge_config.h"
#include "jointcal/status.h"
#include "jointcal/types.h"

#include <argp.h>
#include <stdint.h>

/// First key for options of a command's own. None of them has a short form.
#define OPTION_OWN 256

/// What was given on the command line.
typedef struct {
    const char *recording;  ///< File name, "-" for standard input.
    const char *second;     ///< The file of sensor 2, if there are two; else null.
    bool has_lag;           ///< The lag of sensor 2's file is given ...
    int64_t lag_us;         ///< ... and is this.
    bool json;
    bool sort;         ///< Rows are to be put in the order of their times first.
    int64_t every_us;  ///< 0 if not asked for.
    jcal_engine_t engine;
    uint16_t n_max;   ///< 0 if not given.
    float window_s;   ///< 0 if not given.
    float max_bound;  ///< rad or m; 0 if not given. What is in force once `settle` of the command has run.
    jcal_sign_hint_t sign_hint;
    jcal_vec3_t axis1_toward;  ///< Unit vector in sensor frame 1; zero if not given.
} common_options_t;

/// The options that commands share.
typedef enum {
    COMMON_ENGINE,
    COMMON_N_MAX,
    COMMON_WINDOW,
    COMMON_EVERY,
    COMMON_MAX_BOUND,
    COMMON_SIGN_HINT,
    COMMON_AXIS1_TOWARD,
    COMMON_JSON,
    COMMON_SORT,
    COMMON_LAG,
    COMMON_COUNT
} common_option_t;

/// How a command has one of them. With neither text it does not know the option.
typedef struct {
    const char *help;     ///< For --help.
    const char *refusal;  ///< Why this command has no use for it; of an engine: why it has no window engine.
} common_offer_t;

/// Texts that are the same for all who have the option.
#define COMMON_EVERY_HELP "Report an estimate every S seconds of recording time"
#define COMMON_SORT_HELP "Put rows in the order of t_s first; all of them must fit into memory"
#define COMMON_LAG_HELP                                                                                                \
    "Of two files: the times of sensor 2 are S seconds later than those of sensor 1 at the same moment. Without it that is found"
#define COMMON_TWO_FILES                                                                                                                  \
    "Two files are one sensor's each, in the columns t_s, gyr_x, gyr_y, gyr_z, acc_x, acc_y, acc_z, with clocks and rates of their own, " \
    "25 to 400 rows a second. They need not have begun together, but then their times must be about the same; files with other times "    \
    "are taken to begin at once. What is left of a lag, up to 2 s, and of a drift, up to 500 ppm, is found from the motion and taken "    \
    "off; without it nothing is called ready, unless --lag gives it.\n\n"
#define COMMON_JSON_HELP "Write JSON Lines instead of text"
#define COMMON_SIGN_HELP                                                                                               \
    "What is known about the sign pairing. same: the largest components of both axes have the same sign; opposite: they have not"
#define COMMON_TOWARD_HELP                                                                                                               \
    "Axis 1 points about this way in the frame of sensor 1: chooses between an axis and its opposite, which are the same line. Without " \
    "it the largest component is positive, and that may be nearly a tie"
#define COMMON_EXIT_HELP                                                                                               \
    "Exit status: 0 ready at the end; 3 read to the end but not ready; 2 the command line or the recording is wrong; 1 anything else."
#define COMMON_N_MAX_REFUSAL "--n-max goes with --engine window only: the stream engine keeps no samples"

/// One picture of all joints; the same as in jointcal/types.h.
#define COMMON_PICTURE                                                                                                                   \
    "\n\n"                                                                                                                               \
    "   proximal segment (a thigh, say)           distal segment (a shank)\n"                                                            \
    "  -----------[ sensor 1 ]-----------( o )-----------[ sensor 2 ]----------\n"                                                       \
    "                   <------ r1 -------  ------- r2 ------->\n"                                                                       \
    "\n"                                                                                                                                 \
    "Each sensor may sit anywhere on its segment, turned in any way. o is the joint; r1 and r2 lead from it to the sensors, in m, each " \
    "in its sensor's frame. The joint's axes are unit vectors: axis 1 in the frame of sensor 1, axis 2 in that of sensor 2; a hinge "    \
    "has one axis, seen by both. Rates are in rad/s, accelerations in m/s^2: a sensor that lies still reads +9.81 on the axis that "     \
    "points up.\n"

/// Unit of --max-bound.
typedef enum { BOUND_IN_DEG, BOUND_IN_M } bound_unit_t;

/// A command's line.
typedef struct {
    const char *args_doc;  ///< As argp has it.
    const char *doc;
    bool two_files;  ///< It takes two files of one sensor each, too.
    common_offer_t offers[COMMON_COUNT];
    int n_max_least, n_max_most;  ///< For the message; the engine's config says what it takes.
    bound_unit_t bound_unit;
    const struct argp_option *own;  ///< Its own options, ended as argp has it; null if there are none.
    /// Takes one of its own options; 0, or ARGP_ERR_UNKNOWN. A wrong value ends the program.
    error_t (*parse)(int key, char *argument, struct argp_state *state, void *options);
    /// Takes the name of a file, the first one too; null: `recording` and `second` are all there are.
    void (*take_file)(struct argp_state *state, const char *name, void *options);
    /// All options are read: judges what goes together, fills in what was not given.
    void (*settle)(struct argp_state *state, common_options_t *common, void *options);
} command_line_t;

/// Reads the command line; ends the program itself for --help, --version and mistakes. `options` is the command's own.
void common_parse(const command_line_t *line, int argc, char **argv, common_options_t *common, void *options);

/// A field of a config and the option that sets it.
typedef struct {
    const char *field;
    const char *option;
    float value;        ///< As the user gave it.
    const char *range;  ///< "a number of seconds from 2 to 600".
} common_limit_t;

/// Ends the program with the option that set `field`, the field that a config check of the library complains of; null is none.
void common_check(struct argp_state *state, const char *field, const common_limit_t *limits, size_t count);

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// Command line of `jointcal angles`.
#ifndef JCAL_CLI_ANGLES_OPTIONS_H
#define JCAL_CLI_ANGLES_OPTIONS_H

#include "jointcal/jointcal.h"

/// Which pose has the reference angles.
typedef enum {
    ZERO_NONE,   ///< None: angles count from where the sensors' mounting happens to put zero.
    ZERO_FIRST,  ///< The first row with angles.
    ZERO_TIME,   ///< The first row with angles at or after a time.
    ZERO_RANGE   ///< The smallest flexion and the smallest pronation of the recording.
} zero_t;

typedef struct {
    const char *recording;    ///< File name, "-" for standard input.
    const char *out;          ///< File name, or null for standard output.
    const char *calibration;  ///< File name, or null.
    bool has_joint;
    bool hinge;  ///< Else two axes.
    bool sto;    ///< `out` is to be an OpenSim storage file.
    zero_t zero;
    int64_t zero_us;                ///< With ZERO_TIME, as in the recording.
    jcal_joint_angles_t reference;  ///< Angles of the reference pose, flexion and pronation positive.
    bool signs_by_range;
    jcal_positive_t positive;
    bool has_toward1, has_toward2;
    jcal_vec3_t toward1, toward2;
    float window_s;       ///< Memory of the heading; 0 for the default.
    float max_bound_rad;  ///< 0 for the default.
    jcal_sign_hint_t sign_hint;
} angles_options_t;

/// Reads and checks the command line; ends the program itself for --help, --version and mistakes.
angles_options_t angles_options(int argc, char **argv);

#endif

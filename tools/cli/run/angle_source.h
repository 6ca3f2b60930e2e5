/* SPDX-License-Identifier: MIT */
/// @file
/// Angles row by row: with a calibration that is given, or with the one that the rows so far make.
#ifndef JCAL_CLI_RUN_ANGLE_SOURCE_H
#define JCAL_CLI_RUN_ANGLE_SOURCE_H

#include "input/calibration_file.h"
#include "input/orientations.h"
#include "input/row_clock.h"
#include "output/angle_table.h"

#include "jointcal/jointcal.h"

typedef struct {
    bool hinge;     ///< Else two axes, or
    bool ball;      ///< none: angles from a pose, axis 1 stands for the person's right.
    bool shoulder;  ///< Of a ball joint: the shoulder's angles, else the hip's.
    bool has_pose_time;
    int64_t pose_us;  ///< Time of that pose, as in the recording; the first row whose heading is known, else.
    bool has_toward1, has_toward2;
    jcal_vec3_t toward1, toward2;  ///< Where the axes point about.
    bool accept_best;              ///< Take the best estimate, whatever its status.
    float window_s;                ///< Memory of the heading; 0 for the default.
    float max_bound_rad;           ///< 0 for the default.
    bool own_orientations;         ///< Rows come without: the hinge's own are taken.
    jcal_sign_hint_t sign_hint;
} angle_source_config_t;

/// What is known of the joint at a row.
typedef struct {
    bool known;
    jcal_vec3_t axis1, axis2;
    float carrying_rad;
    float bound_rad;
    float heading_rad; /* of the engine; a follower has its own */
} angle_joint_t;

/// How a joint moved over the last seconds.
typedef struct {
    float rate2;    /* both squared rates, (rad/s)^2 */
    float mean_rad; /* of the angle */
    float spread2;  /* its variance, rad^2 */
    uint64_t last_us;
    bool has_last, has_angle;
} angle_motion_t;

typedef struct {
    uint64_t rows;     ///< Rows with angles.
    jcal_head_t head;  ///< Of the calibration that the rows so far make.
    bool at_end;       ///< The last row whose orientations were of use had angles.

    /* Private. */
    bool given;    /* the calibration is; else the engines find it */
    bool has_pose; /* that `frames` of a ball joint are from */
    bool has_follower;
    float sign; /* of the axes that are written here against those of the engine */
    angle_source_config_t config;
    angle_motion_t motion;
    row_clock_t clock;
    jcal_orientation_gate_t gate;
    jcal_joint_heading_t follower;
    jcal_ball_pair_t ball;
    jcal_hinge_auto_t hinge;
    jcal_two_dof_auto_t two_dof;
    jcal_heading_t own_heading;
    jcal_gate_config_t gate_config;
    jcal_joint_frames_t frames;
    angle_joint_t joint;
} angle_source_t;

/// Prepares; `calibration` may be null. False if the library refuses the settings, which would be a mistake of this program.
bool angle_source_start(angle_source_t *source, const angle_source_config_t *config, const calibration_t *calibration);

/// Takes in a row and gives its angles, none if the recording as a whole is `refused`. False if the library refuses a call, which would be a mistake of this program.
bool angle_source_row(angle_source_t *source, const oriented_row_t *oriented, bool refused, angles_row_t *out);

#endif

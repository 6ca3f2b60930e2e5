/* SPDX-License-Identifier: MIT */
/// @file
/// State of the ball joint. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_BALL_STREAM_H
#define JCAL_PRIVATE_BALL_STREAM_H

#include "jointcal/ball_config.h"
#include "jointcal/private/levers/sums.h"
#include "jointcal/private/levers/ticks.h"
#include "jointcal/private/plane.h"
#include "jointcal/types.h"

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// All sums. Nothing but floats.
typedef struct {
    float motion_s;                           ///< W: seconds of motion.
    float along[9];                           ///< Rate of sensor 1 times rate of sensor 2, each in its frame.
    float energy1, energy2;                   ///< Squared rates, weighted alike.
    float block_motion_s[JCAL_LEVER_BLOCKS];  ///< 0 is open.
    float block_time_s;                       ///< Of the open block.
    jcal_lever_sums_t levers;
} jcal_ball_sums_t;

/// One solution.
typedef struct {
    jcal_vec3_t r1, r2;                       ///< Joint to sensor, each in its sensor frame, m.
    jcal_plane_t heading[JCAL_LEVER_BLOCKS];  ///< L2 to L1 about z, a unit complex number per block.
    float size;                               ///< Mean square of the residual, above its floor, (m/s)^2.
    float lack;                               ///< Sum of squares that is left, (m/s)^2 s.
    float speed2;                             ///< Mean square of both sides of the lever equation, (m/s)^2.
} jcal_ball_point_t;

/// The heading of the blocks that were merged, and its information, 1/rad^2; 0 before any was.
typedef struct {
    jcal_plane_t heading;
    float known;
} jcal_ball_past_t;

/// What has been found out about the estimate.
typedef struct {
    float factor[21];    ///< Of the information about both levers, on its way (6 x 6, packed Cholesky factor).
    float coupling[12];  ///< That information's inverse times its coupling to both headings (2 x 6).
    float open;          ///< What was added to it in all directions, so that one that nothing tells of spoils no other.
    float left[3];       ///< Information about both headings once the levers have taken their share (2 x 2, packed).
    float spread1_m, spread2_m;  ///< Half of the standard deviations of the levers, on their way.
    float bound1_m, bound2_m;    ///< 95 % bounds of the levers.
    float heading_rad;           ///< 95 % bound of the heading.
    float stiffness;             ///< What one fixed rotation between the rates leaves of the smaller one.
    uint8_t status, reason, weak, hint;
    uint8_t agreed;  ///< Judgements in a row in which nothing spoke against one joint.
    bool for_heading, for_center1, for_center2;
} jcal_ball_verdict_t;

/// The heading of this moment.
typedef struct {
    jcal_plane_t sum;      ///< What the last seconds say, fading.
    jcal_plane_t heading;  ///< L2 to L1.
    float age_s;           ///< Mean age of what it was learnt from, s.
    float recent;          ///< Squared residual of the last 1.5 s of motion beside its usual size.
    bool known;
} jcal_ball_track_t;

/// The ball joint. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_ball_config_t cfg;
    jcal_ball_sums_t sums;
    jcal_ball_past_t past;
    jcal_ball_point_t point;  ///< The estimate.
    jcal_ball_point_t trial;  ///< Another heading that is tried.
    jcal_ball_verdict_t verdict;
    jcal_ball_track_t track;
    jcal_tick_pair_t ticks;
    float motion_s;   ///< Motion since the beginning, s.
    float refused_s;  ///< Motion since a judgement last found no reason to doubt that it is one joint, s.
    float since_s;    ///< Time since the last judgement began, s.
    float credit;     ///< Slices that are paid for.
    uint8_t slice;    ///< Next slice of the judgement.
    uint8_t turn;     ///< Number of the heading that is tried.
    uint8_t tried;    ///< How many were, at most 255.
    bool has_estimate;
    bool merged;     ///< A block was merged: headings cannot be begun anew any more.
    bool was_ready;  ///< Since the sensors sit as they do.
    bool refused;    ///< What came before was no joint, and nothing has said otherwise since.
} jcal_ball_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_BALL_STREAM_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Whether rates and accelerations of one sensor are in one right-handed frame, and in one unit of angle.
///
/// While a sensor moves slowly, what it feels is gravity, which turns against the sensor as fast as the rates say:
/// d(acc)/dt = -w x acc. If the accelerations stand in other columns, or with other signs, acc = P a for one of the 48 signed
/// permutations P, and only with that one put right, and with the right unit of w, does the equation hold. It is linear in P but for a
/// term of second order, so a few sums over all blocks of a tenth of a second tell the residual of every candidate at the end. P and -P
/// cannot be told apart; rates that all have the wrong sign can.
///
/// The library's health.h names wrong frames too, but from windows of four seconds: a joint of two such sensors was ready before it did, and
/// this one knows after five seconds of slow motion, and the factor of any unit of the rates.
#ifndef JCAL_CLI_INPUT_CHECK_FRAMES_H
#define JCAL_CLI_INPUT_CHECK_FRAMES_H

#include "jointcal/vec3.h"

#include <stdbool.h>
#include <stdint.h>

/// Start from all zero.
typedef struct {
    uint32_t count;              /* of blocks */
    double change2;              /* sum of |da|^2 */
    double turn2_acc2;           /* sum of |th|^2 |a|^2 */
    double cross[3][3];          /* sum of th_i (a x da)_j */
    double products[3][3][3][3]; /* sum of th_i th_j a_k a_l */
} check_frames_t;

/// How the accelerations must be read, and what then fits.
typedef struct {
    uint32_t count;    ///< Blocks that tell.
    int column[3];     ///< Which of their columns is x, y, z ...
    int sign[3];       ///< ... and with which sign.
    double scale;      ///< How many times as fast as the rates gravity turns; negative: the other way round.
    double fit;        ///< Share of the changes that is explained, 0 to 1.
    double fit_as_is;  ///< The same for the columns as they stand; negative if gravity turns the other way round.
    double scale_as_is;
    double fit_next;  ///< The same for the second best way.
} check_frames_result_t;

/// Takes in a block: the turn by the rates over it, the acceleration in its middle and the change of it.
void check_frames_push(check_frames_t *frames, jcal_vec3_t turn_rad, jcal_vec3_t acc, jcal_vec3_t change);

/// False if there are too few blocks, or no motion.
bool check_frames_get(const check_frames_t *frames, check_frames_result_t *result);

#endif

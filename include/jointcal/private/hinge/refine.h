/* SPDX-License-Identifier: MIT */
/// @file
/// The refined axes and the sums that they rest on; lib/hinge/refine.h has the equations.
#ifndef JCAL_PRIVATE_HINGE_REFINE_H
#define JCAL_PRIVATE_HINGE_REFINE_H

#include "jointcal/private/hinge/block.h"
#include "jointcal/private/hinge/point.h"
#include "jointcal/private/hinge/slip.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How far the residual is one that a wrong scale or a lag of a sensor leaves; weighted like the cost.
typedef struct {
    float scale;   ///< Sum of half of |z1|^2 - |z2|^2: the residual along z.
    float lag;     ///< Sum of |z1| - |z2| times the rate at which |z2| changes ...
    float change;  ///< ... and of the square of that rate.
} jcal_hinge_alike_t;

/// The refined axes and the sums that they rest on.
typedef struct {
    jcal_hinge_point_t point;     ///< The axes.
    jcal_hinge_note_t anchor[2];  ///< Where they were when the sums began.
    float bias[4];                ///< Biases of the gyroscopes along u1, v1, u2, v2, in standard deviations.
    jcal_hinge_block_t block;
    jcal_hinge_view_t last1;  ///< The previous sample.
    jcal_hinge_view_t last2;
    jcal_plane_t phase;  ///< p exp(-i theta): turns z1 into z2.
    float phase_weight;  ///< How well it is known from earlier blocks; 0: not at all.
    float matrix[36];    ///< Packed 8 x 8, all blocks, phases eliminated.
    float gradient[8];   ///< Half the gradient at `point`.
    float gain[4][4];    ///< What a bias of one unit moves the tilts' gradient by, biases eliminated.
    float scatter[10];   ///< Sum of score score' over blocks, biases eliminated.
    float lean[4];       ///< Sum of the scores, each times its block's information.
    float information;   ///< Sum of the blocks' information, the trace of the tilts' part ...
    float information2;  ///< ... and of its squares.
    float told[2];       ///< The same for the tilts of each axis alone ...
    float told2[2];      ///< ... and of its squares.
    float cost;          ///< Sum of the squared residuals, in units of the assumed noise.
    float joint;         ///< Sum of the joint's own squared rate, in the units of the cost ...
    float along[2];      ///< ... of that along each axis ...
    float across;        ///< ... and of that across the axes, mean of both.
    jcal_hinge_alike_t alike;
    float blocks;       ///< How many blocks.
    float time_s;       ///< Time that they cover.
    float same;         ///< Residual of this sign pairing, as a share of what could match, integrated over time ...
    float other;        ///< ... of the other pairing ...
    float sign_time_s;  ///< ... and the time for which there was something to match.
    jcal_hinge_slip_t slip;
    bool has_last;
} jcal_hinge_refine_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_REFINE_H */

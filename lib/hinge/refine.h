/* SPDX-License-Identifier: MIT */
/// @file
/// The precise axes: the rate across the axis is one vector in space, and both sensors must see its length and its
/// direction alike. Private.
///
/// With z = (w - b) . u + i (w - b) . v (tangent directions u, v of a sensor's axis) and l = w . j,
///   r = p exp(-i theta) z_1 - z_2 = 0,   theta(t) = integral of l_2 - l_1:
/// the joint angle theta turns the one view into the other, and only its start, the phase p, is unknown. A tilt d of
/// axis i moves z_i by -l_i d, at once and to first order, and theta by the path of z_i: so the axes show even in motion
/// that is nothing but a turn about them, where (24) of [OLS20] is of fourth order. Blocks of a fraction of a second each
/// have a phase of their own, which is eliminated; then the integrals never run away. What is left is a linear
/// least-squares problem in tilts and biases, summed block by block, and the sums move along when the axes move.
/// Derivation: docs/METHOD.md section 4.
#ifndef JCAL_HINGE_REFINE_H
#define JCAL_HINGE_REFINE_H

#include "hinge/block.h"
#include "hinge/forget.h"
#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/coarse.h"
#include "jointcal/private/hinge/refine.h"

#include <stdbool.h>

/// Begins anew at a point.
void jcal_hinge_refine_restart(jcal_hinge_refine_t *self, const jcal_hinge_point_t *point);

/// Goes over to another estimate of the coarse search. Begins anew there, unless all that differs is an axis of which nothing is
/// known yet: the other one goes on.
void jcal_hinge_refine_go(jcal_hinge_refine_t *self, const jcal_hinge_point_t *point);

/// The samples that follow are not continuous with those before.
void jcal_hinge_refine_interrupt(jcal_hinge_refine_t *self);

/// Adds one sample to the refined axes; `coarse` has an estimate. Closes the block that the sample fills, and moves the axes with
/// it: then it returns true.
///
/// Cost:     about 250 multiply-adds; where a block ends, 1000 more.
bool jcal_hinge_refine_add(jcal_hinge_refine_t *self, const jcal_hinge_config_t *cfg, const jcal_hinge_coarse_t *coarse,
                           const jcal_hinge_sample_t *sample);

/// Effective number of blocks, each counted by its information; at most twice those since an axis began anew.
float jcal_hinge_refine_blocks(const jcal_hinge_refine_t *self);

/// Effective number of blocks that tell of one axis (0, 1), each counted by what it tells of it.
float jcal_hinge_refine_blocks_of(const jcal_hinge_refine_t *self, unsigned axis);

/// Power of the residual, in units of the assumed noise power per direction.
float jcal_hinge_refine_noise(const jcal_hinge_refine_t *self);

/// Information that stands for the minimum of the moments: what pulls the refined axes there.
float jcal_hinge_refine_pull(const jcal_hinge_refine_t *self);

#endif /* JCAL_HINGE_REFINE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds and status of the joint centre. Private.
///
/// With H the matrix of the sums, prior P included, and S the scatter of their gradient over blocks of time, the covariance of the
/// estimate is H^-1 (S + P) H^-1; never less than H^-1 with the residuals' own size. A 95 % radius in space comes from mean and
/// variance of the squared error: tr C + 2 sqrt(2 tr C^2), which is exact to 2 % from one to three equal directions. To it is
/// added, as squares, what could hide in what is left unexplained: errors of the model that move with the motion, like soft tissue,
/// shift the estimate by about their share of the effect that is seen.
#ifndef JCAL_CENTER_JUDGE_H
#define JCAL_CENTER_JUDGE_H

#include "jointcal/center_config.h"
#include "jointcal/head.h"
#include "jointcal/private/center/judge.h"

/// Slices of the work: the sums' matrix, its factor, three pairs of columns of the inverse, six rows of two covariances, doubts, two
/// bounds, the verdict.
#define JCAL_CENTER_JUDGE_SLICES 15u
#define JCAL_CENTER_SLICE_SCALE 0u
#define JCAL_CENTER_SLICE_FACTOR 1u

/// Does slice `slice` of the work on bounds and status. The factor may fail: then the slices after it have nothing to do.
///
/// Cost: at most about 400 multiply-adds.
bool jcal_center_judge(const jcal_center_config_t *cfg, jcal_center_work_t *self, unsigned slice);

/// 95 % radius of a Gaussian in space with covariance c (3 x 3, packed; lost), the part along a unit vector left out if it is not zero.
float jcal_center_radius_across(float *c, jcal_vec3_t axis);

/// Finds the Gauss-Newton step of the estimate, `step` of the inverse, from the factor.
void jcal_center_solve(const jcal_center_config_t *cfg, jcal_center_work_t *self);

/// Bounds and status before there is an estimate.
void jcal_center_verdict_begin(jcal_center_verdict_t *verdict, jcal_calibration_t status);

#endif /* JCAL_CENTER_JUDGE_H */

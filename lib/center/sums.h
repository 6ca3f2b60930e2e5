/* SPDX-License-Identifier: MIT */
/// @file
/// Sums of the joint centre's residual at the estimate, biases included. Private.
///
/// Rows are linearised where the estimate is when their sample comes in: with the estimate within centimetres of the truth the row
/// changes by a few percent. Matrix, gradient, cost and the scatter of the gradient over blocks of time move with the estimate by
/// the quadratic model. Biases have a Gaussian prior, positions one of 0.3 m, so that the matrix always has an inverse.
#ifndef JCAL_CENTER_SUMS_H
#define JCAL_CENTER_SUMS_H

#include "center/model.h"
#include "jointcal/center_config.h"
#include "jointcal/private/center/sums.h"

/// Residuals of this time are taken to agree by chance, s: one reading. 0.1, or half of what is smoothed over.
float jcal_center_reading_s(const jcal_center_config_t *cfg);

/// Length of a block, s.
#define JCAL_CENTER_BLOCK_S 0.5f

/// Begins at a place; biases unknown, zero.
void jcal_center_sums_begin(jcal_center_sums_t *self, const jcal_center_place_t *place);

/// The same with orientations and a heading offset, of any length but zero.
void jcal_center_sums_begin_oriented(jcal_center_sums_t *self, const jcal_center_place_t *place, jcal_plane_t heading);

/// Variance that the config calls usual for a residual, (m/s^2)^2.
float jcal_center_variance(const jcal_center_config_t *cfg, const jcal_center_residual_t *residual);

/// Takes in all residuals of a sample at the estimate. Returns the mean of their squares over what the config calls usual, none more
/// than `most`; negative if the sample has no direction and was left out.
float jcal_center_sums_take(jcal_center_sums_t *self, const jcal_center_config_t *cfg, const jcal_kinematic_t *sample,
                            float most);

/// Takes in one residual, which stands for dt_s ...
void jcal_center_sums_add(jcal_center_sums_t *self, const jcal_center_config_t *cfg,
                          const jcal_center_residual_t *residual, float dt_s);

/// ... and the time that passed with the sample.
void jcal_center_sums_advance(jcal_center_sums_t *self, const jcal_kinematic_t *sample);

/// Closes the block if it is long enough, which is to be done before the next sample; true if it was.
bool jcal_center_sums_close(jcal_center_sums_t *self);

/// Residuals, squared, over what the config calls usual; at least 1: readings that are so much worse count so much less.
float jcal_center_excess(const jcal_center_sums_t *self);

/// The prior's information on each unknown (12), 1 / variance, in units of the sums: times the excess, as the sums know nothing of it.
/// Of the heading nothing is known beforehand.
void jcal_center_prior(const jcal_center_sums_t *self, const jcal_center_config_t *cfg, float *prior);

/// Half the gradient at the estimate, prior included (12).
void jcal_center_sums_gradient(const jcal_center_sums_t *self, const float *prior, float *gradient);

/// Moves the estimate by d (12) and all sums with it.
void jcal_center_sums_move(jcal_center_sums_t *self, const float *d);

/// Halves what the sums weigh.
void jcal_center_sums_halve(jcal_center_sums_t *self);

#endif /* JCAL_CENTER_SUMS_H */

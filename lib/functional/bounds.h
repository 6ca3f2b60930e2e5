/* SPDX-License-Identifier: MIT */
/// @file
/// Bounds of the axes: what the sums know of them once headings and relative turns have taken their share. Private.
#ifndef JCAL_FUNCTIONAL_BOUNDS_H
#define JCAL_FUNCTIONAL_BOUNDS_H

#include "jointcal/private/functional/stream.h"

#include <stddef.h>

/// Slices: one begins, one for each block, one ends.
#define JCAL_FUNCTIONAL_BOUND_SLICES (2u + JCAL_FUNCTIONAL_BLOCKS)

/// Slice `part`; the first one also describes the joint (describe.h), the last one sets bound1_rad and bound2_rad of the verdict and moves
/// the axes to the minimum. Cost: at most 850 multiply-adds.
void jcal_functional_bound(jcal_functional_t *self, unsigned part);

/// out (4 x 3): derivative of block b's turn slope by the tangents of both axes; the third column is that of its heading, which all
/// residuals share. Cost: 500 multiply-adds.
void jcal_functional_bound_coupling(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                    float *out);

/// First (3) and second (3 x 3, packed) derivative of the cost by block b's turn, its heading going along about z. Cost: 260
/// multiply-adds.
void jcal_functional_bound_turn(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                float *slope, float *hessian);

#endif /* JCAL_FUNCTIONAL_BOUNDS_H */

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

/// out (3 x 3, packed): second derivative of the cost by block b's turn, with the heading in its place about z. Cost: 350 multiply-adds.
void jcal_functional_bound_nuisance(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                    float *out);

/// out (3) <- first derivative of the cost by the same turn. Cost: 350 multiply-adds.
void jcal_functional_bound_slope(const jcal_functional_sums_t *sums, const jcal_functional_point_t *point, size_t b,
                                 float *out);

#endif /* JCAL_FUNCTIONAL_BOUNDS_H */

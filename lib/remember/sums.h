/* SPDX-License-Identifier: MIT */
/// @file
/// What ticks say about axes and levers that are given: sums of one block, and what is read from them. Private.
///
/// With E_i = [u_i v_i j_i] and the features of tick.h (R turn, Q rate, U velocity, B lever), d the heading,
///
///     turn    R1 j1 - Rz(d) R2 j2,   rate    Q1 j1 - Rz(d) Q2 j2,   lever   (U1 - B1 r1) - Rz(d) (U2 - B2 r2)
///
/// [METHOD_PEOPLE.md, section 2]. A tilt t of axis i moves j_i by t_u u_i + t_v v_i, so that all of cost, gradient and second
/// derivative by four tilts and the heading is made of products of columns of R1 E1 with Rz R2 E2, and of Q likewise:
/// docs/METHOD_HUB.md, section 4.
#ifndef JCAL_REMEMBER_SUMS_H
#define JCAL_REMEMBER_SUMS_H

#include "jointcal/private/remember/state.h"
#include "jointcal/tick.h"
#include "levers/ticks.h"

#define JCAL_REMEMBER_TURN 0u
#define JCAL_REMEMBER_RATE 1u
#define JCAL_REMEMBER_LEVER 2u

/// Unknowns: two tilts of axis 1, of axis 2, heading.
#define JCAL_REMEMBER_UNKNOWNS 5u

/// Matrix and half the gradient of the tilts at one heading, which is eliminated.
typedef struct {
    float matrix[15];
    float gradient[JCAL_REMEMBER_UNKNOWNS];
} jcal_remember_system_t;

/// Adds a pair of ticks. Cost: 320 multiply-adds.
void jcal_remember_sums_add(jcal_remember_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                            const jcal_tick_weights_t *weights);

/// Sums of squares of the three kinds at a heading; `pairing` -1: of (j1, -j2). Cost: 30 multiply-adds.
void jcal_remember_costs(const jcal_remember_sums_t *sums, jcal_plane_t heading, float pairing,
                         float cost[JCAL_REMEMBER_KINDS]);

/// Sum of exp(i angle of bending), the angle from some zero; shorter where the axes do not agree. Cost: 16 multiply-adds.
jcal_plane_t jcal_remember_bend(const jcal_remember_sums_t *sums, jcal_plane_t heading);

/// First and second derivative of half the cost, kinds weighed by `weight`, by the heading.
void jcal_remember_slope(const jcal_remember_sums_t *sums, jcal_plane_t heading,
                         const float weight[JCAL_REMEMBER_KINDS], float slope[2]);

/// The system of the tilts (4 x 4 and 4 of it count) with the heading eliminated. Cost: 150 multiply-adds.
void jcal_remember_system(const jcal_remember_sums_t *sums, jcal_plane_t heading,
                          const float weight[JCAL_REMEMBER_KINDS], jcal_remember_system_t *out);

#endif /* JCAL_REMEMBER_SUMS_H */

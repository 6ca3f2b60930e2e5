/* SPDX-License-Identifier: MIT */
/// @file
/// Where the joint's centre is, as both sensors see it: the lever residual [U1 B1][1; -r1] - Rz(heading) [U2 B2][1; -r2]. Private.
///
/// Its sum of squares is x1' S1 x1 + x2' S2 x2 - 2 x1' X x2 with x = [1; -r]; only X depends on the headings, so that S is summed once
/// and what X is made of in blocks. For given headings the levers are a linear problem of six unknowns.
/// Source: docs/METHOD_PEOPLE.md, sections 2 to 4.
#ifndef JCAL_LEVERS_LEVERS_H
#define JCAL_LEVERS_LEVERS_H

#include "jointcal/private/levers/sums.h"
#include "jointcal/private/plane.h"
#include "jointcal/tick.h"

#include <stdbool.h>
#include <stddef.h>

/// Unknowns: r1, then r2.
#define JCAL_LEVER_UNKNOWNS 6u

/// Both levers, and what they leave.
typedef struct {
    jcal_vec3_t r1, r2;  ///< Joint to sensor, each in its sensor frame, m.
    float lack;          ///< Sum of squares that is left, (m/s)^2 s.
    float own;           ///< Sum of squares of both sides, (m/s)^2 s.
} jcal_levers_t;

/// Adds a tick of both sensors, of the same time. Cost: 120 multiply-adds.
void jcal_levers_add(jcal_lever_sums_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float weight);

/// Closes the open block and begins another; the block before is merged with `heading`.
void jcal_levers_close(jcal_lever_sums_t *self, jcal_plane_t heading);

/// x (4 x 4) <- X with a heading for each block.
void jcal_levers_cross(const jcal_lever_sums_t *self, const jcal_plane_t *heading, float *x);

/// H (6 x 6, packed) and g of the normal equations H r = g.
void jcal_levers_normal(const jcal_lever_sums_t *self, const float *x, float *h, float *g);

/// The levers that leave least, with X (4 x 4). A ridge, a share `ridge` of the mean diagonal, keeps directions in which nothing turned at
/// zero; zero if the equations have no solution. Cost: about 250 multiply-adds.
jcal_levers_t jcal_levers_solve(const jcal_lever_sums_t *self, const float *x, float ridge);

/// The pull of block `b` on its heading: its share of half the sum of squares is -Re(heading pull).
jcal_plane_t jcal_levers_pull(const jcal_lever_sums_t *self, size_t b, jcal_vec3_t r1, jcal_vec3_t r2);

/// Velocity of the joint's centre as a sensor sees it: [U B][1; -r], m/s, in its level frame.
jcal_vec3_t jcal_levers_velocity(const jcal_tick_t *tick, jcal_vec3_t r);

#endif /* JCAL_LEVERS_LEVERS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Where the full solves of the window engine of the hinge stand, and what they ended in.
#ifndef JCAL_PRIVATE_HINGE_WINDOW_SEARCH_H
#define JCAL_PRIVATE_HINGE_WINDOW_SEARCH_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Both axes. j[0] in sensor frame 1, j[1] in sensor frame 2; unit.
typedef struct {
    jcal_vec3_t j[2];
} jcal_hinge_axes_t;

/// A full solve on its way.
typedef struct {
    uint8_t phase;       ///< See lib/hinge/window_solve.c.
    uint8_t iterations;  ///< Done in this phase.
    float damping;
    uint32_t random;          ///< State of the generator of starts.
    jcal_hinge_axes_t at;     ///< The estimate of this phase.
    jcal_hinge_axes_t first;  ///< The result from the start, before its other pairing was tried.
} jcal_hinge_solve_t;

/// Algorithm 4.
typedef struct {
    jcal_hinge_axes_t previous;  ///< The last estimate, with the sign of (66).
    bool has_previous;
    bool accepted;
    uint16_t agreeing;   ///< Consecutive estimates with SEQAD below E_max; stops at n_min.
    float seqad_rad;     ///< (67) of the last estimate.
    float local_rad[2];  ///< mu + 2 sigma of the last estimate; pi/2 if unknown.
} jcal_hinge_accept_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_WINDOW_SEARCH_H */

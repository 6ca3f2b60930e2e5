/* SPDX-License-Identifier: MIT */
/// @file
/// Solving of the window engine: the estimate that is followed, and full solves in slices.
#ifndef JCAL_HINGE_WINDOW_SOLVE_H
#define JCAL_HINGE_WINDOW_SOLVE_H

#include "hinge/window_cost.h"
#include "jointcal/private/hinge/window.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Fewest gyroscope rows for which a full solve begins.
#define JCAL_HINGE_WINDOW_ROWS_MIN 4u

/// Forgets estimates and restarts the generator from the seed.
void jcal_hinge_window_solve_reset(jcal_hinge_window_t *self);

/// One step of the estimate that is followed; nothing before the first full solve.
void jcal_hinge_window_follow(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows);

/// Begins a full solve from a random start. False if one is on its way or there are too few rows.
bool jcal_hinge_window_solve_begin(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows);

/// One slice of the full solve that is on its way, if any: an iteration or a comparison.
void jcal_hinge_window_solve_slice(jcal_hinge_window_t *self, const jcal_hinge_rows_t *rows);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_WINDOW_SOLVE_H */

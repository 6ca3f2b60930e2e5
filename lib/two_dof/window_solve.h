/* SPDX-License-Identifier: MIT */
/// @file
/// Steps, search and judgement of the 2-DoF window engine. Private.
#ifndef JCAL_TWO_DOF_WINDOW_SOLVE_H
#define JCAL_TWO_DOF_WINDOW_SOLVE_H

#include "jointcal/private/two_dof/verdict.h"
#include "jointcal/private/two_dof/window_search.h"
#include "two_dof/window_cost.h"

/// What follows a kept sample, at most three passes over the rows; `newest` is the last row.
void jcal_two_dof_window_work(jcal_two_dof_window_search_t *search, jcal_two_dof_verdict_t *verdict,
                              const jcal_two_dof_rows_t *rows, const jcal_two_dof_row_t *newest);

#endif /* JCAL_TWO_DOF_WINDOW_SOLVE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Algorithm 4 of [OLS20]: is an estimate of acceptable uncertainty, by the paper's own criteria?
#ifndef JCAL_HINGE_ACCEPT_H
#define JCAL_HINGE_ACCEPT_H

#include "hinge/window_cost.h"
#include "jointcal/hinge_config.h"
#include "jointcal/private/hinge/window_search.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Local uncertainty (57)-(65): mu + 2 sigma of both axes, rad, in closed form; pi/2 where it is unknown.
///
/// Unknown: fewer than two samples of a kind, residuals without scatter, or a direction that is open.
void jcal_hinge_local_uncertainty(const jcal_hinge_sums_t *sums, float local_rad[2]);

/// Takes in the estimate of a full solve: its SEQAD (66), (67), its local uncertainty, and the verdict (68).
///
/// Inputs:   sums  at `axes`.
void jcal_hinge_accept_update(jcal_hinge_accept_t *self, const jcal_hinge_window_config_t *cfg,
                              const jcal_hinge_axes_t *axes, const jcal_hinge_sums_t *sums);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_HINGE_ACCEPT_H */

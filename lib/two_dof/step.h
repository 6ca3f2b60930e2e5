/* SPDX-License-Identifier: MIT */
/// @file
/// Steps of a search from several starts, and when a probe ends: what both engines of the 2-DoF joint share. Private.
#ifndef JCAL_TWO_DOF_STEP_H
#define JCAL_TWO_DOF_STEP_H

#include "jointcal/private/two_dof/point.h"
#include "math/solve.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A probe ends after so many steps, or when a step is shorter than this, rad.
#define JCAL_TWO_DOF_PROBE_STEPS 14u
#define JCAL_TWO_DOF_STEP_MIN_RAD 3e-3f
/// Longest step, rad: the model is worth nothing further away.
#define JCAL_TWO_DOF_STEP_MAX_RAD 0.5f

/// After so many steps a probe is given up, if several times the gain that it promises would leave it this far above the estimate.
#define JCAL_TWO_DOF_HOPELESS_STEPS 3u
#define JCAL_TWO_DOF_HOPE 4.0f
#define JCAL_TWO_DOF_HOPELESS_GAP 100.0f

/// A step that makes the cost larger by less than this share of it stands: samples that came in meanwhile did it.
#define JCAL_TWO_DOF_HARMLESS_SHARE 0.02f
/// Another minimum must be better than the estimate by this much, in units of the cost's standard deviation.
#define JCAL_TWO_DOF_BETTER 1.0f

/// Moves a point by one damped step of at most JCAL_TWO_DOF_STEP_MAX_RAD.
///
/// Inputs:   model  around `point`; its first five unknowns are those of jcal_two_dof_point_move.
/// Outputs:  d (model->n), the step; predicted, the change of cost that the model promises for it. Both zero if there is none with
///           this damping, which was raised then, and the point stays.
/// Returns:  the length of the step before it was shortened, rad; JCAL_TWO_DOF_STEP_MAX_RAD if there is none.
float jcal_two_dof_make_step(jcal_gn_t *gn, const jcal_gn_model_t *model, jcal_two_dof_point_t *point, float *d,
                             float *predicted);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_TWO_DOF_STEP_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Orientations from push to step, thinned out, and the rates of the one in the middle of the last three. Private.
#ifndef JCAL_TWO_DOF_KEPT_H
#define JCAL_TWO_DOF_KEPT_H

#include "jointcal/orientation.h"
#include "jointcal/private/two_dof/kept.h"
#include "jointcal/status.h"

/// Push: checks an orientation and keeps it if it comes at least `apart_us` after the last one kept.
///
/// Returns:  JCAL_OK; JCAL_REJECTED; JCAL_ERR_FULL.
jcal_status_t jcal_two_dof_keep(jcal_two_dof_kept_t *self, jcal_orientation_gate_t *gate, const jcal_gate_config_t *cfg,
                                const jcal_orientation_pair_t *pair, uint32_t apart_us);

/// Step: takes the oldest that waits; `pushes` samples were pushed for it. False if there is none.
bool jcal_two_dof_take(jcal_two_dof_kept_t *self, unsigned *pushes);

/// The orientation in the middle of the last three taken, with its rates in the earth frames.
typedef struct {
    const jcal_orientation_pair_t *at;
    jcal_vec3_t w1, w2;  ///< rad/s, in E1 and in E2.
    float dt_s;          ///< The time it stands for.
} jcal_two_dof_middle_t;

/// Step: false if there are no three that are near to each other in time.
bool jcal_two_dof_middle(const jcal_two_dof_kept_t *self, jcal_two_dof_middle_t *out);

#endif /* JCAL_TWO_DOF_KEPT_H */

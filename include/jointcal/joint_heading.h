/* SPDX-License-Identifier: MIT */
/// @file
/// Heading offset of two orientations whose joint axes are known: followed over time, because magnetometer-free headings drift.
///
/// The heading offset delta turns earth frame E2 to E1 about z: v_E1 = Rz(delta) v_E2 [LAI22, eq. (6)]. A hinge tells it at each
/// instant unless its axis is vertical; a joint with two axes tells it over a few postures.
#ifndef JCAL_JOINT_HEADING_H
#define JCAL_JOINT_HEADING_H

#include "jointcal/orientation.h"
#include "jointcal/private/heading.h"
#include "jointcal/status.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Follows a hinge: both axes are the same line, j1 = Rz(delta) j2 in earth frame 1.
///
/// Inputs:   axis1, axis2  with the right sign pairing, any length; memory_s  time constant of the smoothing, 0 for none, at most 600.
/// Errors:   JCAL_ERR_ARG (null, an axis without direction, memory outside its range); self untouched.
/// Source:   axis equality as in Laidig, Schauer, Seel, ICORR 2017. Differs from it in: weighted by how horizontal the axes are.
/// Threads:  one task.
JCAL_MUST_CHECK jcal_status_t jcal_joint_heading_hinge(jcal_joint_heading_t *self, jcal_vec3_t axis1, jcal_vec3_t axis2,
                                                       float memory_s);

/// Follows a joint with two axes whose carrying angle is known: j1 . Rz(delta) j2 = sin(carrying) in earth frame 1.
///
/// Inputs:   axis1, axis2  any length; carrying_rad  as in jcal_two_dof_result_t; memory_s  time constant, 1 to 600.
/// Errors:   JCAL_ERR_ARG as above, or a carrying angle outside [-1.5, 1.5].
/// Source:   [LAI22] eq. (13), (18), with the axes and beta0 fixed and the sine instead of the angle.
/// Threads:  one task.
JCAL_MUST_CHECK jcal_status_t jcal_joint_heading_two_dof(jcal_joint_heading_t *self, jcal_vec3_t axis1,
                                                         jcal_vec3_t axis2, float carrying_rad, float memory_s);

/// Other axes, and another carrying angle unless it is a hinge, from a calibration that gets better; what was summed stays.
///
/// Errors:   JCAL_ERR_ARG as above; self untouched.
/// Threads:  one task.
JCAL_MUST_CHECK jcal_status_t jcal_joint_heading_improve(jcal_joint_heading_t *self, jcal_vec3_t axis1,
                                                         jcal_vec3_t axis2, float carrying_rad);

/// Takes in one pair and solves. A pair is left out if a quaternion is not finite or its length differs from 1 by more than 0.05, or
/// if its time does not increase.
///
/// Returns:  JCAL_OK; JCAL_REJECTED; JCAL_ERR_ARG (null).
/// Cost:     constant: about 100 operations for a hinge, 1,000 for two axes.
/// Threads:  one task.
jcal_status_t jcal_joint_heading_push(jcal_joint_heading_t *self, const jcal_orientation_pair_t *pair);

/// The heading offset now. Errors: JCAL_ERR_ARG.
/// Threads:  one task.
jcal_status_t jcal_joint_heading_get(const jcal_joint_heading_t *self, jcal_heading_t *out);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_JOINT_HEADING_H */

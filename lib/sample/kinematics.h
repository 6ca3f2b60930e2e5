/* SPDX-License-Identifier: MIT */
/// @file
/// Rates and specific forces into what a point of a rigid body feels: a = a_0 + K(w, dw) r, (3) and (4) of [OLS17]. Private.
///
/// K(w, dw) r = dw x r + w x (w x r). Faster samples are averaged in bins of about 20 ms first. With JCAL_DERIVATIVE_SMOOTHED the
/// specific force and K are each smoothed by (1, 2, 1)/4 over three bins: both sides of the equation alike, so that the noise of a
/// derivative falls and no lag between the sides arises. Before that, those of the neighbours are turned into the sensor frame of the
/// middle: what both sensors share, the acceleration of the joint, is then smoothed alike in both.
#ifndef JCAL_KINEMATICS_PRIVATE_H
#define JCAL_KINEMATICS_PRIVATE_H

#include "jointcal/kinematics.h"
#include "jointcal/quat.h"
#include "jointcal/vec3.h"

/// Forgets all samples.
void jcal_kinematics_begin(jcal_kinematics_t *self);

/// Takes in the next sample. True if that completed a bin and there is an `out`, three bins ago.
///
/// A distance of samples that differs by more than half from the one before begins a new chain of bins.
/// `attitudes` may be null; with them a and the columns of K are turned to each sensor's earth frame, while r, to which K is applied,
/// stays in the sensor's frame.
bool jcal_kinematics_put(jcal_kinematics_t *self, jcal_derivative_t derivative, const jcal_pair_t *pair,
                         const jcal_attitudes_t *attitudes, jcal_kinematic_t *out);

/// K r of a body.
static inline jcal_vec3_t jcal_body_times(const jcal_body_t *body, jcal_vec3_t r)
{
    const jcal_vec3_t xy = jcal_vec3_add(jcal_vec3_scale(body->k[0], r.x), jcal_vec3_scale(body->k[1], r.y));
    return jcal_vec3_add(xy, jcal_vec3_scale(body->k[2], r.z));
}

#endif /* JCAL_KINEMATICS_PRIVATE_H */

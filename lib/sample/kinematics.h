/* SPDX-License-Identifier: MIT */
/// @file
/// Rates and specific forces into what a point of a rigid body feels: a = a_0 + K(w, dw) r, (3) and (4) of [OLS17]. Private.
///
/// K(w, dw) r = dw x r + w x (w x r). Faster samples are averaged in bins of about 20 ms first.
///
/// Smoothing: specific force and K are turned to a frame that does not turn with the sensor, by integrating its rate, or to the earth
/// frame, and there averaged over four blocks with weights (1, 3, 3, 1)/8. The equation is linear in both, and so holds for the means
/// as it does for each; what both sensors share, the force at the joint, is smoothed alike in both. Frames that do not turn differ by a
/// fixed rotation: lengths agree, and vectors once both are in an earth frame.
#ifndef JCAL_KINEMATICS_PRIVATE_H
#define JCAL_KINEMATICS_PRIVATE_H

#include "jointcal/kinematics.h"
#include "jointcal/private/kinematics.h"
#include "jointcal/quat.h"
#include "jointcal/vec3.h"

/// Forgets all samples.
void jcal_kinematics_begin(jcal_kinematics_t *self);

/// Takes in the next sample. True if there is an `out`: of the third last bin, or of the last four blocks.
///
/// A distance of samples that differs by more than half from the one before begins a new chain of bins; blocks go on over a short hole:
/// the same bins are then missing on both sides of the equation.
/// `attitudes` may be null; with them `out` is in both sensors' earth frames.
bool jcal_kinematics_put(jcal_kinematics_t *self, const jcal_kinematics_config_t *cfg, const jcal_pair_t *pair,
                         const jcal_attitudes_t *attitudes, jcal_kinematic_t *out);

/// The bias of a body's accelerometer, b in its sensor's frame, in the body's frame.
static inline jcal_vec3_t jcal_segment_turn(const jcal_segment_t *body, jcal_vec3_t b)
{
    const jcal_vec3_t xy = jcal_vec3_add(jcal_vec3_scale(body->turn[0], b.x), jcal_vec3_scale(body->turn[1], b.y));
    return jcal_vec3_add(xy, jcal_vec3_scale(body->turn[2], b.z));
}

/// K r of a body.
static inline jcal_vec3_t jcal_segment_times(const jcal_segment_t *body, jcal_vec3_t r)
{
    const jcal_vec3_t xy = jcal_vec3_add(jcal_vec3_scale(body->k[0], r.x), jcal_vec3_scale(body->k[1], r.y));
    return jcal_vec3_add(xy, jcal_vec3_scale(body->k[2], r.z));
}

#endif /* JCAL_KINEMATICS_PRIVATE_H */

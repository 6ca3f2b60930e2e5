/* SPDX-License-Identifier: MIT */
/// @file
/// Rates and specific forces into what a point of a rigid body feels: a = a_0 + K(w, dw) r, (3) and (4) of [OLS17]. Private.
///
/// K(w, dw) r = dw x r + w x (w x r). Faster samples are averaged in bins of about 20 ms first. With JCAL_DERIVATIVE_SMOOTHED the
/// specific force, w w' and dw are each smoothed by (1, 2, 1)/4 over three bins: both sides of the equation alike, so that the
/// noise of a derivative falls and no lag between the sides arises. Before that, the specific forces of the neighbours are turned
/// into the sensor frame of the middle: what both sensors share, the acceleration of the joint, is then smoothed alike in both.
#ifndef JCAL_KINEMATICS_PRIVATE_H
#define JCAL_KINEMATICS_PRIVATE_H

#include "jointcal/kinematics.h"
#include "jointcal/vec3.h"

/// One body at one time.
typedef struct {
    jcal_vec3_t a;   ///< Specific force of the sensor, m/s^2.
    jcal_vec3_t dw;  ///< Angular acceleration, rad/s^2.
    float ww[6];     ///< w w', packed as in sym.h: xx, xy, yy, xz, yz, zz.
} jcal_body_t;

/// Both bodies at one time.
typedef struct {
    jcal_body_t body1, body2;
    uint64_t t_us;
    float dt_s;  ///< The time it stands for.
} jcal_kinematic_t;

/// Forgets all samples.
void jcal_kinematics_begin(jcal_kinematics_t *self);

/// Takes in the next sample. True if that completed a bin and there is an `out`, three bins ago (or fewer, by the derivative).
///
/// A distance of samples that differs by more than half from the one before begins a new chain of bins.
bool jcal_kinematics_put(jcal_kinematics_t *self, jcal_derivative_t derivative, const jcal_pair_t *pair,
                         jcal_kinematic_t *out);

/// |w|^2 of a body.
static inline float jcal_body_rate2(const jcal_body_t *body)
{
    return body->ww[0] + body->ww[2] + body->ww[5];
}

/// K r of a body: dw x r + (w w' - w'w I) r.
jcal_vec3_t jcal_body_times(const jcal_body_t *body, jcal_vec3_t r);

/// The columns of K, (3).
void jcal_body_matrix(const jcal_body_t *body, jcal_vec3_t *columns);

#endif /* JCAL_KINEMATICS_PRIVATE_H */

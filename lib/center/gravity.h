/* SPDX-License-Identifier: MIT */
/// @file
/// What both specific forces say of gravity and of each other, whatever the joint. Private.
///
/// Lengths at the joint's centre agree too if both accelerometers are scaled alike, or if one of them has the wrong sign: r comes out
/// scaled, or turned round. So two things are held against the readings themselves:
///
/// Gravity: in a frame that does not turn, the mean of the specific force over some seconds is gravity, up to the change of the velocity
/// in it. Its length must be 9.81 m/s^2 within 6 %.
///
/// Sides: with u_i the direction of that mean, the horizontal parts h_i of what is felt at the joint, as complex numbers in some
/// right-handed basis of the plane across u_i, differ by a turn: h_1 = exp(i d) h_2. With one of the accelerometers negated its u points
/// down, and the planes are seen from opposite sides: h_1 = exp(i d) conj(h_2). |sum h_1 conj(h_2)| and |sum h_1 h_2| tell which holds,
/// unless the centre moves to and fro along one line, or not at all.
#ifndef JCAL_CENTER_GRAVITY_H
#define JCAL_CENTER_GRAVITY_H

#include "center/model.h"
#include "jointcal/center_config.h"
#include "jointcal/private/center/gravity.h"
#include "jointcal/status.h"

/// Takes in a sample; `place` is the estimate. Frames that turn with the sensors (no smoothing, no orientations)
/// have no mean; with `is_turning` the mean length of the forces themselves stands in.
void jcal_center_gravity_add(jcal_center_gravity_t *self, const jcal_kinematic_t *sample,
                             const jcal_center_place_t *place, bool is_turning);

/// The joint is another one, or sits elsewhere: what hangs on its place is forgotten.
void jcal_center_gravity_forget(jcal_center_gravity_t *self);

/// What speaks against the readings: JCAL_REASON_GRAVITY_OFF, JCAL_REASON_NOT_ONE_JOINT; JCAL_REASON_UNCERTAIN while gravity is not known;
/// else JCAL_REASON_NONE. `slack` widens the limits.
jcal_reason_t jcal_center_gravity_objects(const jcal_center_gravity_t *self, float slack);

/// How far errors of scale may have moved the vector of a sensor (0, 1), m. Rates go into it once or squared, forces once:
///
///     2 rate_mismatch |r| and (| |g| / 9.81 - 1 | - 0.02) |r|, as squares;
///
/// 2 % of gravity are what usual biases make of it.
float jcal_center_gravity_shift(const jcal_center_gravity_t *self, const jcal_center_config_t *cfg,
                                const jcal_center_place_t *place, size_t sensor);

#endif /* JCAL_CENTER_GRAVITY_H */

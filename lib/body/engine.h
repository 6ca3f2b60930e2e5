/* SPDX-License-Identifier: MIT */
/// @file
/// The estimator of a joint, whatever its kind. Private.
#ifndef JCAL_BODY_ENGINE_H
#define JCAL_BODY_ENGINE_H

#include "jointcal/body.h"

/// Forgets what was learnt, keeps the settings.
void jcal_body_engine_reset(const jcal_body_joint_spec_t *joint);

/// Takes in the ticks of both sensors.
void jcal_body_engine_add(const jcal_body_joint_spec_t *joint, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// A slice of work; false if nothing was due.
bool jcal_body_engine_step(const jcal_body_joint_spec_t *joint);

/// What it says; `heading` and everything before. Angles and the lag are not its business, and untouched.
void jcal_body_engine_get(const jcal_body_joint_spec_t *joint, jcal_body_joint_result_t *out);

/// Which record is kept of it.
jcal_kept_kind_t jcal_body_engine_kind(const jcal_body_joint_spec_t *joint);

/// What it says as a record, whose joint, serial numbers, zero and lag stay as they are; false if it is not ready.
bool jcal_body_engine_kept(const jcal_body_joint_spec_t *joint, jcal_kept_t *out);

/// A hinge takes over a kept calibration that was confirmed, with the bounds of that, unless it is ready by itself or they are too wide. Others do not. True if it did.
bool jcal_body_engine_adopt(const jcal_body_joint_spec_t *joint, const jcal_kept_t *kept,
                            const jcal_remember_result_t *confirmed);

/// True if what it says was handed over, and is not of its own sums.
bool jcal_body_engine_is_adopted(const jcal_body_joint_spec_t *joint);

/// True if it sleeps.
bool jcal_body_engine_sleeps(const jcal_body_joint_spec_t *joint);

/// The angle of a hinge, rad; NaN of others.
float jcal_body_engine_flexion(const jcal_body_joint_spec_t *joint, jcal_quat_t q1, jcal_quat_t q2);

/// Sensor 2 in sensor 1 of a ball joint or one with two axes; all NaN of a hinge.
jcal_quat_t jcal_body_engine_relative(const jcal_body_joint_spec_t *joint, jcal_quat_t q1, jcal_quat_t q2);

#endif /* JCAL_BODY_ENGINE_H */

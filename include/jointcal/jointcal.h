/* SPDX-License-Identifier: MIT */
/// @file
/// jointcal: finds out by itself how IMUs sit on the two sides of a joint.
///
/// Start with types.h (units and frames) and hinge.h (how an estimator is used); the others have the same verbs.
///
/// | you want | header | settings |
/// |---|---|---|
/// | the axis of a hinge | hinge.h; hinge_window.h is the published algorithm | hinge_config.h |
/// | a hinge on a rig or on a person, and its angle | hinge_auto.h | hinge_config.h |
/// | a person's joint, with sensors that serve several | functional.h, sensor.h; functional_pair.h for one joint | functional_config.h |
/// | a person's hip or shoulder: heading and centre | ball.h, sensor.h; ball_pair.h for one joint | ball_config.h |
/// | a person's elbow: two axes, heading and centre | two_axes.h, sensor.h; two_axes_pair.h for one joint | two_axes_config.h |
/// | two axes on a rig or on a person | two_dof_auto.h | two_dof_config.h, two_axes_config.h |
/// | two axes and the heading offset | two_dof.h; two_dof_window.h is the published algorithm | two_dof_config.h |
/// | the joint's centre | center.h; center_window.h is the published algorithm | center_config.h, kinematics.h |
/// | hip and knee together | chain.h | chain_config.h |
/// | a person's hip and knee | leg.h | leg_config.h |
/// | joint angles from orientations | joint_angles.h, joint_heading.h | |
/// | one sensor's orientation and features, once for all its joints | sensor.h, tick.h | |
/// | packets of a wireless sensor as readings with times of the hub | packet.h | packet_config.h, chips.h |
/// | what is wrong with one sensor | health.h | |
/// | pairs of readings at common times, of two wireless sensors | pairing.h | pairing_config.h |
/// | by how much two sensors of one joint are out of step | lag.h | |
/// | a calibration kept while the power is off | keep.h, keep_flash.h | |
/// | whether a kept calibration still holds | remember.h | |
/// | a whole body: wireless sensors and the joints between them | body.h | body_config.h |
/// | what status, reason and hint mean | head.h, status.h, reject.h | gate.h: limits of single samples |
///
/// What stands in private/ is state whose size must be known at compile time; nothing there is for the user to touch.
#ifndef JCAL_JOINTCAL_H
#define JCAL_JOINTCAL_H

#define JCAL_VERSION_MAJOR 0
#define JCAL_VERSION_MINOR 1
#define JCAL_VERSION_PATCH 0
#define JCAL_VERSION_STRING "0.1.0"

#include "jointcal/ball.h"
#include "jointcal/ball_pair.h"
#include "jointcal/body.h"
#include "jointcal/center.h"
#include "jointcal/center_window.h"
#include "jointcal/chain.h"
#include "jointcal/chips.h"
#include "jointcal/config.h"
#include "jointcal/functional.h"
#include "jointcal/functional_pair.h"
#include "jointcal/gate.h"
#include "jointcal/head.h"
#include "jointcal/health.h"
#include "jointcal/hinge.h"
#include "jointcal/hinge_auto.h"
#include "jointcal/hinge_window.h"
#include "jointcal/joint_angles.h"
#include "jointcal/joint_heading.h"
#include "jointcal/keep.h"
#include "jointcal/keep_flash.h"
#include "jointcal/lag.h"
#include "jointcal/leg.h"
#include "jointcal/orientation.h"
#include "jointcal/packet.h"
#include "jointcal/pairing.h"
#include "jointcal/quat.h"
#include "jointcal/remember.h"
#include "jointcal/sensor.h"
#include "jointcal/status.h"
#include "jointcal/tick.h"
#include "jointcal/triple.h"
#include "jointcal/two_axes.h"
#include "jointcal/two_axes_pair.h"
#include "jointcal/two_dof.h"
#include "jointcal/two_dof_auto.h"
#include "jointcal/two_dof_window.h"
#include "jointcal/types.h"
#include "jointcal/vec3.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Version of the library that is linked, as "MAJOR.MINOR.PATCH"; compare with JCAL_VERSION_STRING.
const char *jcal_version(void);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_JOINTCAL_H */

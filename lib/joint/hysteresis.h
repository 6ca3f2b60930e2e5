/* SPDX-License-Identifier: MIT */
/// @file
/// How much worse a calibration may become before it is no longer ready. Private.
#ifndef JCAL_JOINT_HYSTERESIS_H
#define JCAL_JOINT_HYSTERESIS_H

/// A bound may grow to this many times its limit before `ready` is lost: bounds breathe with the motion of the moment, and a status
/// that changes with every breath is of no use.
#define JCAL_HYSTERESIS 1.2f

#endif /* JCAL_JOINT_HYSTERESIS_H */

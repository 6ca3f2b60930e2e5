/* SPDX-License-Identifier: MIT */
/// @file
/// What disturbs the two constraints of a 2-DoF joint, and how long it lasts. Private.
///
/// Residuals of neighbouring samples are not independent: on a rigid rig the rotation-based one loses its memory in 0.15 s, the
/// orientation-based one, which comes from errors of the inclination, in 0.8 s. A sample counts as its share of that time.
#ifndef JCAL_TWO_DOF_RESIDUAL_H
#define JCAL_TWO_DOF_RESIDUAL_H

#define JCAL_TWO_DOF_RATE_TIME_S 0.15f
#define JCAL_TWO_DOF_ANGLE_TIME_S 0.8f

#endif /* JCAL_TWO_DOF_RESIDUAL_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// How readings become angular accelerations.
#ifndef JCAL_KINEMATICS_H
#define JCAL_KINEMATICS_H

#include "jointcal/config.h"

#ifdef __cplusplus
extern "C" {
#endif

/// How angular accelerations are made from rates.
typedef enum {
    JCAL_DERIVATIVE_FIVE_POINT = 0,  ///< Five-point quotient (default).
    JCAL_DERIVATIVE_SYMMETRIC = 1    ///< Symmetric quotient: (8) of [OLS17].
} jcal_derivative_t;

/// How readings become what the joint's equation compares.
typedef struct {
    jcal_derivative_t derivative;  ///< Default JCAL_DERIVATIVE_FIVE_POINT.
    /// Everything that the equation compares is smoothed over this time, s, both sides alike and in frames that do not turn: the joint
    /// is the same, but what skin, straps and noise add is mostly faster than limbs are. Range [0, 2], default 0.12; 0: nothing is.
    float smoothing_s;
} jcal_kinematics_config_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_KINEMATICS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// What the window engine of the joint with two axes keeps of a sample.
#ifndef JCAL_PRIVATE_TWO_DOF_ROW_H
#define JCAL_PRIVATE_TWO_DOF_ROW_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// A kept sample.
typedef struct {
    uint64_t t_us;
    jcal_quat_t q1, q2;  ///< Sensor to its earth frame.
    jcal_vec3_t w1, w2;  ///< rad/s, in E1 and in E2.
    float dt_s;          ///< The time it stands for.
} jcal_two_dof_row_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_DOF_ROW_H */

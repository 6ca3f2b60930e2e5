/* SPDX-License-Identifier: MIT */
/// @file
/// What the weight of a sample depends on besides itself.
#ifndef JCAL_PRIVATE_HINGE_WEIGH_H
#define JCAL_PRIVATE_HINGE_WEIGH_H

#include "jointcal/types.h"

#ifdef __cplusplus
extern "C" {
#endif

/// What the weight of a sample depends on besides itself.
typedef struct {
    jcal_vec3_t rest_acc1;  ///< Specific forces at which the present dwelling began ...
    jcal_vec3_t rest_acc2;
    float dwell_s;       ///< ... and how long it has lasted.
    float rest_s;        ///< How long neither sensor has turned.
    float rate_product;  ///< Low-passed |w1| |w2|.
} jcal_hinge_weigh_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_HINGE_WEIGH_H */

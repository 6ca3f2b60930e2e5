/* SPDX-License-Identifier: MIT */
/// @file
/// State of a joint with two axes with sensor stages of its own. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_TWO_AXES_PAIR_H
#define JCAL_PRIVATE_TWO_AXES_PAIR_H

#include "jointcal/private/sensor/pair.h"
#include "jointcal/private/two_axes/stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_sensor_pair_t sensors;
    jcal_two_axes_t joint;
} jcal_two_axes_pair_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_TWO_AXES_PAIR_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// State of a ball joint with sensor stages of its own. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_BALL_PAIR_H
#define JCAL_PRIVATE_BALL_PAIR_H

#include "jointcal/private/ball/stream.h"
#include "jointcal/private/sensor/pair.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_sensor_pair_t sensors;
    jcal_ball_t joint;
} jcal_ball_pair_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_BALL_PAIR_H */

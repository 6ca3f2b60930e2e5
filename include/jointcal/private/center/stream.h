/* SPDX-License-Identifier: MIT */
/// @file
/// State of the stream engine of the joint centre. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_CENTER_STREAM_H
#define JCAL_PRIVATE_CENTER_STREAM_H

#include "jointcal/center_config.h"
#include "jointcal/private/center/input.h"
#include "jointcal/private/center/judge.h"
#include "jointcal/private/watch.h"

#ifdef __cplusplus
extern "C" {
#endif

/// The stream engine. Caller-owned, plain, copyable at any time between calls; all members are private.
typedef struct {
    jcal_center_config_t cfg;
    jcal_center_input_t input;
    jcal_center_place_t start;  ///< Minimum of the moments.
    jcal_plane_t heading;       ///< Sum that points along the heading offset at `start` ...
    float heading_s;            ///< ... and its time.
    jcal_center_work_t work;
    jcal_watch_t watch;
    float moving_s;   ///< Time of motion in the moments.
    uint64_t t_us;    ///< Time of the last sample in the sums.
    uint8_t turn;     ///< Next item of the cycle.
    bool has_start;   ///< `start` is a minimum.
    bool has_point;   ///< The sums have begun.
    bool has_worked;  ///< Work was done since the last sample.
} jcal_center_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CENTER_STREAM_H */

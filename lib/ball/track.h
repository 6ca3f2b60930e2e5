/* SPDX-License-Identifier: MIT */
/// @file
/// The heading of this moment, and whether a sensor has moved. Private.
#ifndef JCAL_BALL_TRACK_H
#define JCAL_BALL_TRACK_H

#include "jointcal/private/ball/stream.h"
#include "jointcal/tick.h"

/// Takes in a tick with its seconds of motion; the levers are those of the last judgement. Cost: 40 multiply-adds.
void jcal_ball_track_add(jcal_ball_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2, float motion_s);

/// True if the last seconds of motion do not fit any more: a sensor has moved.
bool jcal_ball_track_alarm(const jcal_ball_track_t *self);

/// There is another estimate: its heading counts from here on.
void jcal_ball_track_begin(jcal_ball_t *self);

/// The heading is lost, and so is what the last seconds said.
void jcal_ball_track_clear(jcal_ball_t *self);

#endif /* JCAL_BALL_TRACK_H */

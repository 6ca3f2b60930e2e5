/* SPDX-License-Identifier: MIT */
/// @file
/// The heading of this moment, and the joint's angle from it. Private.
#ifndef JCAL_FUNCTIONAL_TRACK_H
#define JCAL_FUNCTIONAL_TRACK_H

#include "jointcal/private/functional/stream.h"
#include "jointcal/tick.h"

/// Takes in a tick with its seconds of motion; the axes, levers and weights are those of the last judgement. Cost: 80 multiply-adds.
void jcal_functional_track_add(jcal_functional_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2,
                               float motion_s);

/// True if the last seconds of motion do not fit any more: a sensor has moved.
bool jcal_functional_track_alarm(const jcal_functional_track_t *self);

/// The estimate is ready for the first time: slips are looked for and the angle counts from here on, so that what other estimates left is
/// forgotten and the zero is chosen again, far from both axes.
void jcal_functional_track_trust(jcal_functional_t *self);

/// There is another estimate: the heading is lost, and the angle has another zero.
void jcal_functional_track_begin(jcal_functional_t *self);

/// The heading is lost, and so is what the last seconds said.
void jcal_functional_track_clear(jcal_functional_t *self);

#endif /* JCAL_FUNCTIONAL_TRACK_H */

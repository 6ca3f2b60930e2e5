/* SPDX-License-Identifier: MIT */
/// @file
/// Hub times that go on evenly. Private.
///
/// From reading to reading time goes on by n P (1 + d), n the difference of their numbers, and by what brings it nearer to the line of
/// packet/envelope.h: the share n P / 2 s of the distance, at most 1 % of n P. More than 50 ms off, as after a step of the clock, time
/// that is behind the line jumps there, which is a gap; time that is before it waits, and goes on by no less than 0.9 P. So times strictly
/// increase, whatever the line does.
#ifndef JCAL_PACKET_PACE_H
#define JCAL_PACKET_PACE_H

#include "jointcal/private/packet/packets.h"

/// Begins with a reading whose time by a new line is `us`: there, or a period after the last one if that is later.
void jcal_pace_begin(jcal_packet_pace_t *self, uint32_t period_ns, uint64_t at, uint64_t us);

/// The time of a later reading, us.
uint64_t jcal_pace_to(jcal_packet_pace_t *self, uint32_t period_ns, const jcal_envelope_t *envelope, uint64_t at);

#endif /* JCAL_PACKET_PACE_H */

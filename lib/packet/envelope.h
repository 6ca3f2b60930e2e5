/* SPDX-License-Identifier: MIT */
/// @file
/// Follows a sensor's clock: the line below the arrivals of its packets. Private.
///
/// A packet whose last reading has number n arrives at
///
///     t(n) = t0 + n P (1 + d) + delay,   delay >= 0,
///
/// P the nominal period, d the drift. Of all lines below the arrivals the one that is highest in the middle of the times is taken: it is
/// an edge of the lower convex hull, and its slope is d. What the fastest packet needs stays in t0.
///
/// Kept is the lowest packet of each block of time. Blocks are 0.25 s at first; when there are 16, neighbours are joined and blocks take
/// twice as long, until they take 8 s; then the oldest goes. So the line is over the last 64 to 128 s. It is drawn whenever a block ends;
/// a packet below it lowers it at once.
///
/// With r the mean height of the points above the line and T their time, the slope is right to about 2 r / T. That is called its bound
/// (unit/packet/test_clock.c counts how often it holds), and the drift moves towards the slope by the share 1 - (bound / max_drift)^2.
///
/// When the fastest packets all at once need longer, or less, the old line says nothing any more: if all packets of 5 s were high above
/// it, or one far below, what is known of t0 is forgotten; d is kept.
#ifndef JCAL_PACKET_ENVELOPE_H
#define JCAL_PACKET_ENVELOPE_H

#include "jointcal/packet_config.h"
#include "jointcal/private/packet/envelope.h"

/// Further from the anchor, us, no time means anything: 1.1 years.
#define JCAL_ENVELOPE_FAR_US ((int64_t)1 << 45)

/// Begins anew with one packet, whose last reading has number `at`; the drift that was known stays as a first guess.
void jcal_envelope_begin(jcal_envelope_t *self, const jcal_packet_config_t *cfg, uint64_t at, uint64_t us);

/// By how much a time `us` of reading `at` is above the line, us. The reading is at most twice JCAL_ENVELOPE_FAR_US from the anchor; of a time
/// further than that only the sign is right.
float jcal_envelope_above(const jcal_envelope_t *self, uint32_t period_ns, uint64_t at, uint64_t us);

/// Takes in a packet. True if the line had to begin anew with it.
bool jcal_envelope_put(jcal_envelope_t *self, const jcal_packet_config_t *cfg, uint64_t at, uint64_t us);

#endif /* JCAL_PACKET_ENVELOPE_H */

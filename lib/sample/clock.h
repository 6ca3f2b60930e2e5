/* SPDX-License-Identifier: MIT */
/// @file
/// Which times are believed: those that go on from the last one, and those that go on from each other for long enough. Private.
///
/// A hole is believed as soon as a second sample goes on from the first one after it, so that one wild time stamp does not take the
/// clock along. Time that goes back is believed after JCAL_CLOCK_ANEW_US of samples that go on from each other: a clock that began
/// anew, or 32-bit microseconds after 71.6 minutes. Packets in the wrong order do not last that long.
#ifndef JCAL_CLOCK_H
#define JCAL_CLOCK_H

#include "jointcal/private/clock.h"
#include "jointcal/reject.h"

/// How long a clock that went back must go on before it is believed, us.
#define JCAL_CLOCK_ANEW_US 400000u

/// Samples further apart than this, s, are fewer than 10 a second, with 5 % for clocks: the angle of a joint cannot be followed then.
#define JCAL_CLOCK_SLOW_S 0.105f
/// More than half of so many samples say that the rate is too low.
#define JCAL_CLOCK_SLOW_MOST 40u

/// True if samples have come at less than 10 a second for a while.
static inline bool jcal_clock_is_slow(const jcal_clock_t *self)
{
    return self->slow > (JCAL_CLOCK_SLOW_MOST / 2u);
}

/// Takes in a time stamp; `gap_s` is the longest distance of two samples that go on from each other.
///
/// Outputs:  dt_s, the time since the sample before; 0 if that is not known.
/// Returns:  JCAL_REJECT_NONE; JCAL_REJECT_GAP for the first after a hole, and for the one at which a clock that went back is believed;
///           JCAL_REJECT_TIME_ORDER.
jcal_reject_t jcal_clock_check(jcal_clock_t *self, float gap_s, uint64_t t_us, float *dt_s);

#endif /* JCAL_CLOCK_H */

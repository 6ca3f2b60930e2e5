/* SPDX-License-Identifier: MIT */
/// @file
/// One sensor's readings at common times. Private.
///
/// Common time n is at n periods of the body's time. A sensor tells of n if n lies between its last two readings, these are no further apart
/// than gap_s, and n is not before `begin`. Whenever it does not tell of one, or its readings are too far apart, `begin` is moved to where its
/// stage sees a gap and its ticks fall on those of all others.
#ifndef JCAL_BODY_LINE_H
#define JCAL_BODY_LINE_H

#include "jointcal/private/body/state.h"

/// Nothing is known any more, and nothing is told before number `from`, nor before the stage sees a gap.
void jcal_body_line_begin(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t from);

/// Takes in a reading; false, untouched, if its time does not increase.
bool jcal_body_line_put(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint64_t t_us, const jcal_imu_t *imu);

/// True if no later reading can change what is told of number n.
static inline bool jcal_body_line_knows(const jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n)
{
    return self->has && (self->after_us >= ((uint64_t)n * pace->period_us));
}

/// True if number n is told of.
bool jcal_body_line_tells(const jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n);

/// The reading at number n, which is told of.
jcal_imu_t jcal_body_line_read(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n);

/// Number n was not told of.
void jcal_body_line_miss(jcal_body_line_t *self, const jcal_body_pace_t *pace, uint32_t n);

/// Rounds in a time, us, rounded down.
static inline uint32_t jcal_body_rounds(const jcal_body_pace_t *pace, uint32_t time_us)
{
    return time_us / pace->period_us;
}

#endif /* JCAL_BODY_LINE_H */

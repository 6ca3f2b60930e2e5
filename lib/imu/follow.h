/* SPDX-License-Identifier: MIT */
/// @file
/// What sensors whose readings come together do with a reading: whether all of them follow it, and how much work it pays for. Private.
#ifndef JCAL_IMU_FOLLOW_H
#define JCAL_IMU_FOLLOW_H

#include "jointcal/reject.h"

#include <stdbool.h>
#include <stdint.h>

/// Readings further apart than this, us, have as many slices between them as fit.
#define JCAL_FOLLOW_LONGEST_US 1000000u
/// Most slices of a joint that one reading pays for.
#define JCAL_FOLLOW_SLICES_MAX 16u

/// Slices that a joint may do for a reading so long after the one before: those of a tick are spread over its readings.
static inline unsigned jcal_follow_slices(float slices_per_s, uint64_t dt_us)
{
    const float dt_s = (dt_us < JCAL_FOLLOW_LONGEST_US) ? ((float)(uint32_t)dt_us * 1e-6f) : 1.0f;
    const float due = 1.0f + (0.9f * slices_per_s * dt_s); /* less: samples are not evenly apart */
    return ((due >= 0.0f) && (due < (float)JCAL_FOLLOW_SLICES_MAX)) ? (unsigned)due : JCAL_FOLLOW_SLICES_MAX;
}

/// True if orientations are better followed with this reading than without: what is clipped, or repeats the one before in place of a lost
/// packet, is the best that is known of its moment, and a turn that is left out is lost.
static inline bool jcal_follow_may(jcal_reject_t reject)
{
    return (reject == JCAL_REJECT_NONE) || (reject == JCAL_REJECT_SATURATED) || (reject == JCAL_REJECT_REPEATED) ||
           (reject == JCAL_REJECT_GAP);
}

#endif /* JCAL_IMU_FOLLOW_H */

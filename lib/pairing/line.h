/* SPDX-License-Identifier: MIT */
/// @file
/// The straight line between two readings of a sensor. Private.
#ifndef JCAL_PAIRING_LINE_H
#define JCAL_PAIRING_LINE_H

#include "jointcal/types.h"
#include "jointcal/vec3.h"

/// (1 - share) a + share b: exact at both ends.
static inline jcal_vec3_t jcal_line_between(jcal_vec3_t a, jcal_vec3_t b, float share)
{
    return jcal_vec3_add(jcal_vec3_scale(a, 1.0f - share), jcal_vec3_scale(b, share));
}

/// The reading at `share`, 0 to 1, of the way from one to the next.
static inline jcal_imu_t jcal_line_at(const jcal_imu_t *before, const jcal_imu_t *after, float share)
{
    const jcal_imu_t out = {jcal_line_between(before->gyr_rad_s, after->gyr_rad_s, share),
                            jcal_line_between(before->acc_m_s2, after->acc_m_s2, share)};
    return out;
}

#endif /* JCAL_PAIRING_LINE_H */

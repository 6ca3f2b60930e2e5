/* SPDX-License-Identifier: MIT */
/// @file
/// Whether four numbers are an orientation. Private.
#ifndef JCAL_UNIT_PRIVATE_H
#define JCAL_UNIT_PRIVATE_H

#include "jointcal/types.h"
#include "math/scalar.h"

/// Square of the length of a quaternion, least and most: 1 -+ 0.05 in length. Chips send 14 bits or more, which is far better; what
/// is further off is no rounding but another format, a torn packet or zeros.
#define JCAL_UNIT_LENGTH2_MIN 0.9025f
#define JCAL_UNIT_LENGTH2_MAX 1.1025f

static inline float jcal_unit_length2(jcal_quat_t q)
{
    return (q.w * q.w) + (q.x * q.x) + (q.y * q.y) + (q.z * q.z);
}

/// True for a quaternion of about length 1; not so for NaN.
static inline bool jcal_is_unit(jcal_quat_t q)
{
    return jcal_within(jcal_unit_length2(q), JCAL_UNIT_LENGTH2_MIN, JCAL_UNIT_LENGTH2_MAX);
}

#endif /* JCAL_UNIT_PRIVATE_H */

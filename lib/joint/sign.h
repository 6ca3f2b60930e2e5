/* SPDX-License-Identifier: MIT */
/// @file
/// Which of the two directions of an axis is reported: an axis and its opposite are the same line. Private.
///
/// Until a calibration is ready the sign follows a rule: towards a direction that the user names, or else the largest component is
/// positive. Both may be nearly a tie, and the estimate still moves. So once ready the sign stays: the component that is largest then
/// keeps its sign. It is at least 0.577, so that an axis would have to turn by 35 deg before this was a tie in its turn.
///
/// State: one int8_t, zero until chosen; later 1, 2, 3 where x, y, z stays positive, -1, -2, -3 where it stays negative.
#ifndef JCAL_JOINT_SIGN_H
#define JCAL_JOINT_SIGN_H

#include "jointcal/hinge_config.h"
#include "jointcal/vec3.h"

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/// Largest component of a direction that a user may name; of any other length than zero, which names none.
#define JCAL_SIGN_TOWARD_MAX 1e6f

/// Number of the component of largest magnitude, 1 to 3, with its sign; the first of equals, +1 for zeros.
static inline int8_t jcal_sign_largest(jcal_vec3_t axis)
{
    const float all[3] = {axis.x, axis.y, axis.z};
    unsigned largest = 0u;
    for (unsigned i = 1u; i < 3u; ++i) {
        largest = (fabsf(all[i]) > fabsf(all[largest])) ? i : largest;
    }
    const int number = (int)largest + 1;
    return (int8_t)((all[largest] < 0.0f) ? -number : number);
}

/// +1 or -1: the sign of the component of largest magnitude.
static inline float jcal_sign_main(jcal_vec3_t axis)
{
    return (jcal_sign_largest(axis) < 0) ? -1.0f : 1.0f;
}

/// True if a user may name this direction: finite, or zero for none.
static inline bool jcal_sign_may_be_toward(jcal_vec3_t toward)
{
    return (fabsf(toward.x) <= JCAL_SIGN_TOWARD_MAX) && (fabsf(toward.y) <= JCAL_SIGN_TOWARD_MAX) &&
           (fabsf(toward.z) <= JCAL_SIGN_TOWARD_MAX); /* false for NaN */
}

/// +1 or -1: the sign of the component that `kept` names; of the largest one while that is zero.
static inline float jcal_sign_held(jcal_vec3_t axis, int8_t kept)
{
    const int number = (kept < 0) ? -kept : kept;
    const float component = (number == 1) ? axis.x : ((number == 2) ? axis.y : axis.z);
    return (number == 0) ? jcal_sign_main(axis) : ((component < 0.0f) ? -1.0f : 1.0f);
}

/// +1 or -1: what `axis` is to be multiplied by before it is reported. `toward`: zero for none; `kept`: the state.
static inline float jcal_sign_of(jcal_vec3_t axis, jcal_vec3_t toward, int8_t kept)
{
    if (kept != 0) {
        return ((kept < 0) ? -1.0f : 1.0f) * jcal_sign_held(axis, kept);
    }
    const float along = jcal_vec3_dot(axis, toward);
    if ((along > 0.0f) || (along < 0.0f)) {
        return (along < 0.0f) ? -1.0f : 1.0f;
    }
    return jcal_sign_main(axis);
}

/// The state from the moment on at which a calibration is ready: the sign that `axis` is reported with stays.
static inline void jcal_sign_keep(int8_t *kept, jcal_vec3_t axis, jcal_vec3_t toward)
{
    if (*kept == 0) {
        *kept = jcal_sign_largest(jcal_vec3_scale(axis, jcal_sign_of(axis, toward, 0)));
    }
}

/// True if the pairing of two axes is what the user's hint says, or there is none; `kept`: the state of both, so that a tie is no change.
static inline bool jcal_sign_obeys(jcal_sign_hint_t hint, jcal_vec3_t axis1, jcal_vec3_t axis2, const int8_t kept[2])
{
    const bool same = jcal_sign_held(axis1, kept[0]) == jcal_sign_held(axis2, kept[1]);
    return !((hint == JCAL_SIGN_SAME) && !same) && !((hint == JCAL_SIGN_OPPOSITE) && same);
}

/// Name of the setting that is none of these, or null.
static inline const char *jcal_sign_check(jcal_sign_hint_t hint, jcal_vec3_t toward)
{
    const int number = (int)hint;
    if ((number < (int)JCAL_SIGN_UNKNOWN) || (number > (int)JCAL_SIGN_OPPOSITE)) {
        return "sign_hint";
    }
    return jcal_sign_may_be_toward(toward) ? NULL : "axis1_toward";
}

#endif /* JCAL_JOINT_SIGN_H */

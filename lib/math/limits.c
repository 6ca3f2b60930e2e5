/* SPDX-License-Identifier: MIT */
/// @file
/// Numbers of a config and their ranges. See limits.h.
#include "math/limits.h"

#include "math/scalar.h"

const char *jcal_limits_check(const jcal_limit_t *limits, size_t count)
{
    for (size_t i = 0u; i < count; ++i) {
        if (!jcal_within(limits[i].value, limits[i].low, limits[i].high)) {
            return limits[i].name;
        }
    }
    return NULL;
}

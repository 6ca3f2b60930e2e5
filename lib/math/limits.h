/* SPDX-License-Identifier: MIT */
/// @file
/// Numbers of a config and their ranges. Private.
#ifndef JCAL_LIMITS_H
#define JCAL_LIMITS_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

/// A number, and the least and largest that it may be.
typedef struct {
    const char *name;
    float value, low, high;
} jcal_limit_t;

/// Name of the first that is out of its range, or null. NaN is outside of every range.
const char *jcal_limits_check(const jcal_limit_t *limits, size_t count);

#ifdef __cplusplus
}
#endif

#endif /* JCAL_LIMITS_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// Which times are believed; lib/sample/clock.h has the rules. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_CLOCK_H
#define JCAL_PRIVATE_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/// Follows the time stamps.
typedef struct {
    uint64_t last_us;  ///< The last time that was believed.
    uint64_t odd_us;   ///< The last time that did not follow it ...
    uint32_t run_us;   ///< ... and for how long such times have followed each other.
    bool has_last, has_odd;
    uint8_t slow;  ///< Samples that came too far apart, less those that did not; 0 to JCAL_CLOCK_SLOW_MOST.
} jcal_clock_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_CLOCK_H */

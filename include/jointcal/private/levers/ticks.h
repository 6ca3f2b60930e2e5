/* SPDX-License-Identifier: MIT */
/// @file
/// What is remembered of the ticks of two sensors. Nothing here is for the user to touch.
#ifndef JCAL_PRIVATE_LEVERS_TICKS_H
#define JCAL_PRIVATE_LEVERS_TICKS_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct {
    uint64_t last_us;  ///< Time of the last tick.
    float rate2;       ///< Both squared rates, smoothed, (rad/s)^2.
    float
        gravity_off;  ///< How far the specific forces' means are from gravity, m/s^2; the larger of both sensors. While one of them has
    ///< just begun anew, it is held: its mean is of few seconds.
    uint32_t count;  ///< Pairs of ticks.
    uint32_t epoch1, epoch2;
    bool has_tick;
    bool has_gravity;  ///< gravity_off was taken from means of both sensors that were not young.
} jcal_tick_pair_t;

#ifdef __cplusplus
}
#endif

#endif /* JCAL_PRIVATE_LEVERS_TICKS_H */

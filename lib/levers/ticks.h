/* SPDX-License-Identifier: MIT */
/// @file
/// Ticks of two sensors for one joint: whether a pair of them may be taken, and what it counts. Private.
#ifndef JCAL_LEVERS_TICKS_H
#define JCAL_LEVERS_TICKS_H

#include "jointcal/private/levers/ticks.h"
#include "jointcal/tick.h"

#include <stdbool.h>

/// What a pair of ticks is.
typedef enum {
    JCAL_TICKS_REJECTED =
        0,  ///< Times that differ or do not increase, or a number that no sensor makes. Nothing is remembered of it.
    JCAL_TICKS_GO_ON = 1,
    JCAL_TICKS_ANEW = 2  ///< The features of a sensor began anew: headings of before are not those of now.
} jcal_ticks_t;

/// Weights of one tick.
typedef struct {
    float motion_s;  ///< w: seconds, less where there is little motion.
    float spin;      ///< w over the squared rate: a rate across the axis counts as an angle, s / (rad/s)^2.
    float rate2;     ///< Both squared rates, smoothed, (rad/s)^2.
} jcal_tick_weights_t;

/// Checks a pair of ticks and remembers it. Cost: 100 multiply-adds.
jcal_ticks_t jcal_ticks_take(jcal_tick_pair_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// What the pair counts, of a pair that goes on.
jcal_tick_weights_t jcal_ticks_weigh(jcal_tick_pair_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// True if the filters of either sensor began after a gap, and not long ago: its inclination is still wrong by degrees. Joints leave such ticks
/// out. After the very first reading they do not: sensors mostly rest then, and nothing is known that could be spoilt.
bool jcal_ticks_are_cold(const jcal_tick_t *tick1, const jcal_tick_t *tick2);

/// A sensor has moved: times and epochs go on, how fast it moved and how gravity looked is forgotten.
void jcal_ticks_forget(jcal_tick_pair_t *self);

#endif /* JCAL_LEVERS_TICKS_H */

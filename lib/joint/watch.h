/* SPDX-License-Identifier: MIT */
/// @file
/// Notices that a sensor has moved: after `ready` the residuals of 1.5 s of motion are many times what they were. Private.
///
/// A misfit that grows slowly, as when the estimate settles, moves what is usual and is no alarm; rest carries no weight.
#ifndef JCAL_WATCH_PRIVATE_H
#define JCAL_WATCH_PRIVATE_H

#include "jointcal/private/watch.h"
#include "math/scalar.h"

/// Time constants, s of motion.
#define JCAL_WATCH_RECENT_S 1.5f
#define JCAL_WATCH_USUAL_S 20.0f

/// A sensor has moved when recent residuals, squared, are this many times the usual ones.
#define JCAL_WATCH_RATIO 5.0f

/// What is usual is never taken for less than this: a calm moment is no measure.
#define JCAL_WATCH_LEAST 0.25f

/// A square counts at most this many times the usual, so that an alarm takes half a second of motion that does not fit: a few samples
/// spoilt by a lost packet, or by sensors that are put down on a table, are no slip.
#define JCAL_WATCH_CLIP 15.0f

/// Squared rates of both sensors at which a sample counts half: rest tells nothing, (rad/s)^2.
#define JCAL_WATCH_REST_RATE2 0.25f

/// The share of its time for which a sample counts as motion, from the sum of both squared rates.
static inline float jcal_watch_motion(float rate2)
{
    return rate2 / (rate2 + JCAL_WATCH_REST_RATE2);
}

/// Takes in a squared residual of one kind (0 or 1), with its time of motion, s.
static inline void jcal_watch_add(jcal_watch_t *self, unsigned kind, float square, float motion_s)
{
    const float usual = jcal_max(self->usual[kind], JCAL_WATCH_LEAST);
    const float clipped = jcal_min(square, JCAL_WATCH_CLIP * usual);
    self->recent[kind] += (clipped - self->recent[kind]) * (motion_s / (motion_s + JCAL_WATCH_RECENT_S));
    if (self->on) {
        self->seen_s[kind] = jcal_min(self->seen_s[kind] + motion_s, JCAL_WATCH_USUAL_S);
        self->usual[kind] += (self->recent[kind] - self->usual[kind]) * (motion_s / self->seen_s[kind]);
    }
}

/// The calibration is ready: from now on what happens is compared with what has happened until now.
static inline void jcal_watch_start(jcal_watch_t *self)
{
    if (!self->on) {
        self->usual[0] = self->recent[0];
        self->usual[1] = self->recent[1];
        self->seen_s[0] = JCAL_WATCH_RECENT_S;
        self->seen_s[1] = JCAL_WATCH_RECENT_S;
        self->on = true;
    }
}

/// True if a sensor has moved.
static inline bool jcal_watch_alarm(const jcal_watch_t *self)
{
    return self->on && ((self->recent[0] > (JCAL_WATCH_RATIO * jcal_max(self->usual[0], JCAL_WATCH_LEAST))) ||
                        (self->recent[1] > (JCAL_WATCH_RATIO * jcal_max(self->usual[1], JCAL_WATCH_LEAST))));
}

#endif /* JCAL_WATCH_PRIVATE_H */

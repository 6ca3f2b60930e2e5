/* SPDX-License-Identifier: MIT */
/// @file
/// Events that wait for a reader. Private.
#ifndef JCAL_BODY_EVENTS_H
#define JCAL_BODY_EVENTS_H

#include "jointcal/body.h"

/// Puts an event in; where there is no room the oldest goes, and is counted.
void jcal_body_events_put(jcal_body_events_t *self, const jcal_body_event_t *event);

/// Takes the oldest out; false if there is none.
bool jcal_body_events_take(jcal_body_events_t *self, jcal_body_event_t *out);

/// Hub time of the round that is worked at, us.
static inline uint64_t jcal_body_time(const jcal_body_t *self)
{
    return ((uint64_t)self->round.number * self->pace.period_us) + self->round.origin_us;
}

/// An event of a joint, now.
void jcal_body_tell_joint(jcal_body_t *self, unsigned joint, jcal_body_event_kind_t kind, unsigned what, float value);

/// An event of a sensor, now.
void jcal_body_tell_sensor(jcal_body_t *self, unsigned sensor, jcal_body_event_kind_t kind, unsigned what, float value);

#endif /* JCAL_BODY_EVENTS_H */

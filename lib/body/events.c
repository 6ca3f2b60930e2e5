/* SPDX-License-Identifier: MIT */
/// @file
/// Events that wait for a reader. See body/events.h.
#include "body/events.h"

#include <stddef.h>

void jcal_body_events_put(jcal_body_events_t *self, const jcal_body_event_t *event)
{
    if (self->count >= JCAL_BODY_EVENTS) {
        self->first = (uint8_t)((self->first + 1u) % JCAL_BODY_EVENTS);
        self->count = (uint8_t)(self->count - 1u);
        self->dropped += 1u;
    }
    self->ring[((unsigned)self->first + self->count) % JCAL_BODY_EVENTS] = *event;
    self->count = (uint8_t)(self->count + 1u);
}

bool jcal_body_events_take(jcal_body_events_t *self, jcal_body_event_t *out)
{
    if (self->count == 0u) {
        return false;
    }
    *out = self->ring[self->first % JCAL_BODY_EVENTS];
    self->first = (uint8_t)((self->first + 1u) % JCAL_BODY_EVENTS);
    self->count = (uint8_t)(self->count - 1u);
    return true;
}

void jcal_body_tell_joint(jcal_body_t *self, unsigned joint, jcal_body_event_kind_t kind, unsigned what, float value)
{
    const jcal_body_event_t event = {jcal_body_time(self), value,          (uint8_t)kind,
                                     (uint8_t)joint,       JCAL_BODY_NONE, (uint8_t)what};
    jcal_body_events_put(&self->events, &event);
}

void jcal_body_tell_sensor(jcal_body_t *self, unsigned sensor, jcal_body_event_kind_t kind, unsigned what, float value)
{
    const jcal_body_event_t event = {jcal_body_time(self), value,           (uint8_t)kind,
                                     JCAL_BODY_NONE,       (uint8_t)sensor, (uint8_t)what};
    jcal_body_events_put(&self->events, &event);
}

const char *jcal_body_event_string(jcal_body_event_kind_t kind)
{
    static const char *const words[] = {"ready",      "left_ready",  "moved",       "not_one",     "lag_found",
                                        "sensor_bad", "sensor_fine", "sensor_lost", "sensor_back", "remembered",
                                        "confirmed",  "dropped",     "kept",        "exchanged"};
    const int index = (int)kind;
    return ((index >= 0) && ((size_t)index < (sizeof words / sizeof words[0]))) ? words[index] : NULL;
}

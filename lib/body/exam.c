/* SPDX-License-Identifier: MIT */
/// @file
/// What is wrong with sensors. See body/exam.h.
#include "body/exam.h"

#include "body/events.h"
#include "body/trust.h"

#include <stddef.h>

/// Readings that have stood still for so long are a sensor's that hangs, us: noise alone changes them from one to the next.
#define FROZEN_US 500000u
#define FROZEN_BIT (1u << (unsigned)JCAL_FINDING_FROZEN)

/// Units of a reading that is examined.
#define EXAM_UNITS 2u
/// Time from one look to the next, us.
#define LOOK_US 1000000u

/// Number of the lowest bit of `bits`, which are not zero.
static unsigned lowest(unsigned bits)
{
    unsigned k = 0u;
    while ((k < 15u) && (((bits >> k) & 1u) == 0u)) {
        ++k;
    }
    return k;
}

/// `fact` of each finding, or null.
static void set_bad(jcal_body_t *self, unsigned sensor, unsigned bad, const float *fact)
{
    jcal_body_sensor_t *const state = &self->table.sensor_states[sensor];
    const unsigned fresh = bad & ~(unsigned)state->bad;
    const bool recovers = (bad == 0u) && (state->bad != 0u);
    state->bad = (uint16_t)bad;
    if (fresh != 0u) {
        const unsigned finding = lowest(fresh);
        jcal_body_tell_sensor(self, sensor, JCAL_BODY_SENSOR_BAD, finding, (fact != NULL) ? fact[finding] : 0.0f);
    } else if (recovers) {
        jcal_body_tell_sensor(self, sensor, JCAL_BODY_SENSOR_FINE, 0u, 0.0f);
    } else {
        /* as before */
    }
}

unsigned jcal_body_exam_push(jcal_body_t *self, unsigned sensor, const jcal_reading_t *reading)
{
    if ((self->table.health == NULL) || (self->exam.sensor != sensor)) {
        return 0u;
    }
    (void)jcal_health_push(self->table.health, reading);
    return EXAM_UNITS;
}

void jcal_body_exam_watch(jcal_body_t *self, unsigned sensor, bool same, uint64_t since_us)
{
    jcal_body_sensor_t *const state = &self->table.sensor_states[sensor];
    const uint64_t stood_us = same ? (state->same_us + since_us) : 0u;
    state->same_us = (uint32_t)((stood_us < FROZEN_US) ? stood_us : FROZEN_US);
    const unsigned others = (unsigned)state->bad & ~FROZEN_BIT;
    set_bad(self, sensor, (state->same_us >= FROZEN_US) ? (others | FROZEN_BIT) : others, NULL);
}

bool jcal_body_exam_look(jcal_body_t *self)
{
    jcal_body_exam_t *const exam = &self->exam;
    if ((self->table.health == NULL) ||
        ((self->round.number - exam->looked) * (uint64_t)self->pace.period_us < LOOK_US)) {
        return false;
    }
    exam->looked = self->round.number;
    jcal_health_result_t result;
    if (jcal_health_get(self->table.health, &result) == JCAL_OK) {
        const unsigned before = self->table.sensor_states[exam->sensor].bad;
        set_bad(self, exam->sensor, jcal_trust_findings((uint16_t)before, &result) | (before & FROZEN_BIT),
                result.fact);
    }
    if ((self->round.number - exam->since) >= self->pace.examine) {
        exam->since = self->round.number;
        exam->sensor = (uint8_t)((exam->sensor + 1u) % self->table.sensor_count);
        return jcal_health_init(self->table.health) == JCAL_OK;
    }
    return true;
}

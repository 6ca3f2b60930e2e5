/* SPDX-License-Identifier: MIT */
/// @file
/// Brings all sensors to one common time after the other. See body/round.h.
#include "body/round.h"

#include "body/engine.h"
#include "body/events.h"
#include "body/exam.h"
#include "body/line.h"
#include "body/probe.h"
#include "body/restore.h"
#include "math/scalar.h"

#include <stddef.h>

/// The body's time of the first reading, us: early enough that no lag leads before zero, and no number is zero.
#define FIRST_US 10000000u
/// A clock that goes back by more began anew; a sensor that is silent for longer is not waited for; a reading that is further ahead of the
/// hub's time is not believed. All us.
#define BACK_US 1000000u
#define SILENT_US 1000000u
#define AHEAD_US 1000000u

/// Time after which filters have forgotten what they began with, s, for a lag and for a kept calibration; and for what a joint learns, whose watch
/// for slips sees the inclination of a sensor that has just begun: docs/METHOD_HUB.md, section 1.
#define SETTLED_S 3.0f
#define SETTLED_JOINT_S 5.0f

/// Units of a reading without what an examination adds, of a sample or the end of a round, of a joint's ticks, of the same for the lag.
#define READING_UNITS 1u
#define SAMPLE_UNITS 1u
#define TICK_UNITS 1u
#define LAG_UNITS 2u

enum { TAKE = 0, SAMPLE = 1, ADD = 2 };

/// The body's time goes on from where it was, whatever the hub's clock is now.
static void begin_clock(jcal_body_t *self, uint64_t now_us)
{
    const uint64_t body_us = self->round.now_us + BACK_US;
    self->round.origin_us = now_us - body_us;
    self->restarts += 1u;
    for (unsigned s = 0u; s < self->table.sensor_count; ++s) {
        jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
        jcal_body_line_begin(&sensor->line, &self->pace, self->round.number + 1u);
        sensor->heard_us = body_us;
    }
}

void jcal_body_round_now(jcal_body_t *self, uint64_t now_us)
{
    jcal_body_round_t *const round = &self->round;
    if (!round->has_begun) {
        round->now_us = FIRST_US;
        round->origin_us = now_us - FIRST_US;
        round->has_begun = true;
        round->number = FIRST_US / self->pace.period_us;
        self->exam.since = round->number;
        self->exam.looked = round->number;
        self->probe.since = round->number;
        self->probe.looked = round->number;
    }
    const uint64_t back_us = (round->now_us + round->origin_us) - now_us;
    const bool is_back = (back_us != 0u) && (back_us <= (UINT64_MAX / 2u));
    if (is_back && (back_us > BACK_US)) {
        begin_clock(self, now_us);
    }
    const uint64_t body_us = now_us - round->origin_us;
    round->now_us = (is_back && (back_us <= BACK_US)) ? round->now_us : body_us;
}

static bool is_same(const jcal_imu_t *a, const jcal_imu_t *b)
{
    return (a->gyr_rad_s.x == b->gyr_rad_s.x) && (a->gyr_rad_s.y == b->gyr_rad_s.y) &&
           (a->gyr_rad_s.z == b->gyr_rad_s.z) && (a->acc_m_s2.x == b->acc_m_s2.x) && (a->acc_m_s2.y == b->acc_m_s2.y) &&
           (a->acc_m_s2.z == b->acc_m_s2.z);
}

static void hear(jcal_body_t *self, unsigned s, uint64_t t_us)
{
    jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
    sensor->heard_us = t_us;
    if (!sensor->is_heard) {
        sensor->is_heard = true;
        jcal_body_tell_sensor(self, s, JCAL_BODY_SENSOR_BACK, 0u, 0.0f);
    }
}

/// A reading that came out of a sensor's packets. Returns the units beyond those of any reading.
static unsigned put(jcal_body_t *self, unsigned s, const jcal_reading_t *reading)
{
    jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
    jcal_body_line_t *const line = &sensor->line;
    const uint64_t t_us = reading->t_us - self->round.origin_us - (uint64_t)(int64_t)sensor->shift_us;
    const bool same = line->has && is_same(&reading->imu, &line->after);
    const uint64_t since_us = t_us - line->after_us;
    if ((t_us > (self->round.now_us + AHEAD_US)) || !jcal_sensor_may_take(&reading->imu) ||
        !jcal_body_line_put(line, &self->pace, t_us, &reading->imu)) {
        sensor->rejected += 1u;
        return 0u;
    }
    hear(self, s, t_us);
    sensor->late += ((t_us + self->pace.period_us) < ((uint64_t)self->round.number * self->pace.period_us)) ? 1u : 0u;
    jcal_body_exam_watch(self, s, same, since_us);
    return jcal_body_exam_push(self, s, reading);
}

/// A reading of a sensor; 0 if none waits.
static unsigned take(jcal_body_t *self, unsigned s)
{
    jcal_reading_t reading;
    const jcal_status_t status = jcal_packets_pull(&self->table.sensor_states[s].packets, &reading);
    if (status == JCAL_OK) {
        return READING_UNITS + put(self, s, &reading);
    }
    return (status == JCAL_REJECTED) ? READING_UNITS : 0u;
}

/// True if the round need not wait any longer, and somebody has got to it.
static bool may_begin(const jcal_body_t *self)
{
    const jcal_body_round_t *const round = &self->round;
    const uint64_t t_us = (uint64_t)round->number * self->pace.period_us;
    const bool is_over = round->now_us >= (t_us + self->pace.wait_us);
    bool is_known = false;
    for (unsigned s = 0u; s < self->table.sensor_count; ++s) {
        const jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
        const bool knows = jcal_body_line_knows(&sensor->line, &self->pace, round->number);
        if (!knows && sensor->is_heard && !is_over) {
            return false;
        }
        is_known = is_known || knows;
    }
    return is_known;
}

/// Where nobody tells of this round, on to the first that somebody will.
static void skip(jcal_body_t *self)
{
    uint32_t first = UINT32_MAX;
    for (unsigned s = 0u; s < self->table.sensor_count; ++s) {
        const jcal_body_line_t *const line = &self->table.sensor_states[s].line;
        if (jcal_body_line_tells(line, &self->pace, self->round.number)) {
            return;
        }
        if (line->has && (line->begin > self->round.number) && (line->begin < first)) {
            first = line->begin;
        }
    }
    if (first != UINT32_MAX) {
        self->round.number = first;
    }
}

/// Readings, until every sensor has got to the round or has none.
static unsigned step_take(jcal_body_t *self)
{
    jcal_body_round_t *const round = &self->round;
    for (; round->at < self->table.sensor_count; ++round->at) {
        const jcal_body_line_t *const line = &self->table.sensor_states[round->at].line;
        if (!jcal_body_line_knows(line, &self->pace, round->number)) {
            const unsigned units = take(self, round->at);
            if (units > 0u) {
                return units;
            }
        }
    }
    round->at = 0u;
    if (!may_begin(self)) {
        return 0u;
    }
    const uint32_t before = round->number;
    skip(self);
    if (round->number == before) {
        round->phase = (uint8_t)SAMPLE;
        self->rounds += 1u;
    }
    return SAMPLE_UNITS;
}

/// The sample of one sensor.
static unsigned step_sample(jcal_body_t *self)
{
    jcal_body_round_t *const round = &self->round;
    jcal_body_sensor_t *const sensor = &self->table.sensor_states[round->at];
    sensor->ticks = false;
    if (jcal_body_line_tells(&sensor->line, &self->pace, round->number)) {
        const jcal_reading_t reading = {(uint64_t)round->number * self->pace.period_us,
                                        jcal_body_line_read(&sensor->line, &self->pace, round->number)};
        sensor->ticks = jcal_sensor_push(&sensor->stage, &reading) == JCAL_TICK;
        sensor->samples += 1u;
    } else {
        jcal_body_line_miss(&sensor->line, &self->pace, round->number);
        sensor->missed += 1u;
    }
    round->at = (uint8_t)(round->at + 1u);
    if (round->at == self->table.sensor_count) {
        round->at = 0u;
        round->phase = (uint8_t)ADD;
    }
    return SAMPLE_UNITS;
}

/// The ticks of a sensor, or null if it made none in this round.
static const jcal_tick_t *tick_of(const jcal_body_t *self, unsigned s)
{
    const jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
    return sensor->ticks ? jcal_sensor_tick(&sensor->stage) : NULL;
}

/// The ticks of both sensors of a joint, if both made one in this round and the filters of both have settled.
static bool ticks_of(const jcal_body_t *self, const jcal_body_joint_spec_t *joint, const jcal_tick_t *ticks[2])
{
    ticks[0] = tick_of(self, joint->proximal);
    ticks[1] = tick_of(self, joint->distal);
    return (ticks[0] != NULL) && (ticks[1] != NULL) && (jcal_min(ticks[0]->since_s, ticks[1]->since_s) >= SETTLED_S);
}

static bool add_to_joint(jcal_body_t *self, unsigned j)
{
    const jcal_body_joint_spec_t *const joint = &self->table.joints[j];
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    const jcal_tick_t *ticks[2];
    if (!ticks_of(self, joint, ticks)) {
        return false;
    }
    jcal_body_restore_add(self, j, ticks[0], ticks[1]);
    self->slices_due = true;
    if (jcal_min(ticks[0]->since_s, ticks[1]->since_s) < SETTLED_JOINT_S) {
        return true;
    }
    jcal_body_engine_add(joint, ticks[0], ticks[1]);
    state->epoch1 = ticks[0]->epoch;
    state->epoch2 = ticks[1]->epoch;
    state->due = true;
    state->ticks = (uint8_t)((state->ticks < UINT8_MAX) ? (state->ticks + 1u) : UINT8_MAX);
    return true;
}

static unsigned add_to_lag(jcal_body_t *self)
{
    if (self->probe.joint == JCAL_BODY_NONE) {
        return SAMPLE_UNITS;
    }
    jcal_body_joint_spec_t joint = self->table.joints[self->probe.joint];
    const jcal_tick_t *ticks[2];
    self->probe.due = true;
    joint.distal = (self->probe.other == JCAL_BODY_NONE) ? joint.distal : self->probe.other;
    if (!ticks_of(self, &joint, ticks)) {
        return SAMPLE_UNITS;
    }
    jcal_body_probe_add(self, ticks[0], ticks[1]);
    return LAG_UNITS;
}

/// The ticks of one joint; then those of the joint whose lag is looked for, and the end of the round.
static unsigned step_add(jcal_body_t *self)
{
    jcal_body_round_t *const round = &self->round;
    while (round->at < self->table.joint_count) {
        const unsigned j = round->at;
        round->at = (uint8_t)(round->at + 1u);
        if (add_to_joint(self, j)) {
            return TICK_UNITS;
        }
    }
    const unsigned units = add_to_lag(self);
    round->at = 0u;
    round->phase = (uint8_t)TAKE;
    round->number += 1u;
    self->slices_due = true;
    return units;
}

unsigned jcal_body_round_step(jcal_body_t *self)
{
    switch (self->round.phase) {
    case TAKE:
        return step_take(self);
    case SAMPLE:
        return step_sample(self);
    case ADD:
    default:
        return step_add(self);
    }
}

void jcal_body_round_listen(jcal_body_t *self)
{
    for (unsigned s = 0u; s < self->table.sensor_count; ++s) {
        jcal_body_sensor_t *const sensor = &self->table.sensor_states[s];
        if (sensor->is_heard && (self->round.now_us > (sensor->heard_us + SILENT_US + self->pace.wait_us))) {
            sensor->is_heard = false;
            jcal_body_tell_sensor(self, s, JCAL_BODY_SENSOR_LOST, 0u, 0.0f);
        }
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// A whole body: preparation, the budget of work, and what is told. See body.h.
#include "jointcal/body.h"

#include "body/engine.h"
#include "body/events.h"
#include "body/exam.h"
#include "body/look.h"
#include "body/probe.h"
#include "body/report.h"
#include "body/restore.h"
#include "body/round.h"
#include "math/clear.h"

#include <stddef.h>

#define MICROSECONDS 1e-6f

/// Ticks from one look at a joint to the next: a quarter of a second.
#define LOOK_TICKS 5u
/// Hole after which the stage of a sensor takes its next sample for a gap, and time from tick to tick, s.
#define HOLE_S 0.15f
#define TICK_S 0.05f

/// Units of a slice, of a joint or of the lag, and of a look.
#define SLICE_UNITS 2u
#define LOOK_UNITS 1u
/// Of a kept calibration: a slice of its look, or its record.
#define KEPT_UNITS 2u

static uint32_t in_periods(float time_s, float period_s)
{
    return (uint32_t)((time_s / period_s) + 0.999f);
}

static void set_pace(jcal_body_pace_t *pace, const jcal_body_config_t *config)
{
    pace->gap_s = config->gap_s;
    pace->period_us = (uint32_t)((config->period_s / MICROSECONDS) + 0.5f);
    /* As the stage of a sensor has it: a tick is due when half a sample is lacking. */
    pace->stride = in_periods(TICK_S - (0.5f * config->period_s), config->period_s);
    pace->hole = in_periods(HOLE_S, config->period_s);
    pace->wait_us = (uint32_t)((config->wait_s / MICROSECONDS) + 0.5f);
    pace->examine = in_periods(config->examine_s, config->period_s);
}

static jcal_status_t begin_sensor(const jcal_body_table_t *table, unsigned s)
{
    const jcal_body_sensor_spec_t *const spec = &table->sensors[s];
    jcal_body_sensor_t *const state = &table->sensor_states[s];
    jcal_clear(state, sizeof *state);
    state->joint = JCAL_BODY_NONE;
    const jcal_status_t status = jcal_sensor_init(&state->stage);
    return (status == JCAL_OK) ? jcal_packets_init(&state->packets, spec->packets, spec->storage, spec->storage_bytes)
                               : status;
}

static void begin_joint(const jcal_body_table_t *table, unsigned j)
{
    const jcal_body_joint_spec_t *const spec = &table->joints[j];
    jcal_body_joint_t *const state = &table->joint_states[j];
    jcal_clear(state, sizeof *state);
    state->lag_bound_s = (table->shared == NULL) ? 0.0f : JCAL_LAG_UNKNOWN_S;
    table->sensor_states[spec->distal].joint = (uint8_t)j;
    jcal_body_engine_reset(spec);
}

jcal_status_t jcal_body_init(jcal_body_t *self, const jcal_body_table_t *table, const jcal_body_config_t *config)
{
    if ((self == NULL) || (config == NULL) || (jcal_body_table_check(table, NULL) != NULL)) {
        return JCAL_ERR_ARG;
    }
    if (jcal_body_config_check(config) != NULL) {
        return JCAL_ERR_CONFIG;
    }
    jcal_clear(self, sizeof *self);
    for (unsigned s = 0u; s < table->sensor_count; ++s) {
        const jcal_status_t status = begin_sensor(table, s);
        if (status != JCAL_OK) {
            return status;
        }
    }
    for (unsigned j = 0u; j < table->joint_count; ++j) {
        begin_joint(table, j);
    }
    self->table = *table;
    set_pace(&self->pace, config);
    self->probe.joint = JCAL_BODY_NONE;
    self->probe.other = JCAL_BODY_NONE;
    jcal_body_restore_begin(self);
    self->is_ready = true;
    return (table->health == NULL) ? JCAL_OK : jcal_health_init(table->health);
}

jcal_status_t jcal_body_push(jcal_body_t *self, unsigned sensor, const jcal_packet_t *packet)
{
    if ((self == NULL) || !self->is_ready || (sensor >= self->table.sensor_count)) {
        return JCAL_ERR_ARG;
    }
    return jcal_packets_push(&self->table.sensor_states[sensor].packets, packet);
}

/// A slice of a joint, or a look at it when it has none left; 0 if neither is due.
static unsigned step_joint(jcal_body_t *self, unsigned j)
{
    jcal_body_joint_t *const state = &self->table.joint_states[j];
    if (state->due) {
        if (jcal_body_engine_step(&self->table.joints[j])) {
            return SLICE_UNITS;
        }
        state->due = false;
    }
    if (state->ticks >= LOOK_TICKS) {
        state->ticks = 0u;
        jcal_body_look(self, j);
        return LOOK_UNITS;
    }
    return 0u;
}

/// Work for a joint, or, at their end, for kept calibrations, the lag and the examination.
static unsigned step_one(jcal_body_t *self, unsigned at)
{
    if (at < self->table.joint_count) {
        return step_joint(self, at);
    }
    if (at == self->table.joint_count) {
        return jcal_body_probe_step(self) ? SLICE_UNITS : 0u;
    }
    if (at == (self->table.joint_count + 1u)) {
        return jcal_body_restore_step(self) ? KEPT_UNITS : 0u;
    }
    const bool looked = (at == (self->table.joint_count + 2u)) ? jcal_body_probe_look(self) : jcal_body_exam_look(self);
    return looked ? LOOK_UNITS : 0u;
}

/// The next slice of those that have waited longest; 0 if none is due.
static unsigned step_slice(jcal_body_t *self)
{
    const unsigned count = self->table.joint_count + 4u;
    for (unsigned k = 0u; k < count; ++k) {
        const unsigned at = self->next;
        self->next = (uint8_t)((at + 1u) % count);
        const unsigned units = step_one(self, at);
        if (units > 0u) {
            return units;
        }
    }
    return 0u;
}

static uint8_t within(uint8_t at, unsigned count, uint8_t otherwise)
{
    return (at < count) ? at : otherwise;
}

/// Indices that damaged memory may have put out of the caller's arrays.
static void stay_within(jcal_body_t *self)
{
    const unsigned joints = self->table.joint_count;
    jcal_body_restore_t *const restore = &self->restore;
    self->round.at = within(self->round.at, self->table.sensor_count, 0u);
    self->probe.joint = within(self->probe.joint, joints, JCAL_BODY_NONE);
    self->probe.other = within(self->probe.other, self->table.sensor_count, JCAL_BODY_NONE);
    self->exchange.joint = within(self->exchange.joint, joints, 0u);
    self->exchange.other = within(self->exchange.other, self->table.sensor_count, 0u);
    self->exchange.sensor1 = within(self->exchange.sensor1, self->table.sensor_count, 0u);
    self->exchange.sensor2 = within(self->exchange.sensor2, self->table.sensor_count, 0u);
    self->exam.sensor = within(self->exam.sensor, self->table.sensor_count, 0u);
    self->pace.period_us += (self->pace.period_us == 0u) ? 1u : 0u;
    restore->next = within(restore->next, JCAL_BODY_PLACES, 0u);
    restore->next_joint = within(restore->next_joint, joints, 0u);
    for (unsigned p = 0u; p < JCAL_BODY_PLACES; ++p) {
        restore->joint[p] = within(restore->joint[p], joints, JCAL_BODY_NONE);
    }
}

jcal_status_t jcal_body_step(jcal_body_t *self, uint64_t now_us, unsigned units)
{
    if ((self == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    stay_within(self);
    jcal_body_round_now(self, now_us);
    bool has_rounds = true;
    unsigned left = units;
    while ((left >= JCAL_BODY_UNITS_MIN) && (has_rounds || self->slices_due)) { /* units go, or one of both ends */
        const bool slice = self->slices_due && (self->slices_next || !has_rounds);
        const unsigned took = slice ? step_slice(self) : jcal_body_round_step(self);
        self->slices_next = !slice;
        self->slices_due = self->slices_due && (!slice || (took > 0u));
        has_rounds = has_rounds && (slice || (took > 0u));
        left -= took;
    }
    self->units += units - left;
    if (has_rounds || self->slices_due) {
        return JCAL_OK;
    }
    jcal_body_round_listen(self);
    return JCAL_IDLE;
}

jcal_status_t jcal_body_event(jcal_body_t *self, jcal_body_event_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    return jcal_body_events_take(&self->events, out) ? JCAL_OK : JCAL_IDLE;
}

jcal_status_t jcal_body_sleep(jcal_body_t *self, unsigned joint, bool asleep)
{
    if ((self == NULL) || !self->is_ready || (joint >= self->table.joint_count)) {
        return JCAL_ERR_ARG;
    }
    const jcal_body_joint_spec_t *const spec = &self->table.joints[joint];
    if (spec->kind != JCAL_BODY_HINGE) {
        return asleep ? JCAL_REJECTED : JCAL_OK;
    }
    return jcal_functional_sleep(spec->engine.hinge, asleep);
}

bool jcal_body_sleeps(const jcal_body_t *self, unsigned joint)
{
    return (self != NULL) && self->is_ready && (joint < self->table.joint_count) &&
           jcal_body_engine_sleeps(&self->table.joints[joint]);
}

/// True if the stage's orientation is of the epoch from which the joint's engine took its last tick: after a gap its heading is another.
static bool is_of_epoch(const jcal_body_sensor_t *sensor, uint32_t epoch)
{
    const jcal_tick_t *const tick = jcal_sensor_tick(&sensor->stage);
    return (tick != NULL) && (tick->epoch == epoch);
}

jcal_status_t jcal_body_joint(const jcal_body_t *self, unsigned joint, jcal_body_joint_result_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready || (joint >= self->table.joint_count)) {
        return JCAL_ERR_ARG;
    }
    const jcal_body_joint_spec_t *const spec = &self->table.joints[joint];
    const jcal_body_sensor_t *const sensor1 = &self->table.sensor_states[spec->proximal];
    const jcal_body_sensor_t *const sensor2 = &self->table.sensor_states[spec->distal];
    jcal_body_report(self, joint, out);
    const jcal_body_joint_t *const state = &self->table.joint_states[joint];
    const bool goes_on = is_of_epoch(sensor1, state->epoch1) && is_of_epoch(sensor2, state->epoch2);
    if ((out->head.status == JCAL_READY) && (sensor1->line.last == sensor2->line.last) && goes_on &&
        out->heading.known) {
        const jcal_quat_t q1 = jcal_sensor_orientation(&sensor1->stage);
        const jcal_quat_t q2 = jcal_sensor_orientation(&sensor2->stage);
        out->flexion_rad = jcal_body_engine_flexion(spec, q1, q2);
        out->relative = jcal_body_engine_relative(spec, q1, q2);
    }
    return JCAL_OK;
}

jcal_status_t jcal_body_sensor(const jcal_body_t *self, unsigned sensor, jcal_body_sensor_result_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready || (sensor >= self->table.sensor_count)) {
        return JCAL_ERR_ARG;
    }
    const jcal_body_sensor_t *const state = &self->table.sensor_states[sensor];
    (void)jcal_packets_get(&state->packets, &out->packets);
    out->shift_s = (float)state->shift_us * MICROSECONDS;
    out->samples = state->samples;
    out->missed = state->missed;
    out->rejected = state->rejected;
    out->late = state->late;
    out->bad = state->bad;
    out->is_heard = state->is_heard;
    out->orientation = jcal_sensor_orientation(&state->stage);
    out->t_us =
        (state->line.last == 0u) ? 0u : (((uint64_t)state->line.last * self->pace.period_us) + self->round.origin_us);
    return JCAL_OK;
}

jcal_status_t jcal_body_status(const jcal_body_t *self, jcal_body_status_t *out)
{
    if ((self == NULL) || (out == NULL) || !self->is_ready) {
        return JCAL_ERR_ARG;
    }
    const jcal_body_status_t status = {
        .rounds = self->rounds,
        .restarts = self->restarts,
        .lags_refused = self->lags_refused,
        .events_dropped = self->events.dropped,
        .units = self->units,
        .t_us = self->round.has_begun ? jcal_body_time(self) : 0u,
    };
    *out = status;
    return JCAL_OK;
}

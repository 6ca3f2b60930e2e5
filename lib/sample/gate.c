/* SPDX-License-Identifier: MIT */
/// @file
/// Checks of single sample pairs. See gate.h.
#include "sample/gate.h"

#include "math/scalar.h"
#include "sample/clock.h"
#include "sample/sensor.h"

#include <stddef.h>

/// Shares of bad samples that may be lived with: a peak that touches the range now and then, a short dropout.
#define BAD_SHARE_MAX 0.2f
#define BAD_TIME_S 2.0f
#define BAD_STEP 0.02f
#define SATURATED_SHARE_MAX 0.01f
#define SATURATED_TIME_S 10.0f

jcal_gate_config_t jcal_gate_config_default(void)
{
    const jcal_gate_config_t config = {36.0f, 320.0f, 0.3f, 0.25f};
    return config;
}

const char *jcal_gate_config_check(const jcal_gate_config_t *config)
{
    if (config == NULL) {
        return "config";
    }
    if (!jcal_within(config->gyr_max_rad_s, 1.0f, 200.0f)) {
        return "gate.gyr_max_rad_s";
    }
    if (!jcal_within(config->acc_max_m_s2, 20.0f, 4000.0f)) {
        return "gate.acc_max_m_s2";
    }
    if (!jcal_within(config->frozen_s, 0.02f, 10.0f)) {
        return "gate.frozen_s";
    }
    if (!jcal_within(config->gap_s, 0.02f, 10.0f)) {
        return "gate.gap_s";
    }
    return NULL;
}

void jcal_gate_init(jcal_gate_t *self)
{
    if (self != NULL) {
        *self = (jcal_gate_t){0};
    }
}

/// Weight of a new value in an average over `time_s`.
static float share_of(float dt_s, float time_s)
{
    return dt_s / (dt_s + time_s);
}

static jcal_reject_t check_values(jcal_gate_t *self, const jcal_gate_config_t *cfg, const jcal_pair_t *pair, float dt_s)
{
    if (!self->turn.has_first) {
        self->turn.has_first = true;
        const jcal_reject_t first = jcal_gate_sensor_begin(&self->sensor1, cfg, &pair->imu1);
        const jcal_reject_t second = jcal_gate_sensor_begin(&self->sensor2, cfg, &pair->imu2);
        return (first < second) ? first : second;
    }
    jcal_gate_sensor_follow_turn(&self->turn, &self->sensor1, &self->sensor2, pair, dt_s);
    const jcal_reject_t first = jcal_gate_sensor_check(&self->sensor1, cfg, &pair->imu1, dt_s);
    const jcal_reject_t second = jcal_gate_sensor_check(&self->sensor2, cfg, &pair->imu2, dt_s);
    const jcal_reject_t cause = (first < second) ? first : second;
    const float bad = ((cause == JCAL_REJECT_OUT_OF_RANGE) || (cause == JCAL_REJECT_FROZEN)) ? 1.0f : 0.0f;
    const float saturated = (cause == JCAL_REJECT_SATURATED) ? 1.0f : 0.0f;
    self->bad_share += share_of(dt_s, BAD_TIME_S) * (bad - self->bad_share);
    self->saturated_share += share_of(dt_s, SATURATED_TIME_S) * (saturated - self->saturated_share);
    return cause;
}

/// Extremes fade once in 2^20 us, by the clock, so that nothing need be counted.
static void fade(jcal_gate_t *self, uint64_t before_us)
{
    if ((self->clock.last_us >> 20) != (before_us >> 20)) {
        jcal_gate_sensor_fade(&self->sensor1);
        jcal_gate_sensor_fade(&self->sensor2);
    }
}

static jcal_reject_t check_finite(jcal_gate_t *self, const jcal_gate_config_t *cfg, const jcal_pair_t *pair)
{
    float dt_s;
    const uint64_t before_us = self->clock.last_us;
    jcal_reject_t cause = jcal_clock_check(&self->clock, cfg->gap_s, pair->t_us, &dt_s);
    if (cause == JCAL_REJECT_NONE) {
        cause = check_values(self, cfg, pair, dt_s);
        fade(self, before_us);
        return cause;
    }
    if (cause == JCAL_REJECT_GAP) {
        jcal_gate_sensor_start(&self->sensor1, &pair->imu1);
        jcal_gate_sensor_start(&self->sensor2, &pair->imu2);
        self->turn.sensor = 0u;
    }
    const float share = (dt_s > 0.0f) ? share_of(dt_s, BAD_TIME_S) : BAD_STEP; /* no believable time may have passed */
    self->bad_share += share * (1.0f - self->bad_share);
    return cause;
}

jcal_reject_t jcal_gate_check(jcal_gate_t *self, const jcal_gate_config_t *config, const jcal_pair_t *pair)
{
    if ((self == NULL) || (config == NULL) || (pair == NULL)) {
        return JCAL_REJECT_NOT_FINITE;
    }
    jcal_reject_t cause = JCAL_REJECT_NOT_FINITE;
    self->samples += 1u;
    if (jcal_gate_sensor_is_finite(&pair->imu1) && jcal_gate_sensor_is_finite(&pair->imu2)) {
        cause = check_finite(self, config, pair);
    } else {
        self->bad_share += BAD_STEP * (1.0f - self->bad_share);
    }
    if (cause != JCAL_REJECT_NONE) {
        self->rejected_by[cause] += 1u;
    }
    return cause;
}

void jcal_gate_refuse(jcal_gate_t *self, jcal_reject_t cause)
{
    self->samples += 1u;
    self->rejected_by[cause] += 1u;
    self->bad_share += BAD_STEP * (1.0f - self->bad_share);
}

jcal_reason_t jcal_gate_complaint(const jcal_gate_t *self)
{
    if (self == NULL) {
        return JCAL_REASON_NONE;
    }
    if (jcal_clock_is_slow(&self->clock)) {
        return JCAL_REASON_RATE_TOO_LOW;
    }
    if (!self->turn.has_first) {
        return (self->bad_share > BAD_SHARE_MAX) ? JCAL_REASON_BAD_SAMPLES : JCAL_REASON_NONE;
    }
    if (jcal_gate_sensor_acc_looks_wrong(&self->sensor1) || jcal_gate_sensor_acc_looks_wrong(&self->sensor2)) {
        return JCAL_REASON_WRONG_UNITS_ACC;
    }
    if (jcal_gate_sensor_gyr_looks_wrong(&self->sensor1) || jcal_gate_sensor_gyr_looks_wrong(&self->sensor2)) {
        return JCAL_REASON_WRONG_UNITS_GYR;
    }
    const bool bad = (self->bad_share > BAD_SHARE_MAX) || (self->saturated_share > SATURATED_SHARE_MAX);
    return bad ? JCAL_REASON_BAD_SAMPLES : JCAL_REASON_NONE;
}

const char *jcal_reject_string(jcal_reject_t reject)
{
    switch (reject) {
    case JCAL_REJECT_NOT_FINITE:
        return "not_finite";
    case JCAL_REJECT_OUT_OF_RANGE:
        return "out_of_range";
    case JCAL_REJECT_SATURATED:
        return "saturated";
    case JCAL_REJECT_FROZEN:
        return "frozen";
    case JCAL_REJECT_REPEATED:
        return "repeated";
    case JCAL_REJECT_TIME_ORDER:
        return "time_order";
    case JCAL_REJECT_GAP:
        return "gap";
    case JCAL_REJECT_NONE:
        return "accepted";
    default:
        return "unknown";
    }
}

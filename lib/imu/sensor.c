/* SPDX-License-Identifier: MIT */
/// @file
/// The sensor stage. See sensor.h.
#include "jointcal/sensor.h"

#include "imu/attitude.h"
#include "imu/bias.h"
#include "imu/features.h"
#include "imu/turn.h"
#include "jointcal/vec3.h"
#include "math/clear.h"
#include "sample/clock.h"

#include <stddef.h>

#define MICROSECONDS 1e-6f

/// Longest distance of two samples that go on from each other, s.
#define GAP_S JCAL_CLOCK_SLOW_S
/// A tick is due after this, less half a sample, us.
#define TICK_US 50000u
/// Time constant of what rest is told by, s.
#define REST_TAU_S 0.5f

jcal_status_t jcal_sensor_init(jcal_sensor_t *self)
{
    if (self == NULL) {
        return JCAL_ERR_ARG;
    }
    jcal_clear(self, sizeof *self);
    self->attitude.q_s_e = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    jcal_bias_begin(&self->bias);
    return JCAL_OK;
}

/// Not so for NaN.
static bool is_within(jcal_vec3_t v, float limit)
{
    return (fabsf(v.x) <= limit) && (fabsf(v.y) <= limit) && (fabsf(v.z) <= limit);
}

bool jcal_sensor_may_take(const jcal_imu_t *imu)
{
    return is_within(imu->gyr_rad_s, JCAL_SENSOR_GYR_MAX_RAD_S) && is_within(imu->acc_m_s2, JCAL_SENSOR_ACC_MAX_M_S2);
}

/// A reading less the bias of the gyroscope.
static jcal_imu_t unbiased(const jcal_sensor_t *self, const jcal_imu_t *imu)
{
    const jcal_imu_t out = {jcal_vec3_sub(imu->gyr_rad_s, self->bias.bias_rad_s), imu->acc_m_s2};
    return out;
}

static void begin_epoch(jcal_sensor_t *self, const jcal_reading_t *reading)
{
    const jcal_imu_t imu = unbiased(self, &reading->imu);
    float r[9];
    jcal_attitude_begin(&self->attitude, imu.gyr_rad_s, imu.acc_m_s2);
    jcal_turn_matrix(self->attitude.q_s_e, r);
    jcal_bias_restart(&self->bias, &reading->imu);
    jcal_features_begin(&self->features, r, &imu, jcal_turn_times(r, imu.acc_m_s2));
    self->tick_us = reading->t_us;
    self->has_tick = false;
}

static void set_sample_rates(jcal_sample_rates_t *rates, uint32_t dt_us)
{
    if (rates->dt_us == dt_us) {
        return;
    }
    rates->dt_us = dt_us;
    rates->dt_s = (float)dt_us * MICROSECONDS;
    rates->rest = rates->dt_s / (rates->dt_s + REST_TAU_S);
    jcal_features_set_sample(rates);
}

static void set_tick_rates(jcal_tick_rates_t *rates, uint32_t dt_us)
{
    if (rates->dt_us == dt_us) {
        return;
    }
    rates->dt_us = dt_us;
    rates->dt_s = (float)dt_us * MICROSECONDS;
    jcal_lowpass_set(rates->level, rates->dt_s);
    jcal_features_set_tick(rates);
}

/// Levels the orientation; `r` and `force` become those of the corrected one.
static void level(jcal_sensor_t *self, jcal_vec3_t acc_m_s2, float r[9], jcal_vec3_t *force)
{
    const jcal_tick_rates_t *const rates = &self->tick;
    jcal_vec3_t correction;
    const jcal_lowpass_t by = jcal_lowpass_for(rates->level, self->features.tick.since_s, rates->dt_s);
    const bool corrected = jcal_attitude_level(&self->attitude, &by, rates->dt_s, &correction);
    jcal_turn_matrix(self->attitude.q_s_e, r);
    *force = jcal_turn_times(r, acc_m_s2);
    jcal_bias_tick(&self->bias, rates->dt_s, &by, r, corrected ? &correction : NULL);
}

/// A sample that goes on from the last one.
static jcal_status_t go_on(jcal_sensor_t *self, const jcal_reading_t *reading, uint32_t dt_us)
{
    const uint32_t since_us = (uint32_t)(reading->t_us - self->tick_us);
    const bool due = ((2u * since_us) + dt_us) >= (2u * TICK_US);
    set_sample_rates(&self->sample, dt_us);
    jcal_bias_sample(&self->bias, &reading->imu, &self->sample);
    const jcal_imu_t imu = unbiased(self, &reading->imu);
    float r[9];
    jcal_vec3_t force = jcal_attitude_turn(&self->attitude, imu.gyr_rad_s, imu.acc_m_s2, self->sample.dt_s, r);
    if (due) {
        set_tick_rates(&self->tick, since_us);
        level(self, imu.acc_m_s2, r, &force);
    }
    if (!self->has_tick && (since_us == dt_us)) {
        jcal_features_second(&self->features, &self->sample);
    }
    jcal_features_sample(&self->features, &self->sample, r, &imu, force);
    if (due) {
        jcal_features_tick(&self->features, &self->tick, r);
        self->features.tick.t_us = reading->t_us;
        self->tick_us = reading->t_us;
        self->has_tick = true;
    }
    return due ? JCAL_TICK : JCAL_OK;
}

jcal_status_t jcal_sensor_push(jcal_sensor_t *self, const jcal_reading_t *reading)
{
    if ((self == NULL) || (reading == NULL) || !(self->bias.p[0] > 0.0f)) {
        return JCAL_ERR_ARG; /* a variance is zero only where all is: before init */
    }
    const uint64_t dt_us = reading->t_us - self->last_us; /* huge if time goes back */
    if (!jcal_sensor_may_take(&reading->imu) || (self->has_last && (dt_us == 0u))) {
        return JCAL_REJECTED;
    }
    self->last_us = reading->t_us;
    if (!self->has_last || (dt_us > UINT32_MAX) || !(((float)(uint32_t)dt_us * MICROSECONDS) <= GAP_S)) {
        self->has_last = true;
        begin_epoch(self, reading);
        return JCAL_OK;
    }
    return go_on(self, reading, (uint32_t)dt_us);
}

const jcal_tick_t *jcal_sensor_tick(const jcal_sensor_t *self)
{
    return ((self != NULL) && self->has_tick) ? &self->features.tick : NULL;
}

jcal_quat_t jcal_sensor_orientation(const jcal_sensor_t *self)
{
    if (self == NULL) {
        return jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    }
    const float ahead_s = self->has_last ? (0.5f * self->sample.dt_s) : 0.0f;
    const jcal_quat_t ahead = jcal_turn_by(jcal_vec3_scale(self->attitude.gyr_rad_s, ahead_s));
    return jcal_quat_normalise(jcal_quat_mul(self->attitude.q_s_e, ahead));
}

jcal_vec3_t jcal_sensor_gyr_bias(const jcal_sensor_t *self)
{
    return (self != NULL) ? self->bias.bias_rad_s : jcal_vec3(0.0f, 0.0f, 0.0f);
}

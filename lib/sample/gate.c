/* SPDX-License-Identifier: MIT */
/// @file
/// Checks of single sample pairs. See gate.h.
#include "jointcal/gate.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <math.h>
#include <stddef.h>

#define MICROSECONDS 1e-6f

/// The mean magnitude of the specific force lies near 9.81 m/s^2 in any motion of a person; in g it is near 1.
#define GRAVITY_MIN_M_S2 4.0f
#define GRAVITY_MAX_M_S2 40.0f
#define GRAVITY_TIME_S 1.0f

/// With rates in rad/s the specific force changes at least about as much as the rates alone would turn it; with deg/s
/// it changes 57 times less, 3283 times less in energy. The limit lies between, in the geometric middle of 1 and 1 /
/// 3283.
#define TURN_SHARE_MIN 0.02f
/// Energy that must have been expected before the share is believed, (m/s^2)^2.
#define TURN_EXPECTED_MIN 200.0f
#define TURN_TIME_S 2.0f

/// A component that stands at its extreme is clipped, if the extreme is more than noise at rest can be.
#define GYR_CLIP_MIN_RAD_S 0.2f
#define ACC_CLIP_MIN_M_S2 2.0f

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
    *self = (jcal_gate_t){0};
}

static bool is_finite(const jcal_imu_t *imu)
{
    return jcal_vec3_is_finite(imu->gyr_rad_s) && jcal_vec3_is_finite(imu->acc_m_s2);
}

static void unpack(const jcal_imu_t *imu, float out[6])
{
    out[0] = imu->gyr_rad_s.x;
    out[1] = imu->gyr_rad_s.y;
    out[2] = imu->gyr_rad_s.z;
    out[3] = imu->acc_m_s2.x;
    out[4] = imu->acc_m_s2.y;
    out[5] = imu->acc_m_s2.z;
}

/// Weight of a new value in an average over `time_s`.
static float share_of(float dt_s, float time_s)
{
    return dt_s / (dt_s + time_s);
}

static bool exceeds(const float v[3], float limit)
{
    return (fabsf(v[0]) > limit) || (fabsf(v[1]) > limit) || (fabsf(v[2]) > limit);
}

/// A sample beside the one before.
typedef struct {
    bool repeated;  ///< All components are the same.
    /// Some component stands still at the largest magnitude it ever had while the sensor turns; at rest a coarse reading repeats itself
    /// and is not clipped.
    bool clipped;
} likeness_t;

static likeness_t compare(const jcal_gate_sensor_t *sensor, const float now[6])
{
    likeness_t out = {true, false};
    for (unsigned i = 0u; i < 6u; ++i) {
        if (now[i] == sensor->last[i]) {
            const float least = (i < 3u) ? GYR_CLIP_MIN_RAD_S : ACC_CLIP_MIN_M_S2;
            const float magnitude = fabsf(now[i]);
            out.clipped = out.clipped || ((magnitude >= sensor->extreme[i]) && (magnitude > least));
        } else {
            out.repeated = false;
        }
    }
    out.clipped = out.clipped && exceeds(&now[0], GYR_CLIP_MIN_RAD_S);
    return out;
}

static bool is_beyond(const jcal_gate_config_t *cfg, const float now[6])
{
    return exceeds(&now[0], cfg->gyr_max_rad_s) || exceeds(&now[3], cfg->acc_max_m_s2);
}

/// Follows the mean magnitude of the specific force, and how much it changes beside what the rate would make of it.
static void follow(jcal_gate_sensor_t *sensor, const jcal_imu_t *imu, float dt_s)
{
    const jcal_vec3_t before = jcal_vec3(sensor->last[3], sensor->last[4], sensor->last[5]);
    const jcal_vec3_t change = jcal_vec3_sub(imu->acc_m_s2, before);
    const jcal_vec3_t expected = jcal_vec3_scale(jcal_vec3_cross(imu->acc_m_s2, imu->gyr_rad_s), dt_s);
    const float keep = 1.0f - share_of(dt_s, TURN_TIME_S);
    sensor->turn_measured = (keep * sensor->turn_measured) + jcal_vec3_dot(change, change);
    sensor->turn_expected = (keep * sensor->turn_expected) + jcal_vec3_dot(expected, expected);
    sensor->gravity_m_s2 += share_of(dt_s, GRAVITY_TIME_S) * (jcal_vec3_norm(imu->acc_m_s2) - sensor->gravity_m_s2);
}

static void remember(jcal_gate_sensor_t *sensor, const float now[6])
{
    for (unsigned i = 0u; i < 6u; ++i) {
        sensor->last[i] = now[i];
        const float magnitude = fabsf(now[i]);
        if (magnitude > sensor->extreme[i]) {
            sensor->extreme[i] = magnitude;
        }
    }
}

static bool acc_looks_wrong(const jcal_gate_sensor_t *sensor)
{
    return !jcal_within(sensor->gravity_m_s2, GRAVITY_MIN_M_S2, GRAVITY_MAX_M_S2);
}

static bool gyr_looks_wrong(const jcal_gate_sensor_t *sensor)
{
    return (sensor->turn_expected > TURN_EXPECTED_MIN) &&
           (sensor->turn_measured < (TURN_SHARE_MIN * sensor->turn_expected));
}

/// The checks that need no predecessor but that of the clock.
static jcal_reject_t check_time(const jcal_gate_t *self, const jcal_gate_config_t *cfg, uint64_t t_us)
{
    if (!self->has_last) {
        return JCAL_REJECT_NONE;
    }
    if (t_us <= self->last_us) {
        return JCAL_REJECT_TIME_ORDER;
    }
    const float dt_s = (float)(t_us - self->last_us) * MICROSECONDS;
    return (dt_s > cfg->gap_s) ? JCAL_REJECT_GAP : JCAL_REJECT_NONE;
}

/// Takes in a continuous, finite sample; the first sample ever has no predecessor.
static jcal_reject_t check_sensor(const jcal_gate_config_t *cfg, jcal_gate_sensor_t *sensor, const jcal_imu_t *imu,
                                  float dt_s)
{
    float now[6];
    unpack(imu, now);
    const likeness_t like = compare(sensor, now);
    sensor->repeated_s = like.repeated ? (sensor->repeated_s + dt_s) : 0.0f;
    if (exceeds(&now[3], cfg->acc_max_m_s2)) {
        return JCAL_REJECT_OUT_OF_RANGE; /* no force that a sensor feels: nothing to learn of gravity or of its range */
    }
    follow(sensor, imu, dt_s);
    remember(sensor, now);
    if (is_beyond(cfg, now) || acc_looks_wrong(sensor) || gyr_looks_wrong(sensor)) {
        return JCAL_REJECT_OUT_OF_RANGE;
    }
    if (like.clipped && !like.repeated) {
        return JCAL_REJECT_SATURATED;
    }
    if (sensor->repeated_s > cfg->frozen_s) {
        return JCAL_REJECT_FROZEN;
    }
    return like.repeated ? JCAL_REJECT_REPEATED : JCAL_REJECT_NONE;
}

/// The first sample, and the first one after a hole: nothing to compare with.
static void start_sensor(jcal_gate_sensor_t *sensor, const jcal_imu_t *imu)
{
    float now[6];
    unpack(imu, now);
    remember(sensor, now);
    sensor->gravity_m_s2 = jcal_vec3_norm(imu->acc_m_s2);
    sensor->repeated_s = 0.0f;
}

static jcal_reject_t check_values(jcal_gate_t *self, const jcal_gate_config_t *cfg, const jcal_pair_t *pair)
{
    if (!self->has_last) {
        self->has_last = true;
        start_sensor(&self->sensor1, &pair->imu1);
        start_sensor(&self->sensor2, &pair->imu2);
        const bool wrong = acc_looks_wrong(&self->sensor1) || acc_looks_wrong(&self->sensor2) ||
                           is_beyond(cfg, self->sensor1.last) || is_beyond(cfg, self->sensor2.last);
        return wrong ? JCAL_REJECT_OUT_OF_RANGE : JCAL_REJECT_NONE;
    }
    const float dt_s = (float)(pair->t_us - self->last_us) * MICROSECONDS;
    const jcal_reject_t first = check_sensor(cfg, &self->sensor1, &pair->imu1, dt_s);
    const jcal_reject_t second = check_sensor(cfg, &self->sensor2, &pair->imu2, dt_s);
    const jcal_reject_t cause = (first < second) ? first : second;
    const float bad = ((cause == JCAL_REJECT_OUT_OF_RANGE) || (cause == JCAL_REJECT_FROZEN)) ? 1.0f : 0.0f;
    const float saturated = (cause == JCAL_REJECT_SATURATED) ? 1.0f : 0.0f;
    self->bad_share += share_of(dt_s, BAD_TIME_S) * (bad - self->bad_share);
    self->saturated_share += share_of(dt_s, SATURATED_TIME_S) * (saturated - self->saturated_share);
    return cause;
}

jcal_reject_t jcal_gate_check(jcal_gate_t *self, const jcal_gate_config_t *config, const jcal_pair_t *pair)
{
    self->samples += 1u;
    jcal_reject_t cause = JCAL_REJECT_NOT_FINITE;
    if (is_finite(&pair->imu1) && is_finite(&pair->imu2)) {
        cause = check_time(self, config, pair->t_us);
        if (cause == JCAL_REJECT_GAP) {
            start_sensor(&self->sensor1, &pair->imu1);
            start_sensor(&self->sensor2, &pair->imu2);
        }
        if (cause == JCAL_REJECT_NONE) {
            cause = check_values(self, config, pair);
        }
        if (cause != JCAL_REJECT_TIME_ORDER) {
            self->last_us = pair->t_us;
        }
    }
    if (cause != JCAL_REJECT_NONE) {
        self->rejected_by[cause] += 1u;
    }
    if ((cause == JCAL_REJECT_NOT_FINITE) || (cause == JCAL_REJECT_TIME_ORDER) || (cause == JCAL_REJECT_GAP)) {
        self->bad_share += BAD_STEP * (1.0f - self->bad_share); /* no believable time has passed */
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
    if (!self->has_last) {
        return (self->bad_share > BAD_SHARE_MAX) ? JCAL_REASON_BAD_SAMPLES : JCAL_REASON_NONE;
    }
    if (acc_looks_wrong(&self->sensor1) || acc_looks_wrong(&self->sensor2)) {
        return JCAL_REASON_WRONG_UNITS_ACC;
    }
    if (gyr_looks_wrong(&self->sensor1) || gyr_looks_wrong(&self->sensor2)) {
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

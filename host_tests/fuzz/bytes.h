/* SPDX-License-Identifier: MIT */
/* What the fuzzers share: how bytes are read as samples, and how promises are checked. */
#ifndef FUZZ_BYTES_H
#define FUZZ_BYTES_H

#include "jointcal/head.h"
#include "jointcal/tick.h"
#include "jointcal/types.h"
#include "jointcal/vec3.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

/* How the bytes of a sample are read: anything at all, or values of a sensor's range, which get past the gate. */
typedef enum { AS_FLOATS, AS_SENSOR } reading_t;

static inline void require(bool condition)
{
    if (!condition) {
        abort();
    }
}

/* Written so that NaN fails. */
static inline void require_within(float value, float low, float high)
{
    require(value >= low && value <= high);
}

static inline bool is_unit(jcal_vec3_t axis)
{
    return fabsf(jcal_vec3_norm(axis) - 1.0f) < 1e-4f;
}

static inline bool is_zero(jcal_vec3_t v)
{
    return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f;
}

/* One 16-bit value as a float: its bits spread over all exponents, or scaled to the range. */
static inline float component(const uint8_t *data, reading_t reading, float range)
{
    int16_t raw;
    memcpy(&raw, data, sizeof raw);
    if (reading == AS_SENSOR) {
        return range * (float)raw / 32768.0f;
    }
    const uint32_t bits = (uint32_t)(uint16_t)raw << 16;
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline jcal_vec3_t vector(const uint8_t *data, reading_t reading, float range)
{
    return jcal_vec3(component(data, reading, range), component(data + 2, reading, range),
                     component(data + 4, reading, range));
}

/* 12 bytes: rates to `gyr_range` rad/s, specific force to `acc_range` m/s^2. */
static inline jcal_imu_t imu_at(const uint8_t *data, reading_t reading, float gyr_range, float acc_range)
{
    const jcal_imu_t imu = {vector(data, reading, gyr_range), vector(data + 6, reading, acc_range)};
    return imu;
}

/* 2 bytes of time step, us: of a sensor at least `least`; else mostly forward, now and then backward or not at all. */
static inline uint64_t step_of(const uint8_t *data, reading_t reading, unsigned least)
{
    uint16_t step;
    memcpy(&step, data, sizeof step);
    return (reading == AS_SENSOR) ? least + step % 40000u : (uint64_t)(int64_t)(int16_t)step * 100u;
}

#define TICK_BYTES 138u /* 2 bytes of time step, 2 x (1 of epoch, 67 of values) */

static inline jcal_tick_t tick_at(const uint8_t *data, reading_t reading, uint64_t t_us, float dt_s)
{
    jcal_tick_t out = {0};
    out.t_us = t_us;
    out.dt_s = dt_s;
    out.epoch = data[0] / 250u;
    const uint8_t *at = data + 1;
    for (size_t k = 0; k < 9; k++) {
        out.turn[k] = component(at + 2 * k, reading, 1.0f);
        out.rate[k] = component(at + 18 + 2 * k, reading, 5.0f);
        out.lever[k] = component(at + 36 + 2 * k, reading, 5.0f);
    }
    out.velocity = vector(at + 54, reading, 2.0f);
    out.gyr = vector(at + 60, reading, 5.0f);
    out.acc_level_m_s2 = 9.81f;
    return out;
}

/* What every result begins with has words for it; a reason is given exactly where something is missing. */
static inline void require_words(const jcal_head_t *head)
{
    require(head->status >= JCAL_COLLECTING && head->status <= JCAL_MOVED);
    require(jcal_calibration_string(head->status) != NULL);
    const bool ready = head->status == JCAL_READY;
    require(ready == (head->reason == JCAL_REASON_NONE) && ready == (jcal_reason_string(head->reason) == NULL));
    require((head->weak == JCAL_WEAK_NONE) == (jcal_weak_string(head->weak) == NULL));
    require((head->hint == JCAL_HINT_NONE) == (jcal_hint_string(head->hint) == NULL));
    require(!ready || (head->weak == JCAL_WEAK_NONE && head->hint == JCAL_HINT_NONE));
    require((head->status == JCAL_AMBIGUOUS) == (head->reason == JCAL_REASON_SIGN_OPEN));
}

#endif /* FUZZ_BYTES_H */

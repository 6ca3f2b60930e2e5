/* SPDX-License-Identifier: MIT */
/// @file
/// Filters that make the features. See imu/features.h.
#include "imu/features.h"

#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/decay.h"
#include "math/scalar.h"

#include <stddef.h>
#include <string.h>

#define GRAVITY_M_S2 9.81f

/// Cut-off frequencies, Hz.
#define SAMPLE_LOW_HZ 5.0f
#define TICK_HIGH_HZ 0.4f
#define TICK_LOW_HZ 3.0f

/// The mean of the vertical specific force is over all of an epoch, and then over this, s: a person's own acceleration averages out.
#define LEVEL_TAU_S 20.0f
#define SINCE_MAX_S 1000.0f

/// Places of the signals.
enum { Q = 0, V = 9, W = 12 };

/// Each row of R [w]x is that row x w.
static void rate_matrix(const float r[9], jcal_vec3_t w, float out[9])
{
    for (size_t i = 0u; i < 3u; ++i) {
        const float *const row = &r[3u * i];
        out[3u * i] = (row[1] * w.z) - (row[2] * w.y);
        out[(3u * i) + 1u] = (row[2] * w.x) - (row[0] * w.z);
        out[(3u * i) + 2u] = (row[0] * w.y) - (row[1] * w.x);
    }
}

void jcal_features_begin(jcal_features_t *self, const float r[9], const jcal_imu_t *imu, jcal_vec3_t force_m_s2)
{
    const uint32_t epoch = self->tick.epoch + 1u;
    const jcal_vec3_t w = imu->gyr_rad_s;
    float x[JCAL_FEATURE_SIGNALS] = {0.0f};
    jcal_clear(self, sizeof *self);
    rate_matrix(r, w, &x[Q]);
    x[W] = w.x;
    x[W + 1] = w.y;
    x[W + 2] = w.z;
    for (size_t i = 0u; i < JCAL_FEATURE_SIGNALS; ++i) {
        self->chain[i][0] = x[i];
        self->chain[i][1] = x[i];
        self->chain[i][2] = x[i];
    }
    self->way_m_s = jcal_vec3(0.5f * force_m_s2.x, 0.5f * force_m_s2.y, 0.5f * (force_m_s2.z - GRAVITY_M_S2));
    (void)memcpy(self->tick.rate, x, sizeof self->tick.rate);
    self->tick.epoch = epoch;
    self->tick.acc_level_m_s2 = GRAVITY_M_S2;
}

void jcal_features_set_sample(jcal_sample_rates_t *rates)
{
    rates->pole = jcal_taken_over(2.0f * JCAL_PI * SAMPLE_LOW_HZ * rates->dt_s);
}

void jcal_features_set_tick(jcal_tick_rates_t *rates)
{
    rates->high_keep = 1.0f - jcal_taken_over(2.0f * JCAL_PI * TICK_HIGH_HZ * rates->dt_s);
    rates->low_pole = jcal_taken_over(2.0f * JCAL_PI * TICK_LOW_HZ * rates->dt_s);
}

/// Three one-poles in series; returns what comes out.
static inline float put(float y[3], float x, float pole)
{
    y[0] += pole * (x - y[0]);
    y[1] += pole * (y[0] - y[1]);
    y[2] += pole * (y[1] - y[2]);
    return y[2];
}

/// The same; returns the sum of what came out before and what comes out now.
static inline float put_sum(float y[3], float x, float pole)
{
    const float before = y[2];
    return before + put(y, x, pole);
}

/// Takes in v before its low-pass.
static inline void add_way(jcal_features_t *self, const jcal_sample_rates_t *rates, jcal_vec3_t v)
{
    const float half_s = 0.5f * rates->dt_s;
    self->way_m_s.x += half_s * put_sum(self->chain[V], v.x, rates->pole);
    self->way_m_s.y += half_s * put_sum(self->chain[V + 1], v.y, rates->pole);
    self->way_m_s.z += half_s * put_sum(self->chain[V + 2], v.z, rates->pole);
}

void jcal_features_second(jcal_features_t *self, const jcal_sample_rates_t *rates)
{
    const jcal_vec3_t first = self->way_m_s;
    self->way_m_s = jcal_vec3(0.0f, 0.0f, 0.0f);
    add_way(self, rates, first);
}

void jcal_features_sample(jcal_features_t *self, const jcal_sample_rates_t *rates, const float r[9],
                          const jcal_imu_t *imu, jcal_vec3_t force_m_s2)
{
    const float pole = rates->pole;
    const jcal_vec3_t w = imu->gyr_rad_s;
    float x[9];
    rate_matrix(r, w, x);
    for (size_t i = 0u; i < 9u; ++i) {
        (void)put(self->chain[Q + i], x[i], pole);
    }
    add_way(self, rates, jcal_vec3(force_m_s2.x, force_m_s2.y, force_m_s2.z - GRAVITY_M_S2));
    (void)put(self->chain[W], w.x, pole);
    (void)put(self->chain[W + 1], w.y, pole);
    (void)put(self->chain[W + 2], w.z, pole);
}

/// A high-pass: h of x, which was `before`.
static inline float high(float *h, float change, float keep)
{
    const float before = *h;
    *h = keep * (before + change);
    return *h - before;
}

static void make_lever(jcal_features_t *self, const jcal_tick_rates_t *rates)
{
    float *const rate = self->tick.rate;
    float *const lever = self->tick.lever;
    for (size_t i = 0u; i < 9u; ++i) {
        float *const h = self->lever_high[i];
        const float now = self->chain[Q + i][2];
        const float first = high(&h[0], now - rate[i], rates->high_keep);
        const float second = high(&h[1], first, rates->high_keep);
        (void)high(&h[2], second, rates->high_keep);
        rate[i] = now;
        lever[i] += rates->low_pole * (h[2] - lever[i]);
    }
}

/// One component of U.
static float make_velocity(float h[3], float way_m_s, float before, const jcal_tick_rates_t *rates)
{
    const float u = high(&h[0], way_m_s, rates->high_keep);
    const float first = high(&h[1], u, rates->high_keep);
    (void)high(&h[2], first, rates->high_keep);
    return before + (rates->low_pole * (h[2] - before));
}

void jcal_features_tick(jcal_features_t *self, const jcal_tick_rates_t *rates, const float r[9])
{
    jcal_tick_t *const tick = &self->tick;
    make_lever(self, rates);
    jcal_vec3_t *const u = &tick->velocity;
    u->x = make_velocity(self->velocity_high[0], self->way_m_s.x, u->x, rates);
    u->y = make_velocity(self->velocity_high[1], self->way_m_s.y, u->y, rates);
    u->z = make_velocity(self->velocity_high[2], self->way_m_s.z, u->z, rates);
    const float since_s = jcal_min(tick->since_s, LEVEL_TAU_S);
    const float vertical = GRAVITY_M_S2 + (self->way_m_s.z / rates->dt_s);
    tick->acc_level_m_s2 += (rates->dt_s / (since_s + rates->dt_s)) * (vertical - tick->acc_level_m_s2);
    self->way_m_s = jcal_vec3(0.0f, 0.0f, 0.0f);
    (void)memcpy(tick->turn, r, sizeof tick->turn);
    tick->gyr = jcal_vec3(self->chain[W][2], self->chain[W + 1][2], self->chain[W + 2][2]);
    tick->dt_s = rates->dt_s;
    tick->since_s = jcal_min(tick->since_s + rates->dt_s, SINCE_MAX_S);
}

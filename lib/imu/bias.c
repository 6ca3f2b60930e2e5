/* SPDX-License-Identifier: MIT */
/// @file
/// Bias of a gyroscope. See imu/bias.h.
#include "imu/bias.h"

#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <stddef.h>

/// Standard deviations, rad/s: before anything is known; of the estimate in lasting motion; at lasting rest. [VQF] has 0.03 deg/s for the
/// last, which believes the first reading at once; people who sit or stand still sway by some 0.3 deg/s for seconds, and one such reading
/// every 2 s leaves 0.065 deg/s.
#define SIGMA_BEGIN (0.5f * JCAL_RAD_PER_DEG)
#define SIGMA_MOTION (0.1f * JCAL_RAD_PER_DEG)
#define SIGMA_REST (0.065f * JCAL_RAD_PER_DEG)
/// P of a bias that was just measured grows to (0.1 deg/s)^2 in this time, s.
#define FORGET_SIGMA (0.1f * JCAL_RAD_PER_DEG)
#define FORGET_S 100.0f
/// Largest bias, rad/s.
#define BIAS_MAX (2.0f * JCAL_RAD_PER_DEG)
/// How much less the vertical part counts.
#define VERTICAL_VARIANCE 1e4f

/// Rest: readings differ from their low-passed ones by less than this, rad/s and m/s^2, for this time, us. ([VQF]: 1.5 s; with one-poles
/// a slow turn of an arm by 1.5 deg/s passed for rest for 1.64 s.)
#define REST_GYR (2.0f * JCAL_RAD_PER_DEG)
#define REST_ACC 0.5f
#define REST_US 2000000u

void jcal_bias_begin(jcal_gyr_bias_t *self)
{
    jcal_clear(self, sizeof *self);
    self->p[0] = SIGMA_BEGIN * SIGMA_BEGIN;
    self->p[3] = SIGMA_BEGIN * SIGMA_BEGIN;
    self->p[5] = SIGMA_BEGIN * SIGMA_BEGIN;
}

void jcal_bias_restart(jcal_gyr_bias_t *self, const jcal_imu_t *imu)
{
    self->gyr_rad_s = imu->gyr_rad_s;
    self->acc_m_s2 = imu->acc_m_s2;
    self->rest_us = 0u;
    jcal_clear(self->turn_mean, sizeof self->turn_mean);
    jcal_clear(self->turn_slope, sizeof self->turn_slope);
    jcal_clear(self->part_mean, sizeof self->part_mean);
    jcal_clear(self->part_slope, sizeof self->part_slope);
}

static bool is_bias(jcal_vec3_t w)
{
    return (fabsf(w.x) <= BIAS_MAX) && (fabsf(w.y) <= BIAS_MAX) && (fabsf(w.z) <= BIAS_MAX);
}

void jcal_bias_sample(jcal_gyr_bias_t *self, const jcal_imu_t *imu, const jcal_sample_rates_t *rates)
{
    const jcal_vec3_t gyr = jcal_vec3_sub(imu->gyr_rad_s, self->gyr_rad_s);
    const jcal_vec3_t acc = jcal_vec3_sub(imu->acc_m_s2, self->acc_m_s2);
    self->gyr_rad_s = jcal_vec3_add(self->gyr_rad_s, jcal_vec3_scale(gyr, rates->rest));
    self->acc_m_s2 = jcal_vec3_add(self->acc_m_s2, jcal_vec3_scale(acc, rates->rest));
    const bool rests = (jcal_vec3_dot(gyr, gyr) < (REST_GYR * REST_GYR)) &&
                       (jcal_vec3_dot(acc, acc) < (REST_ACC * REST_ACC)) && is_bias(self->gyr_rad_s);
    const uint32_t lasts_us = (self->rest_us < REST_US) ? (self->rest_us + rates->dt_us) : REST_US;
    self->rest_us = rests ? lasts_us : 0u;
}

/// Noise of a reading every tick with which P, which grows by `growth` every tick, stays at sigma^2.
static float steady(float sigma, float growth)
{
    const float p = sigma * sigma;
    return p + (p * p / growth);
}

/// Takes in z = c b + noise, with the innovation z - c b.
static void update(jcal_gyr_bias_t *self, const float c[3], float innovation, float noise2)
{
    float *const p = self->p;
    const jcal_vec3_t pc = {(p[0] * c[0]) + (p[1] * c[1]) + (p[2] * c[2]),
                            (p[1] * c[0]) + (p[3] * c[1]) + (p[4] * c[2]),
                            (p[2] * c[0]) + (p[4] * c[1]) + (p[5] * c[2])};
    const float share = 1.0f / ((c[0] * pc.x) + (c[1] * pc.y) + (c[2] * pc.z) + noise2);
    const jcal_vec3_t gain = jcal_vec3_scale(pc, share);
    const float e = jcal_max(-BIAS_MAX, jcal_min(BIAS_MAX, innovation));
    self->bias_rad_s = jcal_vec3_add(self->bias_rad_s, jcal_vec3_scale(gain, e));
    p[0] -= gain.x * pc.x;
    p[1] -= gain.x * pc.y;
    p[2] -= gain.x * pc.z;
    p[3] -= gain.y * pc.y;
    p[4] -= gain.y * pc.z;
    p[5] -= gain.z * pc.z;
}

static float times(const float c[3], jcal_vec3_t b)
{
    return (c[0] * b.x) + (c[1] * b.y) + (c[2] * b.z);
}

static void tell_rest(jcal_gyr_bias_t *self, float noise2)
{
    static const float unit[3][3] = {{1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, {0.0f, 0.0f, 1.0f}};
    update(self, unit[0], self->gyr_rad_s.x - self->bias_rad_s.x, noise2);
    update(self, unit[1], self->gyr_rad_s.y - self->bias_rad_s.y, noise2);
    update(self, unit[2], self->gyr_rad_s.z - self->bias_rad_s.z, noise2);
}

void jcal_bias_tick(jcal_gyr_bias_t *self, float dt_s, const jcal_lowpass_t *by, const float r[9],
                    const jcal_vec3_t *correction_rad)
{
    float c[9];
    for (size_t i = 0u; i < 9u; ++i) {
        c[i] = jcal_lowpass_put(by, r[i], &self->turn_mean[i], &self->turn_slope[i]);
    }
    float taken[2];
    for (size_t i = 0u; i < 2u; ++i) {
        taken[i] = jcal_lowpass_put(by, times(&r[3u * i], self->bias_rad_s), &self->part_mean[i], &self->part_slope[i]);
    }
    const float growth = FORGET_SIGMA * FORGET_SIGMA * (dt_s / FORGET_S);
    self->p[0] += growth;
    self->p[3] += growth;
    self->p[5] += growth;
    if (self->rest_us >= REST_US) {
        tell_rest(self, steady(SIGMA_REST, growth));
    } else if ((correction_rad != NULL) && !(by->share > 0.0f)) {
        const float per_s = 1.0f / dt_s;
        const float noise2 = steady(SIGMA_MOTION, growth);
        update(self, &c[0], taken[0] - (per_s * correction_rad->x) - times(&c[0], self->bias_rad_s), noise2);
        update(self, &c[3], taken[1] - (per_s * correction_rad->y) - times(&c[3], self->bias_rad_s), noise2);
        update(self, &c[6], -times(&c[6], self->bias_rad_s), VERTICAL_VARIANCE * noise2);
    } else {
        /* nothing is told */
    }
    jcal_vec3_t *const b = &self->bias_rad_s;
    b->x = jcal_max(-BIAS_MAX, jcal_min(BIAS_MAX, b->x));
    b->y = jcal_max(-BIAS_MAX, jcal_min(BIAS_MAX, b->y));
    b->z = jcal_max(-BIAS_MAX, jcal_min(BIAS_MAX, b->z));
}

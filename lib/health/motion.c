/* SPDX-License-Identifier: MIT */
/// @file
/// Motion, vibration and rest. See health/motion.h.
#include "health/motion.h"

#include "jointcal/vec3.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <math.h>

#define STRETCH_S 0.099f
/// Readings before this one that the difference needs.
#define ENOUGH 4.0f
/// Steps of the tenth part: up where a stretch lies above it, nine times as far down where it lies below.
#define STEP_UP 1.02f
#define STEP_DOWN 0.837f
/// Stretches in which the steps are larger, so that the first one does not count for long.
#define STRETCHES_FIRST 50.0f
#define STEP_UP_FIRST 1.08f
#define STEP_DOWN_FIRST 0.5f
#define QUIET_LEAST 1e-6f
#define MOVING_RAD_S 0.3f
#define READINGS_MOST 100000.0f

/// Rest: blocks in a row, rates and their scatter, rad/s, and scatter of forces as a share.
#define REST_BLOCKS 10.0f
#define REST_RATE_RAD_S 0.1f
#define REST_SCATTER_RAD_S 0.03f
#define REST_SCATTER_ACC 0.02f
#define REST_MOST_S 60.0f

/// The stretch goes into the mean squares.
static void add_total(jcal_health_motion_t *self)
{
    if (!(self->readings > 0.0f)) {
        return;
    }
    const float each = 1.0f / self->readings;
    const float fast = self->count - ENOUGH;
    self->total = jcal_min(self->total + self->readings, READINGS_MOST);
    const float share = self->readings / self->total;
    self->rate2 += ((each * self->sum_rate2) - self->rate2) * share;
    self->acc2 += ((each * self->sum_acc2) - self->acc2) * share;
    if (fast > 0.0f) {
        self->fast2 += ((self->sum2 / fast) - self->fast2) * share;
    }
}

static void begin_stretch(jcal_health_motion_t *self, float count)
{
    self->sum_rate2 = 0.0f;
    self->sum_acc2 = 0.0f;
    self->sum2 = 0.0f;
    self->readings = 0.0f;
    self->count = count;
    self->length_s = 0.0f;
}

void jcal_health_motion_break(jcal_health_motion_t *self)
{
    add_total(self);
    begin_stretch(self, 0.0f);
}

static void end_stretch(jcal_health_motion_t *self)
{
    const float rms = jcal_max(sqrtf(self->sum2 / jcal_max(self->count - ENOUGH, 1.0f)), QUIET_LEAST);
    const bool is_early = self->stretches < STRETCHES_FIRST;
    if (!(self->stretches > 0.0f)) {
        self->quiet_rad_s = rms;
    } else if (rms > self->quiet_rad_s) {
        self->quiet_rad_s = jcal_min(rms, self->quiet_rad_s * (is_early ? STEP_UP_FIRST : STEP_UP));
    } else {
        self->quiet_rad_s = jcal_max(rms, self->quiet_rad_s * (is_early ? STEP_DOWN_FIRST : STEP_DOWN));
    }
    self->stretches = jcal_min(self->stretches + 1.0f, READINGS_MOST);
    add_total(self);
    begin_stretch(self, ENOUGH); /* the last rates are there */
}

/// The fourth difference of the rates before the last one, that, and this one.
static jcal_vec3_t fourth_difference(const jcal_vec3_t before[JCAL_HEALTH_BEFORE], jcal_vec3_t last, jcal_vec3_t now)
{
    const jcal_vec3_t ends = jcal_vec3_add(before[0], now);
    const jcal_vec3_t sides = jcal_vec3_scale(jcal_vec3_add(before[1], last), 4.0f);
    return jcal_vec3_add(jcal_vec3_sub(ends, sides), jcal_vec3_scale(before[2], 6.0f));
}

void jcal_health_motion_add(jcal_health_motion_t *self, jcal_vec3_t last, jcal_vec3_t w,
                            const jcal_health_squares_t *squares, float dt_s)
{
    if (self->count >= ENOUGH) {
        const jcal_vec3_t fast = fourth_difference(self->before, last, w);
        self->sum2 += (1.0f / 256.0f) * jcal_vec3_dot(fast, fast);
    }
    if (squares->rate2 > (MOVING_RAD_S * MOVING_RAD_S)) {
        self->motion_s += dt_s;
    }
    self->sum_rate2 += squares->rate2;
    self->sum_acc2 += squares->acc2;
    self->readings += 1.0f;
    self->count += 1.0f;
    self->length_s += dt_s;
    for (unsigned k = 1u; k < JCAL_HEALTH_BEFORE; ++k) {
        self->before[k - 1u] = self->before[k];
    }
    self->before[JCAL_HEALTH_BEFORE - 1] = last;
    if (self->length_s >= STRETCH_S) {
        end_stretch(self);
    }
}

void jcal_health_rest_break(jcal_health_rest_t *self)
{
    const float gravity_m_s2 = self->gravity_m_s2;
    const float rest_s = self->rest_s;
    jcal_clear(self, sizeof *self);
    self->gravity_m_s2 = gravity_m_s2;
    self->rest_s = rest_s;
}

void jcal_health_rest_add(jcal_health_rest_t *self, const jcal_health_block_t *block)
{
    const jcal_vec3_t acc = jcal_vec3_scale(block->acc_sum, 1.0f / block->count);
    const jcal_vec3_t gyr = jcal_vec3_scale(block->turn, 1.0f / block->length_s);
    self->acc = jcal_vec3_add(self->acc, acc);
    self->gyr = jcal_vec3_add(self->gyr, gyr);
    self->acc2 += jcal_vec3_dot(acc, acc);
    self->gyr2 += jcal_vec3_dot(gyr, gyr);
    self->count += 1.0f;
    if (self->count < REST_BLOCKS) {
        return;
    }
    const float share = 1.0f / self->count;
    const jcal_vec3_t a = jcal_vec3_scale(self->acc, share);
    const jcal_vec3_t w = jcal_vec3_scale(self->gyr, share);
    const float a2 = jcal_vec3_dot(a, a);
    const float w2 = jcal_vec3_dot(w, w);
    const bool is_still = (w2 < (REST_RATE_RAD_S * REST_RATE_RAD_S)) &&
                          (((self->gyr2 * share) - w2) < (REST_SCATTER_RAD_S * REST_SCATTER_RAD_S)) &&
                          (((self->acc2 * share) - a2) < (REST_SCATTER_ACC * REST_SCATTER_ACC * jcal_max(a2, 1.0f)));
    jcal_health_rest_break(self);
    if (is_still) {
        self->rest_s = jcal_min(self->rest_s + 1.0f, REST_MOST_S);
        self->gravity_m_s2 += (sqrtf(a2) - self->gravity_m_s2) / self->rest_s;
    }
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Bins, derivatives and smoothing. See kinematics.h.
#include "sample/kinematics.h"

#include <stddef.h>
#include <string.h>

#define MICROSECONDS 1e-6f

/// Length of a bin, s.
#define BIN_S 0.02f
#define PER_BIN_MAX 64u

/// Distances of samples that belong together differ by less than this factor.
#define EVEN 1.5f

/// Place of the bin in the middle, counted from the oldest.
#define MIDDLE 3u

void jcal_kinematics_begin(jcal_kinematics_t *self)
{
    (void)memset(self, 0, sizeof *self);
}

static void begin_chain(jcal_kinematics_t *self)
{
    self->interval_s = 0.0f;
    self->filled = 0u;
    self->in_bin = 0u;
    self->per_bin = 1u;
}

static void add_reading(jcal_imu_t *sum, const jcal_imu_t *imu)
{
    sum->gyr_rad_s = jcal_vec3_add(sum->gyr_rad_s, imu->gyr_rad_s);
    sum->acc_m_s2 = jcal_vec3_add(sum->acc_m_s2, imu->acc_m_s2);
}

static jcal_imu_t mean_of(const jcal_imu_t *sum, float share)
{
    const jcal_imu_t mean = {jcal_vec3_scale(sum->gyr_rad_s, share), jcal_vec3_scale(sum->acc_m_s2, share)};
    return mean;
}

/// The bin `place` after the oldest, from a full ring.
static const jcal_bin_t *bin(const jcal_kinematics_t *self, size_t place)
{
    return &self->ring[(self->next + place) % JCAL_BINS];
}

/// Sensor 1 or 2 of that bin.
static const jcal_imu_t *reading(const jcal_kinematics_t *self, unsigned sensor, size_t place)
{
    const jcal_bin_t *const at = bin(self, place);
    return (sensor == 1u) ? &at->imu1 : &at->imu2;
}

/// v turned by the rotation vector `turn`, rad: a true rotation by 2 atan(|turn| / 2).
static jcal_vec3_t turned(jcal_vec3_t v, jcal_vec3_t turn)
{
    const jcal_vec3_t t = jcal_vec3_scale(turn, 0.5f);
    const jcal_vec3_t on = jcal_vec3_cross(t, jcal_vec3_add(v, jcal_vec3_cross(t, v)));
    return jcal_vec3_add(v, jcal_vec3_scale(on, 2.0f / (1.0f + jcal_vec3_dot(t, t))));
}

/// ww <- ww + share w w'.
static void add_square(float *ww, jcal_vec3_t w, float share)
{
    ww[0] += share * w.x * w.x;
    ww[1] += share * w.x * w.y;
    ww[2] += share * w.y * w.y;
    ww[3] += share * w.x * w.z;
    ww[4] += share * w.y * w.z;
    ww[5] += share * w.z * w.z;
}

/// far (w+3 - w-3) + wide (w+2 - w-2) + near (w+1 - w-1), over the distance of the bins.
static jcal_vec3_t slope(const jcal_kinematics_t *self, unsigned sensor, const float *taps, float per_s)
{
    jcal_vec3_t sum = {0.0f, 0.0f, 0.0f};
    for (size_t k = 1u; k <= MIDDLE; ++k) {
        const jcal_vec3_t after = reading(self, sensor, MIDDLE + k)->gyr_rad_s;
        const jcal_vec3_t before = reading(self, sensor, MIDDLE - k)->gyr_rad_s;
        sum = jcal_vec3_add(sum, jcal_vec3_scale(jcal_vec3_sub(after, before), taps[k - 1u] * per_s));
    }
    return sum;
}

static void smoothed(const jcal_kinematics_t *self, unsigned sensor, float spacing_s, jcal_body_t *body)
{
    static const float taps[] = {15.0f / 48.0f, 6.0f / 48.0f,
                                 -1.0f / 48.0f}; /* five-point quotient times (1, 2, 1)/4 */
    const jcal_imu_t *const at = reading(self, sensor, MIDDLE);
    const jcal_imu_t *const before = reading(self, sensor, MIDDLE - 1u);
    const jcal_imu_t *const after = reading(self, sensor, MIDDLE + 1u);
    body->dw = slope(self, sensor, taps, 1.0f / spacing_s);
    add_square(body->ww, at->gyr_rad_s, 0.5f);
    add_square(body->ww, before->gyr_rad_s, 0.25f);
    add_square(body->ww, after->gyr_rad_s, 0.25f);
    const float half_s = 0.5f * spacing_s;
    const jcal_vec3_t to_after = jcal_vec3_scale(jcal_vec3_add(at->gyr_rad_s, after->gyr_rad_s), half_s);
    const jcal_vec3_t to_before = jcal_vec3_scale(jcal_vec3_add(at->gyr_rad_s, before->gyr_rad_s), -half_s);
    const jcal_vec3_t sides = jcal_vec3_add(turned(after->acc_m_s2, to_after), turned(before->acc_m_s2, to_before));
    body->a = jcal_vec3_add(jcal_vec3_scale(at->acc_m_s2, 0.5f), jcal_vec3_scale(sides, 0.25f));
}

static void plain(const jcal_kinematics_t *self, unsigned sensor, const float *taps, float spacing_s, jcal_body_t *body)
{
    const jcal_imu_t *const at = reading(self, sensor, MIDDLE);
    body->dw = slope(self, sensor, taps, 1.0f / spacing_s);
    add_square(body->ww, at->gyr_rad_s, 1.0f);
    body->a = at->acc_m_s2;
}

/// The body of one sensor in the middle of a full ring.
static jcal_body_t body_of(const jcal_kinematics_t *self, unsigned sensor, jcal_derivative_t derivative,
                           float spacing_s)
{
    static const float five_point[] = {8.0f / 12.0f, -1.0f / 12.0f, 0.0f};
    static const float symmetric[] = {0.5f, 0.0f, 0.0f};
    jcal_body_t body = {0};
    if (derivative == JCAL_DERIVATIVE_SMOOTHED) {
        smoothed(self, sensor, spacing_s, &body);
    } else {
        plain(self, sensor, (derivative == JCAL_DERIVATIVE_FIVE_POINT) ? five_point : symmetric, spacing_s, &body);
    }
    return body;
}

/// Puts the bin that is full into the ring.
static void close_bin(jcal_kinematics_t *self, uint64_t now_us)
{
    const float share = 1.0f / (float)self->in_bin;
    jcal_bin_t *const slot = &self->ring[self->next];
    slot->imu1 = mean_of(&self->sum.imu1, share);
    slot->imu2 = mean_of(&self->sum.imu2, share);
    slot->t_us = (uint32_t)(self->begin_us + ((now_us - self->begin_us) / 2u));
    self->next = (uint8_t)((self->next + 1u) % JCAL_BINS);
    self->filled = (uint8_t)((self->filled < JCAL_BINS) ? (self->filled + 1u) : JCAL_BINS);
    self->in_bin = 0u;
}

/// Notices holes; sets the size of the bins from the first distance of a chain.
static void follow_time(jcal_kinematics_t *self, uint64_t t_us)
{
    const float dt_s = (float)(t_us - self->last_us) * MICROSECONDS;
    self->last_us = t_us;
    const bool is_even = (dt_s < (EVEN * self->interval_s)) && ((dt_s * EVEN) > self->interval_s);
    if ((self->interval_s > 0.0f) && !is_even) {
        begin_chain(self);
        return;
    }
    if (self->interval_s > 0.0f) {
        return;
    }
    if (self->in_bin > 0u) { /* the second of the chain: the bins begin with it */
        self->in_bin = 0u;
        self->interval_s = dt_s;
        const float fit = (BIN_S / dt_s) + 0.5f;
        self->per_bin = (uint8_t)((fit < 1.0f) ? 1.0f : ((fit > (float)PER_BIN_MAX) ? (float)PER_BIN_MAX : fit));
    }
}

bool jcal_kinematics_put(jcal_kinematics_t *self, jcal_derivative_t derivative, const jcal_pair_t *pair,
                         jcal_kinematic_t *out)
{
    follow_time(self, pair->t_us);
    if (self->in_bin == 0u) {
        (void)memset(&self->sum, 0, sizeof self->sum);
        self->begin_us = pair->t_us;
    }
    add_reading(&self->sum.imu1, &pair->imu1);
    add_reading(&self->sum.imu2, &pair->imu2);
    self->in_bin = (uint8_t)(self->in_bin + 1u);
    if ((self->interval_s == 0.0f) || (self->in_bin < self->per_bin)) {
        return false;
    }
    close_bin(self, pair->t_us);
    if (self->filled < JCAL_BINS) {
        return false;
    }
    const uint32_t span_us = bin(self, JCAL_BINS - 1u)->t_us - bin(self, 0u)->t_us;
    const uint32_t since_us = bin(self, JCAL_BINS - 1u)->t_us - bin(self, MIDDLE)->t_us;
    const float spacing_s = (float)span_us * (MICROSECONDS / (float)(JCAL_BINS - 1u));
    out->body1 = body_of(self, 1u, derivative, spacing_s);
    out->body2 = body_of(self, 2u, derivative, spacing_s);
    out->t_us = pair->t_us - since_us;
    out->dt_s = spacing_s;
    return true;
}

jcal_vec3_t jcal_body_times(const jcal_body_t *body, jcal_vec3_t r)
{
    const float *const ww = body->ww;
    const float square = jcal_body_rate2(body);
    const jcal_vec3_t d = body->dw;
    return jcal_vec3((d.y * r.z) - (d.z * r.y) + ((ww[0] - square) * r.x) + (ww[1] * r.y) + (ww[3] * r.z),
                     (d.z * r.x) - (d.x * r.z) + (ww[1] * r.x) + ((ww[2] - square) * r.y) + (ww[4] * r.z),
                     (d.x * r.y) - (d.y * r.x) + (ww[3] * r.x) + (ww[4] * r.y) + ((ww[5] - square) * r.z));
}

void jcal_body_matrix(const jcal_body_t *body, jcal_vec3_t *columns)
{
    const float *const ww = body->ww;
    const float square = jcal_body_rate2(body);
    const jcal_vec3_t d = body->dw;
    columns[0] = jcal_vec3(ww[0] - square, ww[1] + d.z, ww[3] - d.y);
    columns[1] = jcal_vec3(ww[1] - d.z, ww[2] - square, ww[4] + d.x);
    columns[2] = jcal_vec3(ww[3] + d.y, ww[4] - d.x, ww[5] - square);
}

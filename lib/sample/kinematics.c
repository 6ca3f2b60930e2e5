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

/// sum <- sum + q; q and -q are the same orientation, and that nearer to the sum is taken.
static void add_attitude(jcal_quat_t *sum, jcal_quat_t q)
{
    const float dot = (sum->w * q.w) + (sum->x * q.x) + (sum->y * q.y) + (sum->z * q.z);
    const float sign = (dot < 0.0f) ? -1.0f : 1.0f;
    *sum = jcal_quat(sum->w + (sign * q.w), sum->x + (sign * q.x), sum->y + (sign * q.y), sum->z + (sign * q.z));
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

/// The columns of K.
static void fill_columns(jcal_vec3_t w, jcal_vec3_t dw, jcal_vec3_t *k)
{
    const float square = jcal_vec3_dot(w, w);
    k[0] = jcal_vec3((w.x * w.x) - square, (w.x * w.y) + dw.z, (w.x * w.z) - dw.y);
    k[1] = jcal_vec3((w.x * w.y) - dw.z, (w.y * w.y) - square, (w.y * w.z) + dw.x);
    k[2] = jcal_vec3((w.x * w.z) + dw.y, (w.y * w.z) - dw.x, (w.z * w.z) - square);
}

/// What one sensor says in the bin `place`, by a quotient near (w+1 - w-1) + far (w+2 - w-2).
static jcal_body_t body_at(const jcal_kinematics_t *self, unsigned sensor, size_t place, jcal_plane_t per_s)
{
    const jcal_imu_t *const at = reading(self, sensor, place);
    const jcal_vec3_t near =
        jcal_vec3_sub(reading(self, sensor, place + 1u)->gyr_rad_s, reading(self, sensor, place - 1u)->gyr_rad_s);
    const jcal_vec3_t far =
        jcal_vec3_sub(reading(self, sensor, place + 2u)->gyr_rad_s, reading(self, sensor, place - 2u)->gyr_rad_s);
    jcal_body_t body;
    body.a = at->acc_m_s2;
    body.rate2 = jcal_vec3_dot(at->gyr_rad_s, at->gyr_rad_s);
    fill_columns(at->gyr_rad_s, jcal_vec3_add(jcal_vec3_scale(near, per_s.re), jcal_vec3_scale(far, per_s.im)), body.k);
    return body;
}

/// sum <- (sum + body turned by `turn`) / 2.
static void blend(jcal_body_t *sum, const jcal_body_t *body, jcal_vec3_t turn)
{
    sum->a = jcal_vec3_scale(jcal_vec3_add(sum->a, turned(body->a, turn)), 0.5f);
    for (size_t i = 0u; i < 3u; ++i) {
        sum->k[i] = jcal_vec3_scale(jcal_vec3_add(sum->k[i], turned(body->k[i], turn)), 0.5f);
    }
}

/// (1, 2, 1)/4 over the middle and its neighbours: the mean of the means with either neighbour.
static jcal_body_t smoothed(const jcal_kinematics_t *self, unsigned sensor, jcal_plane_t per_s, float spacing_s)
{
    const jcal_vec3_t w = reading(self, sensor, MIDDLE)->gyr_rad_s;
    const jcal_body_t at = body_at(self, sensor, MIDDLE, per_s);
    jcal_body_t mean[2] = {at, at};
    for (size_t side = 0u; side < 2u; ++side) {
        const size_t place = (side == 0u) ? (MIDDLE - 1u) : (MIDDLE + 1u);
        const float half_s = (side == 0u) ? (-0.5f * spacing_s) : (0.5f * spacing_s);
        const jcal_body_t neighbour = body_at(self, sensor, place, per_s);
        const jcal_vec3_t turn = jcal_vec3_scale(jcal_vec3_add(w, reading(self, sensor, place)->gyr_rad_s), half_s);
        blend(&mean[side], &neighbour, turn);
    }
    blend(&mean[0], &mean[1], jcal_vec3(0.0f, 0.0f, 0.0f));
    return mean[0];
}

/// The body of one sensor in the middle of a full ring.
static jcal_body_t body_of(const jcal_kinematics_t *self, unsigned sensor, jcal_derivative_t derivative,
                           float spacing_s)
{
    const float per_s = 1.0f / spacing_s;
    const jcal_plane_t five_point = {per_s * (8.0f / 12.0f), -per_s / 12.0f};
    const jcal_plane_t symmetric = {0.5f * per_s, 0.0f};
    if (derivative == JCAL_DERIVATIVE_SMOOTHED) {
        return smoothed(self, sensor, five_point, spacing_s);
    }
    return body_at(self, sensor, MIDDLE, (derivative == JCAL_DERIVATIVE_FIVE_POINT) ? five_point : symmetric);
}

/// Turns a body to the earth frame.
static void to_earth(jcal_body_t *body, jcal_quat_t sum)
{
    const jcal_quat_t q = jcal_quat_normalise(sum);
    body->a = jcal_quat_rotate(q, body->a);
    for (size_t i = 0u; i < 3u; ++i) {
        body->k[i] = jcal_quat_rotate(q, body->k[i]);
    }
}

/// Puts the bin that is full into the ring.
static void close_bin(jcal_kinematics_t *self, uint64_t now_us)
{
    const float share = 1.0f / (float)self->in_bin;
    jcal_bin_t *const slot = &self->ring[self->next];
    slot->imu1 = mean_of(&self->sum.imu1, share);
    slot->imu2 = mean_of(&self->sum.imu2, share);
    slot->attitudes = self->sum.attitudes; /* any length will do */
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
                         const jcal_attitudes_t *attitudes, jcal_kinematic_t *out)
{
    follow_time(self, pair->t_us);
    if (self->in_bin == 0u) {
        (void)memset(&self->sum, 0, sizeof self->sum);
        self->begin_us = pair->t_us;
    }
    add_reading(&self->sum.imu1, &pair->imu1);
    add_reading(&self->sum.imu2, &pair->imu2);
    if (attitudes != NULL) {
        add_attitude(&self->sum.attitudes.q1, attitudes->q1);
        add_attitude(&self->sum.attitudes.q2, attitudes->q2);
    }
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
    if (attitudes != NULL) {
        to_earth(&out->body1, bin(self, MIDDLE)->attitudes.q1);
        to_earth(&out->body2, bin(self, MIDDLE)->attitudes.q2);
    }
    out->t_us = pair->t_us - since_us;
    out->dt_s = spacing_s;
    return true;
}

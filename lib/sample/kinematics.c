/* SPDX-License-Identifier: MIT */
/// @file
/// Bins, derivatives and smoothing. See kinematics.h.
#include "sample/kinematics.h"

#include "math/clear.h"
#include "math/scalar.h"

#include <stddef.h>

#define MICROSECONDS 1e-6f

/// Length of a bin, s.
#define BIN_S 0.02f
#define PER_BIN_MAX 64u

/// Distances of samples that belong together differ by less than this factor.
#define EVEN 1.5f

/// Place of the bin in the middle, counted from the oldest.
#define MIDDLE 2u

#define PER_BLOCK_MAX 100.0f
/// Bins in a block: rounded down unless nearly one more, and kept as long as blocks go on.
#define ROUND_FROM 0.25f
/// Blocks go on over a hole if the next middle bin is not later than this, s: the mean of both rates then leads over it.
#define BRIDGE_S 0.31f
/// The newest sample is never further from the last middle bin than this, s, if no hole is longer than BRIDGE_S and the chain goes on.
#define MIDDLE_MAX_S 60.0f

static void begin_chain(jcal_kinematics_t *self)
{
    self->interval_s = 0.0f;
    self->filled = 0u;
    self->in_bin = 0u;
    self->per_bin = 1u;
}

static void begin_blocks(jcal_kinematics_t *self)
{
    self->blocks = 0u;
    self->in_block = 0u;
    self->turn1 = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
    self->turn2 = self->turn1;
}

void jcal_kinematics_begin(jcal_kinematics_t *self)
{
    jcal_clear(self, sizeof *self);
    begin_chain(self);
    begin_blocks(self);
}

/// sum <- sum + imu, or imu if it is the first.
static void add_reading(jcal_imu_t *sum, const jcal_imu_t *imu, bool is_first)
{
    sum->gyr_rad_s = is_first ? imu->gyr_rad_s : jcal_vec3_add(sum->gyr_rad_s, imu->gyr_rad_s);
    sum->acc_m_s2 = is_first ? imu->acc_m_s2 : jcal_vec3_add(sum->acc_m_s2, imu->acc_m_s2);
}

static jcal_imu_t mean_of(const jcal_imu_t *sum, float share)
{
    const jcal_imu_t mean = {jcal_vec3_scale(sum->gyr_rad_s, share), jcal_vec3_scale(sum->acc_m_s2, share)};
    return mean;
}

/// sum <- sum + q, or q if it is the first; q and -q are the same orientation, and that nearer to the sum is taken.
static void add_attitude(jcal_quat_t *sum, jcal_quat_t q, bool is_first)
{
    const float dot = (sum->w * q.w) + (sum->x * q.x) + (sum->y * q.y) + (sum->z * q.z);
    const float sign = (dot < 0.0f) ? -1.0f : 1.0f;
    *sum = is_first
               ? q
               : jcal_quat(sum->w + (sign * q.w), sum->x + (sign * q.x), sum->y + (sign * q.y), sum->z + (sign * q.z));
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

/// The columns of K.
static void fill_columns(jcal_vec3_t w, jcal_vec3_t dw, jcal_vec3_t *k)
{
    const float square = jcal_vec3_dot(w, w);
    k[0] = jcal_vec3((w.x * w.x) - square, (w.x * w.y) + dw.z, (w.x * w.z) - dw.y);
    k[1] = jcal_vec3((w.x * w.y) - dw.z, (w.y * w.y) - square, (w.y * w.z) + dw.x);
    k[2] = jcal_vec3((w.x * w.z) + dw.y, (w.y * w.z) - dw.x, (w.z * w.z) - square);
}

/// The body of one sensor in the middle of a full ring, in its frame: by a quotient near (w+1 - w-1) + far (w+2 - w-2).
static void find_body(const jcal_kinematics_t *self, unsigned sensor, jcal_derivative_t derivative, float spacing_s,
                      jcal_segment_t *body)
{
    const float near = ((derivative == JCAL_DERIVATIVE_SYMMETRIC) ? 0.5f : (8.0f / 12.0f)) / spacing_s;
    const float far = ((derivative == JCAL_DERIVATIVE_SYMMETRIC) ? 0.0f : (-1.0f / 12.0f)) / spacing_s;
    const jcal_imu_t *const at = reading(self, sensor, MIDDLE);
    const jcal_vec3_t by_near =
        jcal_vec3_sub(reading(self, sensor, MIDDLE + 1u)->gyr_rad_s, reading(self, sensor, MIDDLE - 1u)->gyr_rad_s);
    const jcal_vec3_t by_far =
        jcal_vec3_sub(reading(self, sensor, MIDDLE + 2u)->gyr_rad_s, reading(self, sensor, MIDDLE - 2u)->gyr_rad_s);
    body->a = at->acc_m_s2;
    body->rate2 = jcal_vec3_dot(at->gyr_rad_s, at->gyr_rad_s);
    fill_columns(at->gyr_rad_s, jcal_vec3_add(jcal_vec3_scale(by_near, near), jcal_vec3_scale(by_far, far)), body->k);
    body->turn[0] = jcal_vec3(1.0f, 0.0f, 0.0f);
    body->turn[1] = jcal_vec3(0.0f, 1.0f, 0.0f);
    body->turn[2] = jcal_vec3(0.0f, 0.0f, 1.0f);
}

/// Turns a body from its sensor's frame to another.
static void turn_body(jcal_segment_t *body, jcal_quat_t q)
{
    const float x2 = 2.0f * q.x;
    const float y2 = 2.0f * q.y;
    const float z2 = 2.0f * q.z;
    jcal_vec3_t *const turn = body->turn;
    turn[0] = jcal_vec3(1.0f - ((y2 * q.y) + (z2 * q.z)), (x2 * q.y) + (z2 * q.w), (x2 * q.z) - (y2 * q.w));
    turn[1] = jcal_vec3((x2 * q.y) - (z2 * q.w), 1.0f - ((x2 * q.x) + (z2 * q.z)), (y2 * q.z) + (x2 * q.w));
    turn[2] = jcal_vec3((x2 * q.z) + (y2 * q.w), (y2 * q.z) - (x2 * q.w), 1.0f - ((x2 * q.x) + (y2 * q.y)));
    body->a = jcal_segment_turn(body, body->a);
    for (size_t i = 0u; i < 3u; ++i) {
        body->k[i] = jcal_segment_turn(body, body->k[i]);
    }
}

/// sum <- sum + body.
static void add_body(jcal_segment_t *sum, const jcal_segment_t *body)
{
    sum->a = jcal_vec3_add(sum->a, body->a);
    sum->rate2 += body->rate2;
    for (size_t i = 0u; i < 3u; ++i) {
        sum->k[i] = jcal_vec3_add(sum->k[i], body->k[i]);
        sum->turn[i] = jcal_vec3_add(sum->turn[i], body->turn[i]);
    }
}

/// The turn by a rotation vector, rad; right to 1e-6 rad below 0.3 rad.
static jcal_quat_t turn_by(jcal_vec3_t angle)
{
    const jcal_vec3_t half = jcal_vec3_scale(angle, 0.5f);
    const float h2 = jcal_vec3_dot(half, half);
    const jcal_vec3_t tangent = jcal_vec3_scale(half, 1.0f + (h2 * ((1.0f / 3.0f) + (h2 * (2.0f / 15.0f)))));
    return jcal_quat_normalise(jcal_quat(1.0f, tangent.x, tangent.y, tangent.z));
}

/// How far a sensor turned from the last middle bin to this one: by the cubic through four bins, or over a hole by the mean rate.
static jcal_vec3_t way_of(const jcal_kinematics_t *self, unsigned sensor, jcal_vec3_t before, float dt_s)
{
    const jcal_vec3_t now = reading(self, sensor, MIDDLE)->gyr_rad_s;
    if (self->middle_us != bin(self, MIDDLE - 1u)->t_us) {
        return jcal_vec3_scale(jcal_vec3_add(before, now), 0.5f * dt_s);
    }
    const jcal_vec3_t outer =
        jcal_vec3_add(reading(self, sensor, MIDDLE - 2u)->gyr_rad_s, reading(self, sensor, MIDDLE + 1u)->gyr_rad_s);
    const jcal_vec3_t inner = jcal_vec3_scale(jcal_vec3_add(before, now), 13.0f);
    return jcal_vec3_scale(jcal_vec3_sub(inner, outer), dt_s / 24.0f);
}

/// Follows both frames from the last middle bin to this one.
static void follow_frames(jcal_kinematics_t *self, float block_s)
{
    const jcal_bin_t *const middle = bin(self, MIDDLE);
    const float dt_s = (float)(uint32_t)(middle->t_us - self->middle_us) * MICROSECONDS;
    if (!self->has_middle || (dt_s > BRIDGE_S)) {
        const float spacing_s = (float)(uint32_t)(middle->t_us - bin(self, MIDDLE - 1u)->t_us) * MICROSECONDS;
        const float bins = (block_s / spacing_s) + ROUND_FROM;
        begin_blocks(self);
        self->per_block = (uint8_t)jcal_min(jcal_max(bins, 1.0f), PER_BLOCK_MAX);
    } else {
        const jcal_quat_t step1 = turn_by(way_of(self, 1u, self->middle1, dt_s));
        const jcal_quat_t step2 = turn_by(way_of(self, 2u, self->middle2, dt_s));
        self->turn1 = jcal_quat_normalise(jcal_quat_mul(self->turn1, step1));
        self->turn2 = jcal_quat_normalise(jcal_quat_mul(self->turn2, step2));
    }
    self->has_middle = true;
    self->middle_us = middle->t_us;
    self->middle1 = middle->imu1.gyr_rad_s;
    self->middle2 = middle->imu2.gyr_rad_s;
}

/// The four blocks of one body, from the oldest.
typedef struct {
    const jcal_segment_t *of[JCAL_BLOCKS];
} blocks_t;

/// weights[0] (a + d) + weights[1] (b + c).
static jcal_vec3_t mean_vector(const jcal_vec3_t *a, const jcal_vec3_t *b, const jcal_vec3_t *c, const jcal_vec3_t *d,
                               const float *weights)
{
    return jcal_vec3_add(jcal_vec3_scale(jcal_vec3_add(*a, *d), weights[0]),
                         jcal_vec3_scale(jcal_vec3_add(*b, *c), weights[1]));
}

/// Weights (1, 3, 3, 1)/8, times `share` of what a block sums up.
static void mean_body(const blocks_t *blocks, float share, jcal_segment_t *out)
{
    const float weights[2] = {0.125f * share, 0.375f * share};
    const jcal_segment_t *const a = blocks->of[0];
    const jcal_segment_t *const b = blocks->of[1];
    const jcal_segment_t *const c = blocks->of[2];
    const jcal_segment_t *const d = blocks->of[3];
    out->a = mean_vector(&a->a, &b->a, &c->a, &d->a, weights);
    out->rate2 = (weights[0] * (a->rate2 + d->rate2)) + (weights[1] * (b->rate2 + c->rate2));
    for (size_t i = 0u; i < 3u; ++i) {
        out->k[i] = mean_vector(&a->k[i], &b->k[i], &c->k[i], &d->k[i], weights);
        out->turn[i] = mean_vector(&a->turn[i], &b->turn[i], &c->turn[i], &d->turn[i], weights);
    }
}

/// Counts the bodies of the middle bin, in frames that do not turn, that were put into the block; true if that completed four of
/// them, whose weighted mean is then in `out`.
static bool smooth(jcal_kinematics_t *self, jcal_kinematic_t *out)
{
    const float share = 1.0f / (float)self->per_block;
    self->in_block = (uint8_t)(self->in_block + 1u);
    if (self->in_block < self->per_block) {
        return false;
    }
    self->next_block = (uint8_t)((self->next_block + 1u) % JCAL_BLOCKS);
    self->blocks = (uint8_t)((self->blocks < JCAL_BLOCKS) ? (self->blocks + 1u) : JCAL_BLOCKS);
    self->in_block = 0u;
    if (self->blocks < JCAL_BLOCKS) {
        return false;
    }
    blocks_t blocks1;
    blocks_t blocks2;
    for (size_t i = 0u; i < JCAL_BLOCKS; ++i) {
        const jcal_bodies_t *const block = &self->block[(self->next_block + i) % JCAL_BLOCKS];
        blocks1.of[i] = &block->body1;
        blocks2.of[i] = &block->body2;
    }
    mean_body(&blocks1, share, &out->body1);
    mean_body(&blocks2, share, &out->body2);
    return true;
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

/// Forgets the last middle bin once it is so old that nothing leads over the time since. Bins know half of the time only, so this looks
/// at every sample: between two of them time runs on by less, or the hole itself is seen.
static void forget_middle(jcal_kinematics_t *self, uint64_t t_us, float dt_s)
{
    const float since_s = (float)(uint32_t)(t_us - self->middle_us) * MICROSECONDS;
    self->has_middle = self->has_middle && (dt_s <= BRIDGE_S) && (since_s <= MIDDLE_MAX_S);
}

/// Notices holes; sets the size of the bins from the first distance of a chain.
static void follow_time(jcal_kinematics_t *self, uint64_t t_us)
{
    const float dt_s = (float)(t_us - self->last_us) * MICROSECONDS;
    self->last_us = t_us;
    forget_middle(self, t_us, dt_s);
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

/// What a ring that has just got another bin gives.
static bool emit(jcal_kinematics_t *self, const jcal_kinematics_config_t *cfg, const jcal_attitudes_t *attitudes,
                 jcal_kinematic_t *out)
{
    const uint32_t span_us = bin(self, JCAL_BINS - 1u)->t_us - bin(self, 0u)->t_us;
    const float spacing_s = (float)span_us * (MICROSECONDS / (float)(JCAL_BINS - 1u));
    const bool is_smooth = cfg->smoothing_s > 0.0f;
    follow_frames(self, cfg->smoothing_s / (float)JCAL_BLOCKS);
    jcal_bodies_t *const slot = &self->block[self->next_block];
    const bool is_first = is_smooth && (self->in_block == 0u); /* of the block: straight to its place */
    jcal_segment_t *const body1 = is_first ? &slot->body1 : &out->body1;
    jcal_segment_t *const body2 = is_first ? &slot->body2 : &out->body2;
    find_body(self, 1u, cfg->derivative, spacing_s, body1);
    find_body(self, 2u, cfg->derivative, spacing_s, body2);
    if (attitudes != NULL) {
        turn_body(body1, jcal_quat_normalise(bin(self, MIDDLE)->attitudes.q1));
        turn_body(body2, jcal_quat_normalise(bin(self, MIDDLE)->attitudes.q2));
    } else if (is_smooth) {
        turn_body(body1, self->turn1);
        turn_body(body2, self->turn2);
    } else {
        /* stays in the sensors' frames */
    }
    if (is_smooth && !is_first) {
        add_body(&slot->body1, body1);
        add_body(&slot->body2, body2);
    }
    out->dt_s = is_smooth ? (spacing_s * (float)self->per_block) : spacing_s;
    return !is_smooth || smooth(self, out);
}

bool jcal_kinematics_put(jcal_kinematics_t *self, const jcal_kinematics_config_t *cfg, const jcal_pair_t *pair,
                         const jcal_attitudes_t *attitudes, jcal_kinematic_t *out)
{
    follow_time(self, pair->t_us);
    const bool is_first = self->in_bin == 0u;
    self->begin_us = is_first ? pair->t_us : self->begin_us;
    add_reading(&self->sum.imu1, &pair->imu1, is_first);
    add_reading(&self->sum.imu2, &pair->imu2, is_first);
    if (attitudes != NULL) {
        add_attitude(&self->sum.attitudes.q1, attitudes->q1, is_first);
        add_attitude(&self->sum.attitudes.q2, attitudes->q2, is_first);
    }
    self->in_bin = (uint8_t)(self->in_bin + 1u);
    if ((self->interval_s == 0.0f) || (self->in_bin < self->per_bin)) {
        return false;
    }
    close_bin(self, pair->t_us);
    if ((self->filled < JCAL_BINS) || !emit(self, cfg, attitudes, out)) {
        return false;
    }
    const uint32_t since_us = bin(self, JCAL_BINS - 1u)->t_us - bin(self, MIDDLE)->t_us;
    out->t_us = pair->t_us - since_us;
    return true;
}

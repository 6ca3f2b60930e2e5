/* SPDX-License-Identifier: MIT */
/// @file
/// How fast gravity turns. See health/scale.h.
#include "health/scale.h"

#include "imu/turn.h"
#include "jointcal/vec3.h"
#include "math/chol_small.h"
#include "math/clear.h"
#include "math/scalar.h"
#include "math/sym.h"

#include <float.h>
#include <math.h>

/// Time constants, s; and the time after which both count.
#define FAST_S 2.0f
#define SLOW_S 10.0f
#define WARM_S 4.0f
/// e from which on a block counts half, as a share of gravity.
#define EASY_SHARE 0.03f
/// Standard deviations that are taken for granted: of e, as a share of gravity, of the bias, rad/s, and of the scale.
#define SPREAD 0.01f
#define BIAS_RAD_S 0.01f
#define SCALE_PRIOR 1.0f
/// e leaves at least this share of its variance.
#define LEFT_MIN 0.02f
/// Sums halve when they reach this time, s: the scale of an hour ago does not count for ever, and single precision does not run out.
#define MEMORY_S 600.0f
/// A scale that is off by more than this, the first time and later, and by more than so many standard deviations, is taken off, since the equations are linear near 1 only; judged when
/// so much time is summed, s. How far it may go, and how often it is done.
#define TAKE_SHARE 0.07f
#define TAKE_AGAIN_SHARE 0.02f
#define TAKE_DEVIATIONS 3.0f
#define TAKE_S 6.0f
#define TAKE_AGAIN_S 15.0f
#define TAKEN_LEAST 0.5f
#define TAKEN_MOST 2.0f
#define TIMES_MOST 3u
/// Longest turn of a block that is followed, rad: of a longer one the turn back within it, of second order, is not right, and readings of 100 Hz are too few.
#define TURN_MAX_RAD 1.0f

#define UNKNOWNS 4u

void jcal_health_scale_break(jcal_health_scale_t *self)
{
    self->epoch_s = 0.0f;
}

/// Column k of [v]x.
static jcal_vec3_t cross_column(jcal_vec3_t v, size_t k)
{
    if (k == 0u) {
        return jcal_vec3(0.0f, v.z, -v.y);
    }
    return (k == 1u) ? jcal_vec3(-v.z, 0.0f, v.x) : jcal_vec3(v.y, -v.x, 0.0f);
}

static void begin(jcal_health_past_t *past, jcal_vec3_t acc)
{
    jcal_clear(past, sizeof *past);
    past->g = acc;
}

/// The low-pass takes in the block's specific force, at its begin.
static void take(jcal_health_past_t *past, jcal_vec3_t acc, float q)
{
    past->g = jcal_vec3_add(past->g, jcal_vec3_scale(jcal_vec3_sub(acc, past->g), q));
    past->by_scale = jcal_vec3_scale(past->by_scale, 1.0f - q);
    for (size_t k = 0u; k < 9u; ++k) {
        past->by_bias[k] *= 1.0f - q;
    }
}

/// The sensor turns by the block.
static void turn(jcal_health_past_t *past, const float r[9], const jcal_health_block_t *block)
{
    const jcal_vec3_t g = jcal_turn_back(r, past->g);
    past->by_scale = jcal_vec3_sub(jcal_turn_back(r, past->by_scale), jcal_vec3_cross(block->angle, g));
    for (size_t k = 0u; k < 3u; ++k) {
        const jcal_vec3_t turned = jcal_turn_back(r, jcal_column(past->by_bias, k));
        const jcal_vec3_t fresh = jcal_vec3_add(turned, jcal_vec3_scale(cross_column(g, k), block->length_s));
        past->by_bias[k] = fresh.x;
        past->by_bias[k + 3u] = fresh.y;
        past->by_bias[k + 6u] = fresh.z;
    }
    past->g = g;
}

static float share_of(float length_s, float constant_s)
{
    const float x = length_s / constant_s;
    return x / (1.0f + (0.5f * x)); /* 1 - exp(-x), to second order */
}

static void halve(jcal_health_scale_t *self)
{
    jcal_sym_scale(self->squares, UNKNOWNS, 0.5f);
    for (size_t k = 0u; k < UNKNOWNS; ++k) {
        self->products[k] *= 0.5f;
    }
    self->left *= 0.5f;
    self->weight *= 0.5f;
    self->length_s *= 0.5f;
    self->gravity_s *= 0.5f;
}

static void sum(jcal_health_scale_t *self, float length_s)
{
    const jcal_vec3_t e = jcal_vec3_sub(self->fast.g, self->slow.g);
    const jcal_vec3_t scale = jcal_vec3_sub(self->fast.by_scale, self->slow.by_scale);
    const float g2 = jcal_vec3_dot(self->slow.g, self->slow.g);
    if (!(g2 > FLT_MIN)) {
        return;
    }
    const float e2 = jcal_vec3_dot(e, e) / g2;
    const float weight = 1.0f / (1.0f + (e2 * (1.0f / (EASY_SHARE * EASY_SHARE))));
    const float e_of[3] = {e.x, e.y, e.z};
    const float scale_of[3] = {scale.x, scale.y, scale.z};
    for (size_t i = 0u; i < 3u; ++i) {
        float row[UNKNOWNS];
        for (size_t k = 0u; k < 3u; ++k) {
            row[k] = BIAS_RAD_S * (self->fast.by_bias[(3u * i) + k] - self->slow.by_bias[(3u * i) + k]);
        }
        row[3] = scale_of[i];
        jcal_sym_rank1(self->squares, UNKNOWNS, row, weight / g2);
        for (size_t k = 0u; k < UNKNOWNS; ++k) {
            self->products[k] -= (weight / g2) * row[k] * e_of[i];
        }
    }
    self->left += weight * e2;
    self->weight += weight;
    self->length_s += length_s;
    self->gravity_s += length_s;
    self->gravity_m_s2 += (sqrtf(g2) - self->gravity_m_s2) * (length_s / self->gravity_s);
    if (self->length_s > MEMORY_S) {
        halve(self);
    }
}

jcal_health_scale_found_t jcal_health_scale_solve(const jcal_health_scale_t *self)
{
    jcal_health_scale_found_t found = {jcal_health_scale_taken(self), SCALE_PRIOR};
    if (!(self->weight > 0.0f)) {
        return found;
    }
    /* Sums count blocks; one of them is independent in each FAST_S. */
    const float unit = self->length_s / (self->weight * FAST_S * SPREAD * SPREAD);
    float m[10];
    float x[UNKNOWNS];
    for (size_t k = 0u; k < JCAL_SYM_SIZE(UNKNOWNS); ++k) {
        m[k] = unit * self->squares[k];
    }
    for (size_t k = 0u; k < UNKNOWNS; ++k) {
        x[k] = unit * self->products[k];
        m[jcal_sym_at(k, k)] +=
            (k < 3u) ? 1.0f
                     : (1.0f / (SCALE_PRIOR * SCALE_PRIOR)); /* the bias is in units of what is taken for granted */
    }
    const float b[UNKNOWNS] = {x[0], x[1], x[2], x[3]};
    if (!jcal_chol4_factor(m)) {
        return found;
    }
    jcal_chol4_solve(m, x);
    float explained = 0.0f;
    for (size_t k = 0u; k < UNKNOWNS; ++k) {
        explained += b[k] * x[k];
    }
    const float readings = jcal_max(3.0f * self->length_s / FAST_S, 1.0f);
    const float left = jcal_max(((unit * self->left) - explained) / readings, LEFT_MIN);
    found.scale = jcal_health_scale_taken(self) * (1.0f + x[3]);
    found.deviation =
        jcal_min(sqrtf(left) / m[9], SCALE_PRIOR); /* the last pivot: 1 / m[9]^2 is the variance of the scale */
    return found;
}

/// What was seen with the old scale, as the new one would have shown it.
static void move(jcal_health_past_t *past, float off)
{
    past->g = jcal_vec3_add(past->g, jcal_vec3_scale(past->by_scale, off));
}

/// True if so much time in the sums is enough to judge.
static bool is_enough(const jcal_health_scale_t *self, float length_s)
{
    return (length_s >= TAKE_S) && (length_s >= self->next_s) && (self->times_taken < TIMES_MOST);
}

bool jcal_health_scale_is_due(const jcal_health_scale_t *self, const jcal_health_block_t *block)
{
    return is_enough(self, self->length_s + block->length_s); /* which the sums have at the most */
}

/// Once in a while: a scale that is far off is taken off, and sums begin anew.
static void take_off(jcal_health_scale_t *self)
{
    if (!is_enough(self, self->length_s)) {
        return;
    }
    const bool is_first = self->times_taken == 0u;
    self->next_s = self->length_s + (is_first ? TAKE_S : TAKE_AGAIN_S);
    const jcal_health_scale_found_t found = jcal_health_scale_solve(self);
    const float now = jcal_health_scale_taken(self);
    const float to = jcal_max(TAKEN_LEAST, jcal_min(found.scale, TAKEN_MOST));
    const float off = (to / now) - 1.0f;
    if ((fabsf(off) < (is_first ? TAKE_SHARE : TAKE_AGAIN_SHARE)) ||
        (fabsf(off) < (TAKE_DEVIATIONS * found.deviation))) {
        return;
    }
    jcal_clear(self->squares, sizeof self->squares);
    jcal_clear(self->products, sizeof self->products);
    self->left = 0.0f;
    self->weight = 0.0f;
    self->length_s = 0.0f;
    self->next_s = TAKE_AGAIN_S;
    self->taken = to;
    self->times_taken = (uint8_t)(self->times_taken + 1u);
    move(&self->fast, off);
    move(&self->slow, off);
}

void jcal_health_scale_add(jcal_health_scale_t *self, const jcal_health_block_t *block, bool may_take)
{
    const jcal_vec3_t acc = jcal_vec3_scale(block->back_sum, 1.0f / block->count);
    const float angle2 = jcal_vec3_dot(block->angle, block->angle);
    if (!(angle2 < (TURN_MAX_RAD * TURN_MAX_RAD))) {
        self->epoch_s = 0.0f;
        return;
    }
    if (!(self->epoch_s > 0.0f)) {
        begin(&self->fast, acc);
        begin(&self->slow, acc);
    }
    self->epoch_s = jcal_min(self->epoch_s + block->length_s, 1000.0f);
    take(&self->fast, acc, share_of(block->length_s, jcal_min(FAST_S, self->epoch_s)));
    take(&self->slow, acc, share_of(block->length_s, jcal_min(SLOW_S, self->epoch_s)));
    if (self->epoch_s >= WARM_S) {
        sum(self, block->length_s);
        if (may_take) {
            take_off(self);
        }
    }
    float r[9];
    jcal_turn_matrix(jcal_turn_by(block->angle), r);
    turn(&self->fast, r, block);
    turn(&self->slow, r, block);
}

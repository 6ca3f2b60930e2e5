/* SPDX-License-Identifier: MIT */
/// @file
/// Which way to read the rates fits. See health/frames.h.
#include "health/frames.h"

#include "imu/turn.h"
#include "jointcal/quat.h"
#include "jointcal/vec3.h"
#include "math/angle.h"
#include "math/clear.h"
#include "math/scalar.h"

#include <float.h>
#include <math.h>
#include <string.h>

/// Unit of turns, 2^-6 rad, until one does not fit; and the largest it grows to.
#define EXPONENT_FIRST (-6)
#define EXPONENT_MOST 20
/// Units of the specific force that the first block of a window has.
#define UNITS_OF_G 32.0f
#define INT8_MOST 127.0f
/// A window tells if gravity turns by so much in it, in the mean square of a share. In the first such windows all ways are tried, whatever they say.
#define TURNS_MIN 0.02f
#define TRIALS_FIRST 4u
/// Sums halve at so many windows, and at so many in which all ways were tried.
#define WINDOWS_MOST 60000u
#define TRIALS_MOST 500u
/// Turns of half a block beyond which a way is not followed, rad.
#define TURN_MAX_RAD 100.0f

/// How scores are kept: the bits of 2^-20, those that are left out, and half a unit.
#define SCORE_BASE 0x35800000u
#define SCORE_SHIFT 12u
#define SCORE_HALF 0x800u

#define PART_BLOCKS (JCAL_HEALTH_BLOCKS / JCAL_HEALTH_PARTS)

jcal_health_way_t jcal_health_frames_way(unsigned index)
{
    static const int8_t orders[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    jcal_health_way_t way;
    for (unsigned k = 0u; k < 3u; ++k) {
        way.column[k] = orders[(index / 8u) % 6u][k];
        way.sign[k] = (((index >> k) & 1u) != 0u) ? (int8_t)-1 : (int8_t)1;
    }
    return way;
}

void jcal_health_frames_begin(jcal_health_frames_t *self)
{
    jcal_clear(self, sizeof *self);
    jcal_health_frames_break(self);
}

void jcal_health_frames_break(jcal_health_frames_t *self)
{
    self->filled = 0u;
    self->way = JCAL_HEALTH_AS_IS;
    self->part = 0u;
    self->exponent = EXPONENT_FIRST;
    self->of.filling.turn_rest = jcal_vec3(0.0f, 0.0f, 0.0f);
    self->of.filling.acc_rest = jcal_vec3(0.0f, 0.0f, 0.0f);
}

/// The nearest whole number within int8_t.
static int8_t whole(float value)
{
    const float bounded = jcal_max(-INT8_MOST, jcal_min(value, INT8_MOST));
    return (int8_t)(bounded + ((bounded < 0.0f) ? -0.5f : 0.5f));
}

/// Writes v in units; returns what rounding left out.
static jcal_vec3_t write(int8_t to[3], jcal_vec3_t v, float unit)
{
    to[0] = whole(v.x / unit);
    to[1] = whole(v.y / unit);
    to[2] = whole(v.z / unit);
    const jcal_vec3_t left =
        jcal_vec3_sub(v, jcal_vec3_scale(jcal_vec3((float)to[0], (float)to[1], (float)to[2]), unit));
    const bool is_rounding = jcal_vec3_dot(left, left) < (unit * unit);
    return is_rounding ? left : jcal_vec3(0.0f, 0.0f, 0.0f);
}

/// 2^exponent, from -6 to 20.
static float power_of_two(int8_t exponent)
{
    return (float)(UINT32_C(1) << ((uint32_t)(exponent - EXPONENT_FIRST) % 32u)) * (1.0f / 64.0f);
}

/// The unit of turns doubles.
static void coarsen(jcal_health_frames_t *self)
{
    ++self->exponent;
    for (unsigned k = 0u; k < self->filled; ++k) {
        for (unsigned i = 0u; i < 3u; ++i) {
            self->turn[k][i] = (int8_t)(self->turn[k][i] / 2);
        }
    }
}

void jcal_health_frames_add(jcal_health_frames_t *self, const jcal_health_block_t *block)
{
    if (self->filled >= JCAL_HEALTH_BLOCKS) {
        return;
    }
    const jcal_vec3_t acc = jcal_vec3_scale(block->acc_sum, 1.0f / block->count);
    if (self->filled == 0u) {
        jcal_health_frames_break(self);
        self->unit = jcal_max(jcal_vec3_norm(acc), 1e-3f) / UNITS_OF_G;
    }
    const jcal_vec3_t turn = jcal_vec3_add(block->turn, self->of.filling.turn_rest);
    const float largest = jcal_max(fabsf(turn.x), jcal_max(fabsf(turn.y), fabsf(turn.z)));
    bool fits = largest <= (INT8_MOST * power_of_two(self->exponent));
    for (int k = EXPONENT_FIRST; (k < EXPONENT_MOST) && (self->exponent < EXPONENT_MOST) && !fits; ++k) {
        coarsen(self);
        fits = largest <= (INT8_MOST * power_of_two(self->exponent));
    }
    self->of.filling.turn_rest = write(self->turn[self->filled], turn, power_of_two(self->exponent));
    self->of.filling.acc_rest =
        write(self->acc[self->filled], jcal_vec3_add(acc, self->of.filling.acc_rest), self->unit);
    self->filled = (uint8_t)(self->filled + 1u);
}

/// What makes half a turn, rad, of a block's whole numbers: one column and one factor for each component.
typedef struct {
    jcal_health_way_t way;
    float times[3];
} reader_t;

static reader_t reader_of(unsigned index, float unit)
{
    reader_t out = {jcal_health_frames_way((index < JCAL_HEALTH_DEG) ? index : JCAL_HEALTH_AS_IS), {0.0f, 0.0f, 0.0f}};
    const float size =
        (index == JCAL_HEALTH_STILL) ? 0.0f : ((index == JCAL_HEALTH_DEG) ? (unit * JCAL_RAD_PER_DEG) : unit);
    for (unsigned k = 0u; k < 3u; ++k) {
        out.times[k] = (float)out.way.sign[k] * size;
    }
    return out;
}

static jcal_vec3_t read_by(const reader_t *reader, const int8_t from[3])
{
    const int8_t *const column = reader->way.column;
    return jcal_vec3(reader->times[0] * (float)from[column[0]], reader->times[1] * (float)from[column[1]],
                     reader->times[2] * (float)from[column[2]]);
}

/// Turns through one part of the window.
static void follow(jcal_health_frames_t *self)
{
    const reader_t reader = reader_of(self->way, 0.5f * power_of_two(self->exponent));
    jcal_vec3_t sum = jcal_vec3(0.0f, 0.0f, 0.0f);
    if (self->part == 0u) {
        self->of.working.q = jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
        self->of.working.all = jcal_vec3(0.0f, 0.0f, 0.0f);
        self->of.working.squares = 0.0f;
    }
    jcal_quat_t q = self->of.working.q;
    for (unsigned k = 0u; k < PART_BLOCKS; ++k) {
        const unsigned at = ((self->part % JCAL_HEALTH_PARTS) * PART_BLOCKS) + k;
        const int8_t *const acc = self->acc[at];
        const jcal_vec3_t half = read_by(&reader, self->turn[at]);
        const bool is_short = jcal_vec3_dot(half, half) < (TURN_MAX_RAD * TURN_MAX_RAD);
        const jcal_quat_t by = is_short ? jcal_turn_by(half) : jcal_quat(1.0f, 0.0f, 0.0f, 0.0f);
        const jcal_quat_t middle = jcal_quat_mul(q, by);
        const jcal_vec3_t felt = jcal_vec3((float)acc[0], (float)acc[1], (float)acc[2]);
        sum = jcal_vec3_add(sum, jcal_quat_rotate(middle, felt));
        q = jcal_quat_mul(middle, by);
    }
    self->of.working.q = jcal_quat_normalise(q);
    self->of.working.all = jcal_vec3_add(self->of.working.all, sum);
    self->of.working.squares += jcal_vec3_dot(sum, sum);
}

/// What a way leaves open in this window.
static float open_of(const jcal_health_frames_t *self)
{
    const jcal_vec3_t all = self->of.working.all;
    const float squares = self->of.working.squares;
    const float left = squares - (jcal_vec3_dot(all, all) / (float)JCAL_HEALTH_PARTS);
    return (squares > FLT_MIN) ? (jcal_max(left, 0.0f) / squares) : 0.0f;
}

/* A score is kept as 5 bits of exponent and 11 of fraction, which are those of the float less 2^-20: right to 1/4096 from there to 2^12,
 * in the order of the floats, and 0 below. */

float jcal_health_frames_score(const jcal_health_frames_t *self, unsigned way)
{
    const uint32_t kept = self->score[way];
    const uint32_t bits = (kept > 0u) ? ((kept << SCORE_SHIFT) + SCORE_BASE) : 0u;
    float score = 0.0f;
    (void)memcpy(&score, &bits, sizeof score);
    return score;
}

static void set_score(jcal_health_frames_t *self, unsigned way, float score)
{
    uint32_t bits = 0u;
    (void)memcpy(&bits, &score, sizeof bits);
    self->score[way] = (uint16_t)((bits > SCORE_BASE) ? ((bits - SCORE_BASE + SCORE_HALF) >> SCORE_SHIFT) : 0u);
}

static void add_score(jcal_health_frames_t *self, unsigned way, float open)
{
    set_score(self, way, jcal_health_frames_score(self, way) + open);
}

static void halve_if_long(jcal_health_frames_t *self)
{
    if ((self->trials < TRIALS_MOST) && (self->fits < WINDOWS_MOST)) {
        return;
    }
    self->trials = (uint16_t)(self->trials / 2u);
    self->fits = (uint16_t)(self->fits / 2u);
    for (unsigned k = 0u; k < JCAL_HEALTH_WAYS; ++k) {
        set_score(self, k, 0.5f * jcal_health_frames_score(self, k));
    }
}

/// The way is through; the next one is chosen, or the window is done.
static void finish_way(jcal_health_frames_t *self)
{
    const float open = open_of(self);
    if (self->way == JCAL_HEALTH_AS_IS) {
        self->of.working.as_is = open;
        self->way = JCAL_HEALTH_STILL;
        return;
    }
    if (self->way == JCAL_HEALTH_STILL) {
        const bool is_first = (self->trials < TRIALS_FIRST) && (open > TURNS_MIN);
        if (!is_first && !(self->of.working.as_is > JCAL_HEALTH_OPEN)) {
            self->fits = (uint16_t)(self->fits + 1u);
            halve_if_long(self);
            jcal_health_frames_break(self);
            return;
        }
        add_score(self, JCAL_HEALTH_AS_IS, self->of.working.as_is);
        add_score(self, JCAL_HEALTH_STILL, open);
        self->way = JCAL_HEALTH_AS_IS + 1u;
        return;
    }
    add_score(self, self->way % JCAL_HEALTH_WAYS, open);
    self->way = (uint8_t)(self->way + 1u);
    if (self->way >= JCAL_HEALTH_STILL) {
        self->trials = (uint16_t)(self->trials + 1u);
        halve_if_long(self);
        jcal_health_frames_break(self);
    }
}

void jcal_health_frames_step(jcal_health_frames_t *self)
{
    if (self->filled < JCAL_HEALTH_BLOCKS) {
        return;
    }
    follow(self);
    self->part = (uint8_t)(self->part + 1u);
    if (self->part >= JCAL_HEALTH_PARTS) {
        self->part = 0u;
        finish_way(self);
    }
}

unsigned jcal_health_frames_best(const jcal_health_frames_t *self, float *next)
{
    /* what is kept is in the order of the floats */
    const uint16_t *const score = self->score;
    unsigned best = 0u;
    unsigned second = 1u;
    for (unsigned k = 1u; k < JCAL_HEALTH_DEG; ++k) {
        if (score[k] < score[best]) {
            second = best;
            best = k;
        } else if (score[k] < score[second]) {
            second = k;
        } else {
            /* neither */
        }
    }
    *next = jcal_health_frames_score(self, second);
    return best;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// What the readings of one sensor show. See sample/sensor.h.
#include "sample/sensor.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <math.h>
#include <string.h>

/// The mean magnitude of the specific force lies near 9.81 m/s^2 in any motion of a person; in g it is near 1.
#define GRAVITY_MIN_M_S2 4.0f
#define GRAVITY_MAX_M_S2 40.0f
#define GRAVITY_TIME_S 1.0f

/// A turn is over when its rates should have changed the specific force by this, m/s^2: 24 deg of gravity. With rates in deg/s that is
/// 0.4 deg, far below what noise and motion change. A turn that takes longer than this is given up, s.
#define TURN_M_S2 4.0f
#define TURN_MAX_S 1.0f
/// Share of the sums that stays at each turn, and turns that it takes to say anything: the sum after eight.
#define TURN_KEEP 0.95f
#define TURNS_MIN 6.5f
/// With rates in rad/s the specific force changes at least about as much as the rates alone would turn it; with deg/s
/// it changes 57 times less, 3283 times less in energy. The limit lies between, in the geometric middle of 1 and 1 /
/// 3283.
#define TURN_SHARE_MIN 0.02f

/// A component that stands at its extreme is clipped, if the extreme is more than noise at rest can be; and no accelerometer has a range
/// below 2 g.
#define GYR_CLIP_MIN_RAD_S 0.2f
#define ACC_CLIP_MIN_M_S2 15.0f
#define EXTREME_UNITS 65535.0f
/// Share of an extreme that goes each time it fades, one part in 2^6: 67 s to 1/e.
#define EXTREME_FADE 6u

/// How much speaks for a dead component: its rate stands while the others change by this in all, rad/s; its specific force stands while
/// the rates should change it by this, m/s^2. All three of a kind stand for frozen_s of motion.
#define DEAD_RATE_RAD_S 2.0f
#define DEAD_FORCE_M_S2 2.0f
#define DEAD_UNITS 1024.0f
#define REPEATED_UNITS 4096.0f
/// Readings of a motion in one plane without noise are multiples of each other, but for rounding: they tell nothing of a component.
#define IN_PLANE 1e-5f
/// The sensor moves: changes from one reading to the next that noise does not make, and a rate.
#define MOVING_M_S2 0.2f
#define MOVING_RAD_S 0.2f
enum { NO_SUSPICION = 0, STANDS = 1, SAME = 4, ALL_STAND = 7 };

bool jcal_sensor_is_finite(const jcal_imu_t *imu)
{
    const float parts[6] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                            imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    bool all = true;
    for (unsigned i = 0u; i < 6u; ++i) {
        all = all && jcal_is_finite(parts[i]);
    }
    return all;
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

static bool stands(const float last[3], const float now[3])
{
    return (now[0] == last[0]) && (now[1] == last[1]) && (now[2] == last[2]);
}

static bool is_beyond(const jcal_gate_config_t *cfg, const float now[6])
{
    return exceeds(&now[0], cfg->gyr_max_rad_s) || exceeds(&now[3], cfg->acc_max_m_s2);
}

/// A magnitude in the units of the extremes.
static uint16_t in_units(float magnitude, float most)
{
    const float units = magnitude * (EXTREME_UNITS / most);
    return (uint16_t)jcal_min(units, EXTREME_UNITS);
}

/// True if some component of three stands still at its extreme. If all three stand, no reading came: that is no sign of a limit.
static bool stands_at_extreme(const float last[3], const float now[3], const uint16_t extreme[3], float least,
                              float most)
{
    bool found = false;
    for (unsigned i = 0u; i < 3u; ++i) {
        const float magnitude = fabsf(now[i]);
        found = found || ((now[i] == last[i]) && (magnitude > least) && (in_units(magnitude, most) >= extreme[i]));
    }
    return found && !stands(last, now);
}

/// A component is clipped only while the sensor turns: at rest a coarse reading repeats itself.
static bool is_clipped(const jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6])
{
    const float *const last = self->last;
    return exceeds(&now[0], GYR_CLIP_MIN_RAD_S) &&
           (stands_at_extreme(&last[0], &now[0], &self->extreme[0], GYR_CLIP_MIN_RAD_S, cfg->gyr_max_rad_s) ||
            stands_at_extreme(&last[3], &now[3], &self->extreme[3], ACC_CLIP_MIN_M_S2, cfg->acc_max_m_s2));
}

/// An extreme is what a component held for two readings, the smaller one at least half of the larger: not a glitch.
static void remember(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6])
{
    for (unsigned i = 0u; i < 6u; ++i) {
        const float more = jcal_max(fabsf(now[i]), fabsf(self->last[i]));
        const float less = jcal_min(fabsf(now[i]), fabsf(self->last[i]));
        const uint16_t held =
            in_units(((2.0f * less) >= more) ? more : less, (i < 3u) ? cfg->gyr_max_rad_s : cfg->acc_max_m_s2);
        self->extreme[i] = (held > self->extreme[i]) ? held : self->extreme[i];
        self->last[i] = now[i];
    }
}

void jcal_sensor_fade(jcal_gate_sensor_t *self)
{
    for (unsigned i = 0u; i < 6u; ++i) {
        self->extreme[i] = (uint16_t)(self->extreme[i] - (self->extreme[i] >> EXTREME_FADE));
    }
}

/// Whether a suspicion still holds.
static bool holds(unsigned suspicion, const float last[3], const float now[3])
{
    if (suspicion == ALL_STAND) {
        return stands(last, now);
    }
    if (suspicion >= SAME) {
        const unsigned i = suspicion - SAME;
        return now[i] == now[(i + 1u) % 3u];
    }
    return (suspicion != NO_SUSPICION) && (now[suspicion - STANDS] == last[suspicion - STANDS]);
}

/// What can be suspected of three components now.
static unsigned suspect(const float last[3], const float now[3])
{
    unsigned found = NO_SUSPICION;
    for (unsigned suspicion = SAME + 2u; suspicion >= STANDS; --suspicion) {
        found = holds(suspicion, last, now) ? suspicion : found;
    }
    return stands(last, now) ? ALL_STAND : found;
}

/// What a reading adds to the suspicion that a rate is dead, rad/s: how much the two others change, unless in one plane.
static float add_rate(unsigned suspicion, const float last[3], const float now[3])
{
    const unsigned third = (suspicion >= SAME) ? (suspicion - SAME) : (suspicion - STANDS);
    const unsigned a = (third + 1u) % 3u;
    const unsigned b = (third + 2u) % 3u;
    const float across = fabsf((last[a] * now[b]) - (last[b] * now[a]));
    const float square = (now[a] * now[a]) + (now[b] * now[b]) + (last[a] * last[a]) + (last[b] * last[b]);
    const float change_a = fabsf(now[a] - last[a]);
    const float change_b = fabsf(now[b] - last[b]);
    const bool tells = (across > (IN_PLANE * square)) && (change_a > 0.0f) && (change_b > 0.0f);
    return tells ? jcal_max(change_a, change_b) : 0.0f;
}

/// The same for a specific force, m/s^2: how much the rates should change what stands; `expected` is a x w dt.
static float add_force(unsigned suspicion, const float last[3], const float now[3], jcal_vec3_t expected)
{
    const float x[3] = {expected.x, expected.y, expected.z};
    if (suspicion >= SAME) {
        const unsigned i = suspicion - SAME;
        return fabsf(x[i] - x[(i + 1u) % 3u]);
    }
    const unsigned i = suspicion - STANDS;
    const bool alone = (now[(i + 1u) % 3u] != last[(i + 1u) % 3u]) && (now[(i + 2u) % 3u] != last[(i + 2u) % 3u]);
    return alone ? fabsf(x[i]) : 0.0f;
}

/// Adds to the suspicion of the rates (0) or of the specific forces (1), or begins another.
static void follow_dead(jcal_gate_sensor_t *self, unsigned kind, unsigned suspicion, float amount)
{
    const float total =
        (self->suspicion[kind] == suspicion) ? ((float)self->total[kind] + (DEAD_UNITS * amount) + 0.5f) : 0.0f;
    self->suspicion[kind] = (uint8_t)suspicion;
    self->total[kind] = (uint16_t)jcal_min(total, (float)UINT16_MAX);
}

/// What is suspected of three components, now that another reading has come.
static unsigned go_on(unsigned suspicion, const float last[3], const float now[3])
{
    return holds(suspicion, last, now) ? suspicion : suspect(last, now);
}

/// What the rates tell of a suspicion of them.
static float told_of_rates(const float last[6], const float now[6], unsigned suspicion, float dt_s)
{
    const float moved[3] = {now[3] - last[3], now[4] - last[4], now[5] - last[5]};
    if (suspicion == ALL_STAND) {
        return exceeds(moved, MOVING_M_S2) ? dt_s : 0.0f;
    }
    return (suspicion == NO_SUSPICION) ? 0.0f : add_rate(suspicion, &last[0], &now[0]);
}

/// The same for the specific forces.
static float told_of_forces(const float last[6], const float now[6], unsigned suspicion, float dt_s)
{
    if (suspicion == ALL_STAND) {
        return (exceeds(&now[0], MOVING_RAD_S) && !stands(&last[0], &now[0])) ? dt_s : 0.0f;
    }
    const jcal_vec3_t w = {now[0], now[1], now[2]};
    const jcal_vec3_t a = {now[3], now[4], now[5]};
    const jcal_vec3_t expected = jcal_vec3_scale(jcal_vec3_cross(a, w), dt_s);
    return (suspicion == NO_SUSPICION) ? 0.0f : add_force(suspicion, &last[3], &now[3], expected);
}

/// Looks for components that are dead.
static void follow_suspicions(jcal_gate_sensor_t *self, const float now[6], float dt_s)
{
    const float *const last = self->last;
    const unsigned gyr = go_on(self->suspicion[0], &last[0], &now[0]);
    const unsigned acc = go_on(self->suspicion[1], &last[3], &now[3]);
    follow_dead(self, 0u, gyr, told_of_rates(last, now, gyr, dt_s));
    follow_dead(self, 1u, acc, told_of_forces(last, now, acc, dt_s));
}

static bool has_dead(const jcal_gate_sensor_t *self, unsigned kind, float limit, float frozen_s)
{
    return (float)self->total[kind] > (DEAD_UNITS * ((self->suspicion[kind] == ALL_STAND) ? frozen_s : limit));
}

bool jcal_sensor_acc_looks_wrong(const jcal_gate_sensor_t *self)
{
    return !jcal_within(self->gravity_m_s2, GRAVITY_MIN_M_S2, GRAVITY_MAX_M_S2);
}

bool jcal_sensor_gyr_looks_wrong(const jcal_gate_sensor_t *self)
{
    return (self->turns > TURNS_MIN) && (self->turned < (TURN_SHARE_MIN * self->turns));
}

void jcal_sensor_follow_turn(jcal_gate_turn_t *turn, jcal_gate_sensor_t *sensor1, jcal_gate_sensor_t *sensor2,
                             const jcal_pair_t *pair, float dt_s)
{
    const jcal_imu_t *const imu = (turn->sensor == 2u) ? &pair->imu2 : &pair->imu1;
    jcal_gate_sensor_t *const sensor = (turn->sensor == 2u) ? sensor2 : sensor1;
    turn->angle_rad = jcal_vec3_add(turn->angle_rad, jcal_vec3_scale(imu->gyr_rad_s, dt_s));
    turn->time_s += dt_s;
    const jcal_vec3_t expected = jcal_vec3_cross(turn->from_m_s2, turn->angle_rad);
    const float expected2 = jcal_vec3_dot(expected, expected);
    const bool is_over = expected2 > (TURN_M_S2 * TURN_M_S2);
    if ((turn->sensor != 0u) && is_over) {
        const jcal_vec3_t change = jcal_vec3_sub(imu->acc_m_s2, turn->from_m_s2);
        const float change2 = jcal_vec3_dot(change, change);
        if (change2 > 0.0f) { /* else no reading came */
            sensor->turns = (TURN_KEEP * sensor->turns) + 1.0f;
            sensor->turned = (TURN_KEEP * sensor->turned) + (change2 / expected2);
        }
    }
    if ((turn->sensor == 0u) || is_over || (turn->time_s > TURN_MAX_S)) {
        const bool next_is_1 = turn->sensor != 1u;
        turn->sensor = next_is_1 ? 1u : 2u;
        turn->from_m_s2 = next_is_1 ? pair->imu1.acc_m_s2 : pair->imu2.acc_m_s2;
        turn->angle_rad = jcal_vec3(0.0f, 0.0f, 0.0f);
        turn->time_s = 0.0f;
    }
}

void jcal_sensor_start(jcal_gate_sensor_t *self, const jcal_imu_t *imu)
{
    unpack(imu, self->last);
    self->gravity_m_s2 = jcal_vec3_norm(imu->acc_m_s2);
    self->repeated = 0u;
}

jcal_reject_t jcal_sensor_begin(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const jcal_imu_t *imu)
{
    jcal_sensor_start(self, imu);
    const bool wrong = jcal_sensor_acc_looks_wrong(self) || is_beyond(cfg, self->last);
    return wrong ? JCAL_REJECT_OUT_OF_RANGE : JCAL_REJECT_NONE;
}

jcal_reject_t jcal_sensor_check(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const jcal_imu_t *imu,
                                float dt_s)
{
    float now[6];
    unpack(imu, now);
    const bool repeated = stands(&self->last[0], &now[0]) && stands(&self->last[3], &now[3]);
    const bool clipped = is_clipped(self, cfg, now);
    const float stood = repeated ? ((float)self->repeated + (REPEATED_UNITS * dt_s) + 0.5f) : 0.0f;
    self->repeated = (uint16_t)jcal_min(stood, (float)UINT16_MAX);
    if (exceeds(&now[3], cfg->acc_max_m_s2)) {
        return JCAL_REJECT_OUT_OF_RANGE; /* no force that a sensor feels: nothing to learn of gravity or of its range */
    }
    self->gravity_m_s2 += share_of(dt_s, GRAVITY_TIME_S) * (jcal_vec3_norm(imu->acc_m_s2) - self->gravity_m_s2);
    if (!repeated) {
        follow_suspicions(self, now, dt_s);
    }
    remember(self, cfg, now);
    if (is_beyond(cfg, now) || jcal_sensor_acc_looks_wrong(self) || jcal_sensor_gyr_looks_wrong(self)) {
        return JCAL_REJECT_OUT_OF_RANGE;
    }
    if (clipped) {
        return JCAL_REJECT_SATURATED;
    }
    if (((float)self->repeated > (REPEATED_UNITS * cfg->frozen_s)) ||
        has_dead(self, 0u, DEAD_RATE_RAD_S, cfg->frozen_s) || has_dead(self, 1u, DEAD_FORCE_M_S2, cfg->frozen_s)) {
        return JCAL_REJECT_FROZEN;
    }
    return repeated ? JCAL_REJECT_REPEATED : JCAL_REJECT_NONE;
}

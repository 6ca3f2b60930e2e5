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
/// An extreme is believed if the reading beside it reached this share of it; else that of the reading beside it.
#define HELD_SHARE 0.9f
#define EXTREME_UNITS 65535.0f
/// A reading below one part in this of an extreme leaves it alone, whatever the reading beside it: a little more than 1 / HELD_SHARE.
#define FAR_BELOW 1.12f
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
/// Sets of what can be suspected: one bit each, and those of the components that stand.
#define BIT(suspicion) (1u << (unsigned)(suspicion))
#define STANDING (BIT(STANDS) | BIT(STANDS + 1) | BIT(STANDS + 2))

/// The top bit is set if a number is NaN or infinite: its exponent is all ones, and one more carries into the sign.
static inline uint32_t carry_of(float value)
{
    uint32_t bits;
    (void)memcpy(&bits, &value, sizeof bits);
    return (bits & 0x7FFFFFFFu) + 0x00800000u;
}

bool jcal_gate_sensor_is_finite(const jcal_imu_t *imu)
{
    const jcal_vec3_t *const w = &imu->gyr_rad_s;
    const jcal_vec3_t *const a = &imu->acc_m_s2;
    const uint32_t carries =
        carry_of(w->x) | carry_of(w->y) | carry_of(w->z) | carry_of(a->x) | carry_of(a->y) | carry_of(a->z);
    return (carries >> 31) == 0u;
}

static inline void unpack(const jcal_imu_t *imu, float out[6])
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

/// All that can be suspected of three components now.
static unsigned suspicions_of(const float last[3], const float now[3])
{
    unsigned found = 0u;
    found |= (now[0] == last[0]) ? BIT(STANDS) : 0u;
    found |= (now[1] == last[1]) ? BIT(STANDS + 1) : 0u;
    found |= (now[2] == last[2]) ? BIT(STANDS + 2) : 0u;
    found |= (now[0] == now[1]) ? BIT(SAME) : 0u;
    found |= (now[1] == now[2]) ? BIT(SAME + 1) : 0u;
    found |= (now[2] == now[0]) ? BIT(SAME + 2) : 0u;
    return found | (((found & STANDING) == STANDING) ? BIT(ALL_STAND) : 0u);
}

/// The same. In most readings nothing repeats, and that is found out fast.
static inline unsigned repeats_of(const float last[3], const float now[3])
{
    const bool none = (now[0] != last[0]) && (now[1] != last[1]) && (now[2] != last[2]) && (now[0] != now[1]) &&
                      (now[1] != now[2]) && (now[2] != now[0]);
    return none ? 0u : suspicions_of(last, now);
}

/// Units of the extremes in one rad/s or m/s^2, if the largest believable one is `most`.
static inline float units_per(float most)
{
    return EXTREME_UNITS / most;
}

/// A magnitude in the units of the extremes, of which `per` make one rad/s or m/s^2.
static inline uint16_t in_units(float magnitude, float per)
{
    return (uint16_t)jcal_min(magnitude * per, EXTREME_UNITS);
}

/// True if some component of three stands still at its extreme. If all three stand, no reading came: that is no sign of a limit.
static bool stands_at_extreme(unsigned repeats, const float now[3], const uint16_t extreme[3], float least, float most)
{
    if (((repeats & STANDING) == 0u) || ((repeats & BIT(ALL_STAND)) != 0u)) {
        return false;
    }
    const float per = units_per(most);
    bool found = false;
    for (unsigned i = 0u; i < 3u; ++i) {
        const float magnitude = fabsf(now[i]);
        const bool stood = (repeats & BIT(STANDS + i)) != 0u;
        found = found || (stood && (magnitude > least) && (in_units(magnitude, per) >= extreme[i]));
    }
    return found;
}

/// A component is clipped only while the sensor turns: at rest a coarse reading repeats itself.
static bool is_clipped(const jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6],
                       const unsigned repeats[2])
{
    return exceeds(&now[0], GYR_CLIP_MIN_RAD_S) &&
           (stands_at_extreme(repeats[0], &now[0], &self->extreme[0], GYR_CLIP_MIN_RAD_S, cfg->gyr_max_rad_s) ||
            stands_at_extreme(repeats[1], &now[3], &self->extreme[3], ACC_CLIP_MIN_M_S2, cfg->acc_max_m_s2));
}

/// An extreme is what a component held for two readings, the smaller one nearly as large: not a glitch.
static inline void raise_extreme(jcal_gate_sensor_t *self, unsigned i, float now, float per)
{
    const float more = jcal_max(fabsf(now), fabsf(self->last[i]));
    if ((more * per) >= (float)(self->extreme[i] + 1u)) {
        const float less = jcal_min(fabsf(now), fabsf(self->last[i]));
        const uint16_t held = in_units((less >= (HELD_SHARE * more)) ? more : less, per);
        self->extreme[i] = (held > self->extreme[i]) ? held : self->extreme[i];
    }
}

/// Remembers a reading of which some rate is beyond the limit.
static void remember_beyond(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6])
{
    for (unsigned i = 0u; i < 6u; ++i) {
        raise_extreme(self, i, now[i], units_per((i < 3u) ? cfg->gyr_max_rad_s : cfg->acc_max_m_s2));
        self->last[i] = now[i];
    }
}

/// Most readings are far below the extreme, and then it need not be worked out what was held. None is beyond the limit.
static inline void remember_one(jcal_gate_sensor_t *self, unsigned i, float now, float per)
{
    if ((fabsf(now) * (FAR_BELOW * per)) >= (float)self->extreme[i]) {
        raise_extreme(self, i, now, per);
    }
    self->last[i] = now;
}

static inline void remember(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6])
{
    const float gyr_per = units_per(cfg->gyr_max_rad_s);
    const float acc_per = units_per(cfg->acc_max_m_s2);
    remember_one(self, 0u, now[0], gyr_per);
    remember_one(self, 1u, now[1], gyr_per);
    remember_one(self, 2u, now[2], gyr_per);
    remember_one(self, 3u, now[3], acc_per);
    remember_one(self, 4u, now[4], acc_per);
    remember_one(self, 5u, now[5], acc_per);
}

void jcal_gate_sensor_fade(jcal_gate_sensor_t *self)
{
    for (unsigned i = 0u; i < 6u; ++i) {
        self->extreme[i] = (uint16_t)(self->extreme[i] - (self->extreme[i] >> EXTREME_FADE));
    }
}

/// The suspicion to begin with.
static unsigned first_of(unsigned repeats)
{
    const bool at_once = (repeats == 0u) || ((repeats & BIT(ALL_STAND)) != 0u);
    unsigned first = at_once ? ALL_STAND : STANDS;
    while ((first < ALL_STAND) && ((repeats & BIT(first)) == 0u)) {
        ++first;
    }
    return ((repeats & BIT(first)) != 0u) ? first : NO_SUSPICION;
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

/// What the rates tell of a suspicion of them.
static float told_of_rates(const float last[6], const float now[6], unsigned suspicion, float dt_s)
{
    const float moved[3] = {now[3] - last[3], now[4] - last[4], now[5] - last[5]};
    if (suspicion == ALL_STAND) {
        return exceeds(moved, MOVING_M_S2) ? dt_s : 0.0f;
    }
    return add_rate(suspicion, &last[0], &now[0]);
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
    return add_force(suspicion, &last[3], &now[3], expected);
}

/// Adds to the suspicion of the rates (0) or of the specific forces (1) if it still holds, or begins another.
static void follow_dead(jcal_gate_sensor_t *self, unsigned kind, unsigned repeats, const float now[6], float dt_s)
{
    const unsigned suspicion = self->suspicion[kind];
    if ((repeats & BIT(suspicion)) == 0u) {
        self->suspicion[kind] = (uint8_t)first_of(repeats);
        self->total[kind] = 0u;
        return;
    }
    const float amount = (kind == 0u) ? told_of_rates(self->last, now, suspicion, dt_s)
                                      : told_of_forces(self->last, now, suspicion, dt_s);
    const float total = (float)self->total[kind] + (DEAD_UNITS * amount) + 0.5f;
    self->total[kind] = (uint16_t)jcal_min(total, (float)UINT16_MAX);
}

static bool has_dead(const jcal_gate_sensor_t *self, unsigned kind, float limit, float frozen_s)
{
    const uint16_t total = self->total[kind];
    return (total != 0u) && ((float)total > (DEAD_UNITS * ((self->suspicion[kind] == ALL_STAND) ? frozen_s : limit)));
}

bool jcal_gate_sensor_acc_looks_wrong(const jcal_gate_sensor_t *self)
{
    return !jcal_within(self->gravity_m_s2, GRAVITY_MIN_M_S2, GRAVITY_MAX_M_S2);
}

bool jcal_gate_sensor_gyr_looks_wrong(const jcal_gate_sensor_t *self)
{
    return (self->turns > TURNS_MIN) && (self->turned < (TURN_SHARE_MIN * self->turns));
}

void jcal_gate_sensor_follow_turn(jcal_gate_turn_t *turn, jcal_gate_sensor_t *sensor1, jcal_gate_sensor_t *sensor2,
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

void jcal_gate_sensor_start(jcal_gate_sensor_t *self, const jcal_imu_t *imu)
{
    unpack(imu, self->last);
    self->gravity_m_s2 = jcal_vec3_norm(imu->acc_m_s2);
    self->repeated = 0u;
}

jcal_reject_t jcal_gate_sensor_begin(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const jcal_imu_t *imu)
{
    jcal_gate_sensor_start(self, imu);
    const bool wrong = jcal_gate_sensor_acc_looks_wrong(self) || exceeds(&self->last[0], cfg->gyr_max_rad_s) ||
                       exceeds(&self->last[3], cfg->acc_max_m_s2);
    return wrong ? JCAL_REJECT_OUT_OF_RANGE : JCAL_REJECT_NONE;
}

/// What a reading shows that repeats something of the last one, or of itself.
static jcal_reject_t check_repeats(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6],
                                   const unsigned repeats[2], float dt_s)
{
    const bool repeated = (repeats[0] & repeats[1] & BIT(ALL_STAND)) != 0u;
    if (!repeated) {
        follow_dead(self, 0u, repeats[0], now, dt_s);
        follow_dead(self, 1u, repeats[1], now, dt_s);
    }
    if (is_clipped(self, cfg, now, repeats)) {
        return JCAL_REJECT_SATURATED;
    }
    if ((repeated && ((float)self->repeated > (REPEATED_UNITS * cfg->frozen_s))) ||
        has_dead(self, 0u, DEAD_RATE_RAD_S, cfg->frozen_s) || has_dead(self, 1u, DEAD_FORCE_M_S2, cfg->frozen_s)) {
        return JCAL_REJECT_FROZEN;
    }
    return repeated ? JCAL_REJECT_REPEATED : JCAL_REJECT_NONE;
}

/// What a reading shows beside the last one. If nothing repeats, as in most, nothing is suspected.
static inline jcal_reject_t compare(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const float now[6],
                                    const unsigned repeats[2], float dt_s)
{
    if ((repeats[0] | repeats[1]) != 0u) {
        return check_repeats(self, cfg, now, repeats, dt_s);
    }
    self->suspicion[0] = NO_SUSPICION;
    self->suspicion[1] = NO_SUSPICION;
    self->total[0] = 0u;
    self->total[1] = 0u;
    return JCAL_REJECT_NONE;
}

/// How long the whole reading has stood still, in units of 1 / REPEATED_UNITS s.
static uint16_t stood_for(const jcal_gate_sensor_t *self, float dt_s)
{
    return (uint16_t)jcal_min((float)self->repeated + (REPEATED_UNITS * dt_s) + 0.5f, (float)UINT16_MAX);
}

jcal_reject_t jcal_gate_sensor_check(jcal_gate_sensor_t *self, const jcal_gate_config_t *cfg, const jcal_imu_t *imu,
                                     float dt_s)
{
    float now[6];
    unpack(imu, now);
    const unsigned repeats[2] = {repeats_of(&self->last[0], &now[0]), repeats_of(&self->last[3], &now[3])};
    const bool repeated = (repeats[0] & repeats[1] & BIT(ALL_STAND)) != 0u;
    self->repeated = repeated ? stood_for(self, dt_s) : 0u;
    if (exceeds(&now[3], cfg->acc_max_m_s2)) {
        return JCAL_REJECT_OUT_OF_RANGE; /* no force that a sensor feels: nothing to learn of gravity or of its range */
    }
    self->gravity_m_s2 += share_of(dt_s, GRAVITY_TIME_S) * (jcal_vec3_norm(imu->acc_m_s2) - self->gravity_m_s2);
    const jcal_reject_t cause = compare(self, cfg, now, repeats, dt_s);
    if (exceeds(&now[0], cfg->gyr_max_rad_s)) {
        remember_beyond(self, cfg, now);
        return JCAL_REJECT_OUT_OF_RANGE;
    }
    remember(self, cfg, now);
    const bool wrong = jcal_gate_sensor_acc_looks_wrong(self) || jcal_gate_sensor_gyr_looks_wrong(self);
    return wrong ? JCAL_REJECT_OUT_OF_RANGE : cause;
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Ticks of two sensors for one joint. See levers/ticks.h.
#include "levers/ticks.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

/// Squared rates of both sensors at which a moment counts half, (rad/s)^2, and the time that they are smoothed over, s.
#define REST_RATE2 0.3f
#define RATE_SMOOTHING_S 0.1f

#define GRAVITY_M_S2 9.81f

/// Time after a gap that filters are cold for, s. 1, 2 and 3 s were tried on a person's knee over a bad wire (docs/METHOD_PEOPLE.md).
#define COLD_S 2.0f

/// Age of an epoch after a gap from which its mean specific force is a mean, s. A person's trunk and legs go up and down at 1 to 3 m/s^2, rms, and
/// of that 0.3 m/s^2 is left in the mean of 10 s, 0.6 m/s^2 in that of 3 s: as much as is not to be trusted.
#define GRAVITY_S 20.0f

/// Longest distance of two ticks, s: sensor.h makes them at most 0.16 s apart. Largest sum of the squares of a tick's numbers: rates of
/// 200 rad/s and velocities of 1600 m/s, the limits of sensor.h, make 4e6.
#define TICK_MAX_S 0.4f
#define SQUARES_MAX 1e7f

/// Sum of the squares of a matrix (3 x 3).
static float squares(const float *m)
{
    return (m[0] * m[0]) + (m[1] * m[1]) + (m[2] * m[2]) + (m[3] * m[3]) + (m[4] * m[4]) + (m[5] * m[5]) +
           (m[6] * m[6]) + (m[7] * m[7]) + (m[8] * m[8]);
}

/// True if a tick is one that a sensor can make: its numbers are finite, and no product of them overflows.
static bool is_possible(const jcal_tick_t *tick)
{
    const float all = squares(tick->turn) + squares(tick->rate) + squares(tick->lever) +
                      jcal_vec3_dot(tick->velocity, tick->velocity) + jcal_vec3_dot(tick->gyr, tick->gyr) +
                      (tick->acc_level_m_s2 * tick->acc_level_m_s2);
    return (all <= SQUARES_MAX) && (tick->dt_s > 0.0f) && (tick->dt_s <= TICK_MAX_S);
}

static bool is_young(const jcal_tick_t *tick)
{
    return (tick->epoch > 1u) && (tick->since_s < GRAVITY_S);
}

/// How far a sensor's mean is from gravity; 0 if it is young, and something is known.
static float off_of(const jcal_tick_pair_t *self, const jcal_tick_t *tick)
{
    return (self->has_gravity && is_young(tick)) ? 0.0f : fabsf(tick->acc_level_m_s2 - GRAVITY_M_S2);
}

/// A gap of either sensor is no news of its accelerometer: what was known stands until there is a mean again, unless the other one speaks.
static void take_gravity(jcal_tick_pair_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    const bool held = is_young(tick1) || is_young(tick2);
    const float off = jcal_max(off_of(self, tick1), off_of(self, tick2));
    self->gravity_off = (held && self->has_gravity) ? jcal_max(off, self->gravity_off) : off;
    self->has_gravity = self->has_gravity || !held;
}

jcal_ticks_t jcal_ticks_take(jcal_tick_pair_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    const bool in_order = !self->has_tick || (tick1->t_us > self->last_us);
    if ((tick1->t_us != tick2->t_us) || !in_order || !is_possible(tick1) || !is_possible(tick2)) {
        return JCAL_TICKS_REJECTED;
    }
    const bool goes_on = !self->has_tick || ((tick1->epoch == self->epoch1) && (tick2->epoch == self->epoch2));
    self->has_tick = true;
    self->epoch1 = tick1->epoch;
    self->epoch2 = tick2->epoch;
    self->last_us = tick1->t_us;
    self->count += 1u;
    take_gravity(self, tick1, tick2);
    return goes_on ? JCAL_TICKS_GO_ON : JCAL_TICKS_ANEW;
}

jcal_tick_weights_t jcal_ticks_weigh(jcal_tick_pair_t *self, const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    const float period_s = tick1->dt_s;
    const float rate2 = jcal_vec3_dot(tick1->gyr, tick1->gyr) + jcal_vec3_dot(tick2->gyr, tick2->gyr);
    self->rate2 += (period_s / (period_s + RATE_SMOOTHING_S)) * (rate2 - self->rate2);
    const float share = 1.0f / (self->rate2 + REST_RATE2);
    const jcal_tick_weights_t weights = {
        .motion_s = period_s * self->rate2 * share,
        .spin = period_s * self->rate2 * share * share,
        .rate2 = self->rate2,
    };
    return weights;
}

static bool is_cold(const jcal_tick_t *tick)
{
    return (tick->epoch > 1u) && (tick->since_s < COLD_S);
}

bool jcal_ticks_are_cold(const jcal_tick_t *tick1, const jcal_tick_t *tick2)
{
    return is_cold(tick1) || is_cold(tick2);
}

void jcal_ticks_forget(jcal_tick_pair_t *self)
{
    self->rate2 = 0.0f;
    self->gravity_off = 0.0f;
    self->has_gravity = false;
    self->has_tick = true;
}

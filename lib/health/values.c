/* SPDX-License-Identifier: MIT */
/// @file
/// Values that stay. See health/values.h.
#include "health/values.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

/// A reading in motion: rate, rad/s, or change of the specific force, as a share.
#define MOVING_RAD_S 0.5f
#define MOVING_SHARE 0.05f
/// Readings in motion in which a dead component did not change.
#define STUCK_MIN 150u
#define STUCK_MOST 255u
/// Readings in motion that are enough to tell how often each comes, and share of repeated ones from which on they are held: one packet in three that is
/// lost repeats fewer.
#define MOVING_MIN 100u
#define MOVING_MOST 60000u
#define HELD_SHARE 0.45f
#define TIMES_MOST 1000.0f

static bool is_same(jcal_vec3_t a, jcal_vec3_t b)
{
    return !(a.x < b.x) && !(a.x > b.x) && !(a.y < b.y) && !(a.y > b.y) && !(a.z < b.z) && !(a.z > b.z);
}

static bool is_moving(const jcal_imu_t *last, const jcal_imu_t *imu)
{
    const float rate2 = jcal_vec3_dot(imu->gyr_rad_s, imu->gyr_rad_s);
    const jcal_vec3_t change = jcal_vec3_sub(imu->acc_m_s2, last->acc_m_s2);
    const float acc2 = jcal_vec3_dot(imu->acc_m_s2, imu->acc_m_s2);
    return (rate2 > (MOVING_RAD_S * MOVING_RAD_S)) ||
           (jcal_vec3_dot(change, change) > (MOVING_SHARE * MOVING_SHARE * acc2));
}

static void count_stuck(jcal_health_values_t *self, const jcal_imu_t *imu, bool is_counted)
{
    const float now[6] = {imu->gyr_rad_s.x, imu->gyr_rad_s.y, imu->gyr_rad_s.z,
                          imu->acc_m_s2.x,  imu->acc_m_s2.y,  imu->acc_m_s2.z};
    const jcal_imu_t *const last = &self->last;
    const float before[6] = {last->gyr_rad_s.x, last->gyr_rad_s.y, last->gyr_rad_s.z,
                             last->acc_m_s2.x,  last->acc_m_s2.y,  last->acc_m_s2.z};
    for (unsigned k = 0u; k < 6u; ++k) {
        if ((now[k] < before[k]) || (now[k] > before[k])) {
            self->stuck[k] = 0u;
        } else if (is_counted && (self->stuck[k] < STUCK_MOST)) {
            self->stuck[k] = (uint8_t)(self->stuck[k] + 1u);
        } else {
            /* at rest, or long enough */
        }
    }
}

static void count_held(jcal_health_values_t *self, bool same_gyr, bool same_acc)
{
    self->moving = (uint16_t)(self->moving + 1u);
    self->both_held = (uint16_t)(self->both_held + ((same_gyr && same_acc) ? 1u : 0u));
    self->gyr_held = (uint16_t)(self->gyr_held + ((same_gyr && !same_acc) ? 1u : 0u));
    self->acc_held = (uint16_t)(self->acc_held + ((same_acc && !same_gyr) ? 1u : 0u));
    if (self->moving > MOVING_MOST) {
        self->moving = (uint16_t)(self->moving / 2u);
        self->both_held = (uint16_t)(self->both_held / 2u);
        self->gyr_held = (uint16_t)(self->gyr_held / 2u);
        self->acc_held = (uint16_t)(self->acc_held / 2u);
    }
}

void jcal_health_values_add(jcal_health_values_t *self, const jcal_imu_t *imu, uint32_t dt_us)
{
    const bool same_gyr = is_same(imu->gyr_rad_s, self->last.gyr_rad_s);
    const bool same_acc = is_same(imu->acc_m_s2, self->last.acc_m_s2);
    const bool same = same_gyr && same_acc;
    const bool moving = is_moving(&self->last, imu);
    const uint32_t room_us = UINT32_MAX - self->same_us;
    self->same_us = same ? (self->same_us + ((dt_us < room_us) ? dt_us : room_us)) : 0u;
    self->frozen_us = (self->same_us > self->frozen_us) ? self->same_us : self->frozen_us;
    count_stuck(self, imu, moving && !same);
    if (moving) {
        count_held(self, same_gyr, same_acc);
    }
    self->last = *imu;
}

uint8_t jcal_health_values_dead(const jcal_health_values_t *self)
{
    unsigned bits = 0u;
    for (unsigned k = 0u; k < 6u; ++k) {
        bits |= (self->stuck[k] >= STUCK_MIN) ? (1u << k) : 0u;
    }
    return (uint8_t)bits;
}

float jcal_health_values_times(const jcal_health_values_t *self)
{
    if (self->moving < MOVING_MIN) {
        return 0.0f;
    }
    const float acc = (float)self->acc_held;
    const float gyr = (float)self->gyr_held;
    const float held = (float)self->both_held + jcal_max(acc, gyr);
    const float share = held / (float)self->moving;
    return (share < HELD_SHARE) ? 1.0f : jcal_min(1.0f / (1.0f - jcal_min(share, 0.999f)), TIMES_MOST);
}

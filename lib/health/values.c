/* SPDX-License-Identifier: MIT */
/// @file
/// Values that stay. See health/values.h.
#include "health/values.h"

#include "jointcal/vec3.h"
#include "math/scalar.h"

#include <string.h>

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

/// True if a value is not the one before, bit by bit.
static bool differs(const float *now, const float *before)
{
    uint32_t a = 0u;
    uint32_t b = 0u;
    (void)memcpy(&a, now, sizeof a);
    (void)memcpy(&b, before, sizeof b);
    return a != b;
}

static bool is_moving(const jcal_imu_t *last, const jcal_imu_t *imu, const jcal_health_squares_t *squares)
{
    const jcal_vec3_t change = jcal_vec3_sub(imu->acc_m_s2, last->acc_m_s2);
    return (squares->rate2 > (MOVING_RAD_S * MOVING_RAD_S)) ||
           (jcal_vec3_dot(change, change) > (MOVING_SHARE * MOVING_SHARE * squares->acc2));
}

/// The component's count after this reading. `more` is 0 at rest, and with a reading that is repeated.
static uint8_t stuck_after(uint8_t stuck, bool has_changed, unsigned more)
{
    const unsigned sum = stuck + more;
    return (uint8_t)(has_changed ? 0u : ((sum < STUCK_MOST) ? sum : STUCK_MOST));
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

void jcal_health_values_add(jcal_health_values_t *self, const jcal_imu_t *imu, const jcal_health_squares_t *squares,
                            uint32_t dt_us)
{
    const jcal_imu_t *const last = &self->last;
    const bool gx = differs(&imu->gyr_rad_s.x, &last->gyr_rad_s.x);
    const bool gy = differs(&imu->gyr_rad_s.y, &last->gyr_rad_s.y);
    const bool gz = differs(&imu->gyr_rad_s.z, &last->gyr_rad_s.z);
    const bool ax = differs(&imu->acc_m_s2.x, &last->acc_m_s2.x);
    const bool ay = differs(&imu->acc_m_s2.y, &last->acc_m_s2.y);
    const bool az = differs(&imu->acc_m_s2.z, &last->acc_m_s2.z);
    const bool same_gyr = !gx && !gy && !gz;
    const bool same_acc = !ax && !ay && !az;
    const bool same = same_gyr && same_acc;
    const bool moving = is_moving(&self->last, imu, squares);
    const uint32_t room_us = UINT32_MAX - self->same_us;
    self->same_us = same ? (self->same_us + ((dt_us < room_us) ? dt_us : room_us)) : 0u;
    self->frozen_us = (self->same_us > self->frozen_us) ? self->same_us : self->frozen_us;
    const unsigned more = (moving && !same) ? 1u : 0u;
    self->stuck[0] = stuck_after(self->stuck[0], gx, more);
    self->stuck[1] = stuck_after(self->stuck[1], gy, more);
    self->stuck[2] = stuck_after(self->stuck[2], gz, more);
    self->stuck[3] = stuck_after(self->stuck[3], ax, more);
    self->stuck[4] = stuck_after(self->stuck[4], ay, more);
    self->stuck[5] = stuck_after(self->stuck[5], az, more);
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

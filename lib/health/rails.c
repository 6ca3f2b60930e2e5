/* SPDX-License-Identifier: MIT */
/// @file
/// Where components stop. See health/rails.h.
#include "health/rails.h"

#include "math/scalar.h"

/// Units of levels: rad/s, m/s^2.
#define GYR_UNIT (1.0f / 256.0f)
#define ACC_UNIT (1.0f / 16.0f)
/// No gyroscope stops below 1 rad/s, no accelerometer below 1.4 g.
#define GYR_FLOOR 256u
#define ACC_FLOOR 224u
#define VALUE_MOST 65000.0f

/// Shares in 1/1024: near the top, below it, and where an excursion ends.
#define TOP_1024 998u
#define SIDE_1024 819u
#define END_1024 717u
/// Levels that are one: within this.
#define SAME_1024 26u
/// Readings near the top of a flat peak.
#define TOP_MIN 3u
/// Readings on the way down, to 80 % of the top, for so many near the top: a smooth peak has about as many.
#define FLAT_RATIO 2u
/// Flat peaks at one level, and how many times as many as what speaks against it.
#define HITS_MIN 4u
#define HITS_RATIO 2u
#define COUNT_MOST 200u

static uint16_t part_of(uint16_t value, uint32_t share_1024)
{
    return (uint16_t)(((uint32_t)value * share_1024) / 1024u);
}

static bool is_flat(const jcal_health_rail_t *rail)
{
    return (rail->top >= TOP_MIN) && (rail->top > (FLAT_RATIO * rail->side));
}

/// A flat peak moves the level to itself if it is higher; what was counted at the old one was none.
static void count_peak(jcal_health_rail_t *rail)
{
    const uint16_t slack = part_of(rail->level, SAME_1024);
    const bool is_above = (rail->peak > slack) && ((uint16_t)(rail->peak - slack) > rail->level);
    const bool is_at = !is_above && ((uint32_t)rail->peak + slack >= rail->level);
    if (is_flat(rail) && is_above) {
        rail->level = rail->peak;
        rail->hits = 1u;
        rail->against = 0u;
    } else if (is_flat(rail) && is_at) {
        rail->hits = (uint8_t)(rail->hits + 1u);
    } else if (is_above != is_flat(rail)) {
        rail->against = (uint8_t)(rail->against + 1u); /* a round peak above the level, or a flat one below it */
    } else {
        /* a round peak at the level grazed it; one below says nothing */
    }
    if ((rail->hits > COUNT_MOST) || (rail->against > COUNT_MOST)) {
        rail->hits = (uint8_t)(rail->hits / 2u);
        rail->against = (uint8_t)(rail->against / 2u);
    }
}

static void go_on(jcal_health_rail_t *rail, uint16_t value)
{
    if (value > rail->peak) {
        if (part_of(value, TOP_1024) > rail->base) {
            rail->base = value;
            rail->side = 0u;
            rail->top = 0u;
        }
        rail->peak = value;
    }
    if (value >= part_of(rail->peak, TOP_1024)) {
        rail->top = (uint8_t)(rail->top + ((rail->top < COUNT_MOST / 2u) ? 1u : 0u));
    } else if (value >= part_of(rail->peak, SIDE_1024)) {
        rail->side = (uint8_t)(rail->side + ((rail->side < COUNT_MOST / 2u) ? 1u : 0u));
    } else {
        /* on its way down */
    }
}

static void add_side(jcal_health_rail_t *rail, float value, uint16_t least)
{
    const uint16_t whole = (uint16_t)jcal_min(jcal_max(value, 0.0f), VALUE_MOST);
    if (rail->peak == 0u) {
        if (whole < least) {
            return;
        }
        rail->base = 0u;
    }
    if (whole >= part_of(rail->peak, END_1024)) {
        go_on(rail, whole);
        return;
    }
    if (rail->peak < (uint16_t)VALUE_MOST) {
        count_peak(rail);
    }
    rail->peak = 0u;
}

void jcal_health_rails_add(jcal_health_rail_t rails[6][2], const jcal_imu_t *imu)
{
    const float values[6] = {imu->gyr_rad_s.x * (1.0f / GYR_UNIT), imu->gyr_rad_s.y * (1.0f / GYR_UNIT),
                             imu->gyr_rad_s.z * (1.0f / GYR_UNIT), imu->acc_m_s2.x * (1.0f / ACC_UNIT),
                             imu->acc_m_s2.y * (1.0f / ACC_UNIT),  imu->acc_m_s2.z * (1.0f / ACC_UNIT)};
    for (unsigned k = 0u; k < 6u; ++k) {
        const uint16_t least = (k < 3u) ? GYR_FLOOR : ACC_FLOOR;
        const bool is_low = (values[k] < (float)least) && (values[k] > -(float)least);
        if (is_low && (rails[k][0].peak == 0u) && (rails[k][1].peak == 0u)) {
            continue;
        }
        add_side(&rails[k][0], values[k], least);
        add_side(&rails[k][1], -values[k], least);
    }
}

bool jcal_health_rail_clips(const jcal_health_rail_t *rail)
{
    return (rail->hits >= HITS_MIN) && (rail->hits >= (HITS_RATIO * rail->against));
}

float jcal_health_rail_level(const jcal_health_rail_t *rail, unsigned component)
{
    return (float)rail->level * ((component < 3u) ? GYR_UNIT : ACC_UNIT);
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Where components stop. See health/rails.h.
#include "health/rails.h"

#include "math/scalar.h"

#include <math.h>

/// Units of levels: rad/s, m/s^2.
#define GYR_UNIT (1.0f / 256.0f)
#define ACC_UNIT (1.0f / 16.0f)
/// No gyroscope stops below 1 rad/s, no accelerometer below 1.4 g.
#define GYR_FLOOR 1.0f
#define ACC_FLOOR 14.0f
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

static bool is_flat(const jcal_health_peak_t *peak)
{
    return (peak->top >= TOP_MIN) && (peak->top > (FLAT_RATIO * peak->side));
}

/// A flat peak moves the level to itself if it is higher; what was counted at the old one was none.
static void count_peak(jcal_health_rail_t *rail, const jcal_health_peak_t *peak)
{
    const uint16_t slack = part_of(rail->level, SAME_1024);
    const bool is_above = (peak->peak > slack) && ((uint16_t)(peak->peak - slack) > rail->level);
    const bool is_at = !is_above && ((uint32_t)peak->peak + slack >= rail->level);
    if (is_flat(peak) && is_above) {
        rail->level = peak->peak;
        rail->hits = 1u;
        rail->against = 0u;
    } else if (is_flat(peak) && is_at) {
        rail->hits = (uint8_t)(rail->hits + 1u);
    } else if (is_above != is_flat(peak)) {
        rail->against = (uint8_t)(rail->against + 1u); /* a round peak above the level, or a flat one below it */
    } else {
        /* a round peak at the level grazed it; one below says nothing */
    }
    if ((rail->hits > COUNT_MOST) || (rail->against > COUNT_MOST)) {
        rail->hits = (uint8_t)(rail->hits / 2u);
        rail->against = (uint8_t)(rail->against / 2u);
    }
}

static void go_on(jcal_health_peak_t *peak, uint16_t value)
{
    if (value > peak->peak) {
        if (part_of(value, TOP_1024) > peak->base) {
            peak->base = value;
            peak->side = 0u;
            peak->top = 0u;
        }
        peak->peak = value;
    }
    if (value >= part_of(peak->peak, TOP_1024)) {
        peak->top = (uint8_t)(peak->top + ((peak->top < COUNT_MOST / 2u) ? 1u : 0u));
    } else if (value >= part_of(peak->peak, SIDE_1024)) {
        peak->side = (uint8_t)(peak->side + ((peak->side < COUNT_MOST / 2u) ? 1u : 0u));
    } else {
        /* on its way down */
    }
}

/// The value of a side in whole units, not below 0.
static uint16_t whole_of(float value, bool is_lower, bool is_gyr)
{
    const float units = (is_lower ? -value : value) * (is_gyr ? (1.0f / GYR_UNIT) : (1.0f / ACC_UNIT));
    return (uint16_t)jcal_min(jcal_max(units, 0.0f), VALUE_MOST);
}

/// Goes on with the excursion of component k; false if it has ended.
static bool go_on_out(jcal_health_rails_t *self, unsigned k, float value)
{
    jcal_health_peak_t *const peak = &self->peak[k];
    const unsigned side = ((unsigned)self->is_lower >> k) & 1u;
    const uint16_t whole = whole_of(value, side != 0u, k < 3u);
    if (whole >= part_of(peak->peak, END_1024)) {
        go_on(peak, whole);
        return true;
    }
    if (peak->peak < (uint16_t)VALUE_MOST) {
        count_peak(&self->rail[k][side], peak);
    }
    self->is_out = (uint8_t)(self->is_out & ~(1u << k));
    return false;
}

/// Component k goes beyond its floor.
static void begin_out(jcal_health_rails_t *self, unsigned k, float value)
{
    const unsigned bit = 1u << k;
    const bool is_lower = value < 0.0f;
    self->is_out = (uint8_t)(self->is_out | bit);
    self->is_lower = (uint8_t)(is_lower ? (self->is_lower | bit) : (self->is_lower & ~bit));
    self->peak[k].peak = 0u;
    self->peak[k].base = 0u;
    go_on(&self->peak[k], whole_of(value, is_lower, k < 3u));
}

static void add_component(jcal_health_rails_t *self, unsigned k, float value, float least)
{
    const bool was_out = (((unsigned)self->is_out >> k) & 1u) != 0u;
    const bool was_lower = (((unsigned)self->is_lower >> k) & 1u) != 0u;
    if (was_out && go_on_out(self, k, value)) {
        return;
    }
    /* the side that was left begins no new one with the same reading */
    if ((fabsf(value) >= least) && !(was_out && (was_lower == (value < 0.0f)))) {
        begin_out(self, k, value);
    }
}

/// Most components are below their floors most of the time.
static inline void look_at(jcal_health_rails_t *self, unsigned k, float value, float least)
{
    if ((fabsf(value) >= least) || ((((unsigned)self->is_out >> k) & 1u) != 0u)) {
        add_component(self, k, value, least);
    }
}

void jcal_health_rails_add(jcal_health_rails_t *self, const jcal_imu_t *imu)
{
    look_at(self, 0u, imu->gyr_rad_s.x, GYR_FLOOR);
    look_at(self, 1u, imu->gyr_rad_s.y, GYR_FLOOR);
    look_at(self, 2u, imu->gyr_rad_s.z, GYR_FLOOR);
    look_at(self, 3u, imu->acc_m_s2.x, ACC_FLOOR);
    look_at(self, 4u, imu->acc_m_s2.y, ACC_FLOOR);
    look_at(self, 5u, imu->acc_m_s2.z, ACC_FLOOR);
}

bool jcal_health_rail_clips(const jcal_health_rail_t *rail)
{
    return (rail->hits >= HITS_MIN) && (rail->hits >= (HITS_RATIO * rail->against));
}

float jcal_health_rail_level(const jcal_health_rail_t *rail, unsigned component)
{
    return (float)rail->level * ((component < 3u) ? GYR_UNIT : ACC_UNIT);
}

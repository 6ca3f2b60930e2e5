/* SPDX-License-Identifier: MIT */
/// @file
/// A made-up sensor that turns and does not move, in double precision: rates, gravity, and what is done to both.
#ifndef HEALTH_FIXTURE_H
#define HEALTH_FIXTURE_H

#include "jointcal/health.h"
#include "unity.h"

#include <math.h>
#include <string.h>

#define GRAVITY 9.81

typedef struct {
    double t_s;
    double r[9]; /* sensor to earth, row by row */
    uint32_t noise;
} world_t;

static inline world_t world_begin(void)
{
    const world_t world = {0.0, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0}, 12345u};
    return world;
}

/* Uniform in [-1, 1]. */
static inline double world_noise(world_t *world)
{
    world->noise = world->noise * 1664525u + 1013904223u;
    return (double)(world->noise >> 8) / 8388608.0 - 1.0;
}

/* R <- R exp(v), by the series of exp, to the sixth power. */
static inline void world_turn(double r[9], const double v[3])
{
    const double k[9] = {0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0};
    double term[9];
    memcpy(term, r, sizeof(term));
    for (int n = 1; n <= 6; ++n) {
        double next[9] = {0.0};
        for (int i = 0; i < 9; ++i) {
            for (int m = 0; m < 3; ++m) {
                next[i] += term[3 * (i / 3) + m] * k[3 * m + i % 3] / n;
            }
        }
        memcpy(term, next, sizeof(term));
        for (int i = 0; i < 9; ++i) {
            r[i] += term[i];
        }
    }
}

/* The reading after dt_s: w is the mean rate over that time, the force that in its middle. A little noise, as all sensors have. */
static inline jcal_imu_t world_step(world_t *world, const double w[3], double dt_s)
{
    const double half[3] = {0.5 * dt_s * w[0], 0.5 * dt_s * w[1], 0.5 * dt_s * w[2]};
    world_turn(world->r, half);
    const double n = 1e-3;
    jcal_imu_t imu;
    imu.acc_m_s2.x = (float)(GRAVITY * world->r[6] + n * world_noise(world));
    imu.acc_m_s2.y = (float)(GRAVITY * world->r[7] + n * world_noise(world));
    imu.acc_m_s2.z = (float)(GRAVITY * world->r[8] + n * world_noise(world));
    imu.gyr_rad_s.x = (float)(w[0] + n * world_noise(world));
    imu.gyr_rad_s.y = (float)(w[1] + n * world_noise(world));
    imu.gyr_rad_s.z = (float)(w[2] + n * world_noise(world));
    world_turn(world->r, half);
    world->t_s += dt_s;
    return imu;
}

/* Rates about all axes, in the middle of the time of the next reading. */
static inline void world_rates(const world_t *world, double dt_s, double w[3])
{
    const double t = world->t_s + 0.5 * dt_s;
    w[0] = 1.1 * sin(0.9 * t) + 0.3 * sin(2.3 * t);
    w[1] = 0.9 * cos(0.61 * t) + 0.2 * sin(1.9 * t);
    w[2] = 0.8 * sin(0.37 * t + 1.0);
}

typedef void (*spoil_t)(jcal_imu_t *imu, double t_s);

/* So many seconds of it, at 50 Hz, each reading spoilt; returns what is said. */
static inline jcal_health_result_t said_after(jcal_health_t *health, double seconds, spoil_t spoil)
{
    const double dt_s = 0.02;
    world_t world = world_begin();
    for (int k = 0; k < (int)(seconds / dt_s); ++k) {
        double w[3];
        world_rates(&world, dt_s, w);
        jcal_reading_t reading = {(uint64_t)(k + 1) * 20000u, world_step(&world, w, dt_s)};
        if (spoil != NULL) {
            spoil(&reading.imu, world.t_s);
        }
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_health_push(health, &reading));
    }
    jcal_health_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_health_get(health, &result));
    return result;
}

#endif /* HEALTH_FIXTURE_H */

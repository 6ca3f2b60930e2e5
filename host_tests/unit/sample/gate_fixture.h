/* SPDX-License-Identifier: MIT */
/// @file
/// One gate, a clock, and samples that it accepts.
#ifndef GATE_FIXTURE_H
#define GATE_FIXTURE_H

#include "jointcal/gate.h"
#include "jointcal/vec3.h"
#include "unity.h"

#include <math.h>
#include <string.h>

enum { STEP_US = 20000 };

static jcal_gate_config_t config;
static jcal_gate_t gate;
static uint64_t now_us;
static uint32_t number;

void setUp(void)
{
    config = jcal_gate_config_default();
    memset(&gate, 0x5a, sizeof gate);
    jcal_gate_init(&gate);
    now_us = 5000000u;
    number = 0u;
}

void tearDown(void)
{
}

/* A believable pair that differs from all before it and stays below their extremes. */
static inline jcal_pair_t good(void)
{
    const float wiggle = ((number % 2u) == 0u) ? 0.01f : -0.01f;
    const float drift = 0.1f / (1.0f + (float)number);
    const jcal_imu_t imu = {{0.1f + drift + wiggle, -0.1f - drift - wiggle, 0.05f + drift + wiggle},
                            {1.0f + drift + wiggle, 1.0f + drift - wiggle, 9.6f + drift + wiggle}};
    now_us += STEP_US;
    ++number;
    const jcal_pair_t pair = {now_us, imu, imu};
    return pair;
}

static inline jcal_reject_t check(const jcal_pair_t *pair)
{
    return jcal_gate_check(&gate, &config, pair);
}

static inline void accept(uint32_t count)
{
    for (uint32_t k = 0; k < count; ++k) {
        const jcal_pair_t pair = good();
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
}

static inline float *component(jcal_pair_t *pair, int field)
{
    float *const vectors[4] = {&pair->imu1.gyr_rad_s.x, &pair->imu1.acc_m_s2.x, &pair->imu2.gyr_rad_s.x,
                               &pair->imu2.acc_m_s2.x};
    return &vectors[field / 3][field % 3];
}

static inline bool is_rate(int field)
{
    return (field / 3) % 2 == 0;
}

#endif /* GATE_FIXTURE_H */

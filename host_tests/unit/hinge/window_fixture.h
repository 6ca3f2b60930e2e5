/* SPDX-License-Identifier: MIT */
/// @file
/// One window engine with small buffers, and what its tests share.
#ifndef HINGE_WINDOW_FIXTURE_H
#define HINGE_WINDOW_FIXTURE_H

#include "jointcal/hinge_window.h"

#include "unit/hinge/motion.h"

#include <math.h>
#include <string.h>

/* Seven times as many samples as are kept; on an emulated target, which may compute floats in software, four times. */
#if defined(JCAL_TEST_SHORT)
enum { RUN = 800 };
#else
enum { RUN = 1500 };
#endif
enum { N_MAX = 200, HALF_WINDOW = 10, BYTES = JCAL_HINGE_WINDOW_STORAGE_BYTES(N_MAX, HALF_WINDOW) };

static float storage[BYTES / sizeof(float)];
static float storage2[BYTES / sizeof(float)];
static jcal_hinge_window_config_t config;
static jcal_hinge_window_t engine;

void setUp(void)
{
    config = jcal_hinge_window_config_default();
    config.n_max = N_MAX;
    config.half_window = HALF_WINDOW;
    config.acc_min = N_MAX / 2;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
}

void tearDown(void)
{
}

static inline void run(jcal_hinge_window_t *self, const motion_t *motion, uint32_t begin, uint32_t end)
{
    for (uint32_t k = begin; k < end; ++k) {
        const jcal_pair_t pair = motion_sample(motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_update(self, &pair));
    }
}

static inline jcal_hinge_result_t result_of(const jcal_hinge_window_t *self)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_get(self, &result));
    return result;
}

#endif /* HINGE_WINDOW_FIXTURE_H */

/* SPDX-License-Identifier: MIT */
/// @file
/// What the tests of the 2-DoF window engine share: an engine, and a simulated joint in motion.
#ifndef JCAL_TEST_TWO_DOF_WINDOW_FIXTURE_H
#define JCAL_TEST_TWO_DOF_WINDOW_FIXTURE_H

#include "jointcal/two_dof_window.h"
#include "unit/two_dof/motion.h"

#include "unity.h"

#define N_MAX 200u

static uint64_t storage[JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t)];
static jcal_two_dof_window_t engine;
static jcal_two_dof_window_config_t config;

void setUp(void)
{
    config = jcal_two_dof_window_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_init(&engine, &config, storage, sizeof storage));
}

void tearDown(void)
{
}

static inline jcal_two_dof_result_t result_of(const jcal_two_dof_window_t *self)
{
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_get(self, &result));
    return result;
}

static inline void feed(jcal_two_dof_window_t *self, const sim_t *sim, uint32_t from, uint32_t to)
{
    for (uint32_t k = from; k < to; ++k) {
        const jcal_orientation_pair_t pair = sample_of(sim, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_update(self, &pair));
    }
}

#endif /* JCAL_TEST_TWO_DOF_WINDOW_FIXTURE_H */

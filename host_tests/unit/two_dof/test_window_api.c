/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/two_dof_window.h: what it takes, refuses, keeps and forgets.
#include "unit/two_dof/window_fixture.h"

#include <string.h>

static uint64_t storage2[JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(N_MAX) / sizeof(uint64_t)];

static void there_is_no_estimate_before_the_buffer_is_half_full(void)
{
    const sim_t sim = lively(2);
    /* Rows come every 5 samples from the eleventh on: number 100 with sample 10 + 99 * 5. */
    feed(&engine, &sim, 0, 505);
    const jcal_two_dof_result_t before = result_of(&engine);
    TEST_ASSERT_FALSE(before.has_axes);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, before.head.reason);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, before.axis1.x);
    feed(&engine, &sim, 505, 506 + 14 * 5); /* a start, and at most 14 steps, two passes for each row */
    TEST_ASSERT_TRUE(result_of(&engine).has_axes);
}

static void the_last_samples_at_least_50_ms_apart_are_kept(void)
{
    const sim_t sim = lively(2);
    uint64_t kept[N_MAX];
    size_t count = N_MAX;
    feed(&engine, &sim, 0, 5 * 60 + 1); /* 61 orientations */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_kept(&engine, kept, &count));
    TEST_ASSERT_EQUAL_UINT(59, count);
    TEST_ASSERT_TRUE(kept[0] == 5050000u);
    TEST_ASSERT_TRUE(result_of(&engine).head.t_us == kept[58]);
    feed(&engine, &sim, 5 * 60 + 1, 5 * 300 + 1);
    count = N_MAX - 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_kept(&engine, kept, &count));
    count = N_MAX;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_kept(&engine, kept, &count));
    TEST_ASSERT_EQUAL_UINT(N_MAX, count);
    for (size_t k = 0; k < count; ++k) {
        TEST_ASSERT_TRUE(kept[k] == 5000000u + (uint64_t)(100u + k) * 50000u);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_kept(NULL, kept, &count));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_kept(&engine, NULL, &count));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_kept(&engine, kept, NULL));
}

static void orientations_beside_a_gap_make_no_rate(void)
{
    const sim_t sim = lively(2);
    uint64_t kept[N_MAX];
    size_t count = N_MAX;
    feed(&engine, &sim, 0, 51);   /* kept at 0, 50, ... 500 ms */
    feed(&engine, &sim, 70, 121); /* and at 700, ... 1200 ms */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_kept(&engine, kept, &count));
    TEST_ASSERT_EQUAL_UINT(9 + 9, count);
    TEST_ASSERT_TRUE(kept[8] == 5450000u);
    TEST_ASSERT_TRUE(kept[9] == 5750000u);
}

static void a_push_waits_for_its_step(void)
{
    const sim_t sim = lively(1);
    jcal_orientation_pair_t pair = sample_of(&sim, 0);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_two_dof_window_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_push(&engine, &pair));
    pair = sample_of(&sim, 1);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_push(&engine, &pair)); /* too early to be kept */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_two_dof_window_step(&engine));
    pair = sample_of(&sim, 5);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_push(&engine, &pair));
    pair = sample_of(&sim, 10);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_update(&engine, &pair)); /* works off both */
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_two_dof_window_step(&engine));
    TEST_ASSERT_EQUAL_UINT32(4, result_of(&engine).head.samples);
}

static void bad_orientations_are_rejected_and_counted(void)
{
    const sim_t sim = lively(1);
    jcal_orientation_pair_t pair = sample_of(&sim, 3);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_update(&engine, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_dof_window_update(&engine, &pair));
    pair = sample_of(&sim, 4);
    pair.q1.x = NAN;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_dof_window_update(&engine, &pair));
    pair = sample_of(&sim, 5);
    pair.q2 = (jcal_quat_t){0.0f, 0.0f, 0.0f, 0.0f};
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_two_dof_window_update(&engine, &pair));
    const jcal_two_dof_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_UINT32(4, r.head.samples);
    TEST_ASSERT_EQUAL_UINT32(3, r.head.rejected);
    TEST_ASSERT_EQUAL_UINT32(1, r.head.rejected_by[JCAL_REJECT_TIME_ORDER]);
    TEST_ASSERT_EQUAL_UINT32(1, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_UINT32(1, r.head.rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
}

static void configs_out_of_range_are_refused(void)
{
    TEST_ASSERT_NULL(jcal_two_dof_window_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_CONSTRAINT_ROTATION, config.two_dof.constraint);
    TEST_ASSERT_EQUAL_UINT16(200, config.n_max);
    const uint16_t right[2] = {20, 10000}, wrong[3] = {0, 19, 10001};
    for (int k = 0; k < 2; ++k) {
        config.n_max = right[k];
        TEST_ASSERT_NULL(jcal_two_dof_window_config_check(&config));
        TEST_ASSERT_EQUAL_UINT(JCAL_TWO_DOF_WINDOW_STORAGE_BYTES(right[k]), jcal_two_dof_window_storage_bytes(&config));
    }
    for (int k = 0; k < 3; ++k) {
        config.n_max = wrong[k];
        TEST_ASSERT_EQUAL_STRING("n_max", jcal_two_dof_window_config_check(&config));
    }
    config = jcal_two_dof_window_config_default();
    config.two_dof.constraint = JCAL_CONSTRAINT_COMBINED;
    TEST_ASSERT_EQUAL_STRING("constraint", jcal_two_dof_window_config_check(&config));
    const jcal_two_dof_window_t before = engine;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_two_dof_window_init(&engine, &config, storage, sizeof storage));
    TEST_ASSERT_EQUAL_MEMORY(&before, &engine, sizeof engine);
    config = jcal_two_dof_window_config_default();
    config.two_dof.max_bound_rad = 1.0f;
    TEST_ASSERT_EQUAL_STRING("max_bound_rad", jcal_two_dof_window_config_check(&config));
}

static void storage_that_does_not_fit_is_refused(void)
{
    const jcal_two_dof_window_t before = engine;
    unsigned char *const bytes = (unsigned char *)storage;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_two_dof_window_init(&engine, &config, storage, sizeof storage - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_two_dof_window_attach(&engine, storage, sizeof storage - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_two_dof_window_attach(&engine, bytes + 4, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_two_dof_window_init(&engine, &config, bytes + 4, sizeof storage));
    TEST_ASSERT_EQUAL_MEMORY(&before, &engine, sizeof engine);
}

static void null_is_refused(void)
{
    const sim_t sim = lively(1);
    const jcal_orientation_pair_t pair = sample_of(&sim, 0);
    jcal_two_dof_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_init(NULL, &config, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_init(&engine, NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_init(&engine, &config, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_attach(NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_attach(&engine, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_push(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_update(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_reset(NULL));
}

static void what_was_never_prepared_does_nothing(void)
{
    const sim_t sim = lively(1);
    const jcal_orientation_pair_t pair = sample_of(&sim, 0);
    for (int lack = 0; lack < 3; ++lack) {
        memset(&engine, 0, sizeof engine);
        engine.storage = (lack == 1) ? storage : NULL;
        engine.cfg.n_max = (lack == 2) ? 200u : 0u;
        engine.kept.ring.written = 1u; /* as if one waited */
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_push(&engine, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_step(&engine));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_update(&engine, &pair));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_reset(&engine));
        TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    }
    memset(&engine, 0, sizeof engine);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_two_dof_window_attach(&engine, storage, sizeof storage));
    TEST_ASSERT_EQUAL_STRING("config", jcal_two_dof_window_config_check(NULL));
    TEST_ASSERT_EQUAL_UINT(0, jcal_two_dof_window_storage_bytes(NULL));
}

static void assert_same(const jcal_two_dof_result_t *a, const jcal_two_dof_result_t *b)
{
    TEST_ASSERT_TRUE(a->has_axes);
    TEST_ASSERT_EQUAL_MEMORY(&a->axis1, &b->axis1, sizeof a->axis1);
    TEST_ASSERT_EQUAL_MEMORY(&a->axis2, &b->axis2, sizeof a->axis2);
    TEST_ASSERT_EQUAL_MEMORY(&a->heading_offset_rad, &b->heading_offset_rad, sizeof a->heading_offset_rad);
    TEST_ASSERT_EQUAL_MEMORY(&a->uncertainty1_rad, &b->uncertainty1_rad, sizeof a->uncertainty1_rad);
    TEST_ASSERT_EQUAL_INT(a->head.status, b->head.status);
}

static void reset_a_copy_and_other_times_change_no_bit(void)
{
    const sim_t sim = lively(3), other = lively(4);
    feed(&engine, &sim, 0, 1200);
    const jcal_two_dof_result_t first = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_reset(&engine));
    feed(&engine, &other, 0, 700);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_reset(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    feed(&engine, &sim, 0, 900);
    jcal_two_dof_window_t copy = engine;
    memcpy(storage2, storage, sizeof storage);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_attach(&copy, storage2, sizeof storage2));
    feed(&engine, &sim, 900, 1200);
    const jcal_two_dof_result_t again = result_of(&engine);
    assert_same(&first, &again);
    memset(storage, 0, sizeof storage);
    feed(&copy, &sim, 900, 1200);
    const jcal_two_dof_result_t copied = result_of(&copy);
    assert_same(&first, &copied);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_two_dof_window_reset(&engine));
    for (uint32_t k = 0; k < 1200; ++k) {
        jcal_orientation_pair_t pair = sample_of(&sim, k);
        pair.t_us += UINT64_C(1700000000123457);
        (void)jcal_two_dof_window_update(&engine, &pair);
    }
    const jcal_two_dof_result_t later = result_of(&engine);
    assert_same(&first, &later);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(there_is_no_estimate_before_the_buffer_is_half_full);
    RUN_TEST(the_last_samples_at_least_50_ms_apart_are_kept);
    RUN_TEST(orientations_beside_a_gap_make_no_rate);
    RUN_TEST(a_push_waits_for_its_step);
    RUN_TEST(bad_orientations_are_rejected_and_counted);
    RUN_TEST(configs_out_of_range_are_refused);
    RUN_TEST(storage_that_does_not_fit_is_refused);
    RUN_TEST(null_is_refused);
    RUN_TEST(what_was_never_prepared_does_nothing);
    RUN_TEST(reset_a_copy_and_other_times_change_no_bit);
    return UNITY_END();
}

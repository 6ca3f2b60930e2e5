/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge.h: config, arguments, inbox, copies, counters. What it finds is in hinge/test_stream.c.
#include "unit/hinge/fixture.h"

static void the_default_config_is_valid(void)
{
    const jcal_gate_config_t gate = jcal_gate_config_default();
    TEST_ASSERT_NULL(jcal_hinge_config_check(&config));
    TEST_ASSERT_NULL(jcal_gate_config_check(&gate));
    TEST_ASSERT_EQUAL_FLOAT(3.0f * JCAL_RAD_PER_DEG, config.max_bound_rad);
    TEST_ASSERT_EQUAL_FLOAT(0.002f, config.rate_mismatch);
    TEST_ASSERT_EQUAL_FLOAT(0.03f, config.gyr_noise_rad_s);
    TEST_ASSERT_EQUAL_FLOAT(1.5f, config.acc_noise_m_s2);
    TEST_ASSERT_EQUAL_FLOAT(1.0f, config.lever_arm_m);
    TEST_ASSERT_EQUAL_FLOAT(0.007f, config.gyr_bias_rad_s);
    TEST_ASSERT_EQUAL_FLOAT(0.5f, config.acc_bias_m_s2);
    TEST_ASSERT_EQUAL_INT(JCAL_SIGN_UNKNOWN, config.sign_hint);
    TEST_ASSERT_EQUAL_FLOAT(200.0f, config.slices_per_s);
}

static void every_field_out_of_its_range_is_named(void)
{
    jcal_hinge_config_t c = config;
    const struct {
        const char *name;
        float *field;
        float low, high;
    } fields[] = {
        {"max_bound_rad", &c.max_bound_rad, 0.001f, 0.5f},
        {"rate_mismatch", &c.rate_mismatch, 0.0f, 0.05f},
        {"gyr_noise_rad_s", &c.gyr_noise_rad_s, 1e-4f, 1.0f},
        {"acc_noise_m_s2", &c.acc_noise_m_s2, 1e-3f, 10.0f},
        {"lever_arm_m", &c.lever_arm_m, 0.0f, 5.0f},
        {"gyr_bias_rad_s", &c.gyr_bias_rad_s, 1e-5f, 0.2f},
        {"acc_bias_m_s2", &c.acc_bias_m_s2, 1e-4f, 5.0f},
        {"slices_per_s", &c.slices_per_s, 20.0f, 800.0f},
        {"gate.gyr_max_rad_s", &c.gate.gyr_max_rad_s, 1.0f, 200.0f},
        {"gate.acc_max_m_s2", &c.gate.acc_max_m_s2, 20.0f, 4000.0f},
        {"gate.frozen_s", &c.gate.frozen_s, 0.02f, 10.0f},
        {"gate.gap_s", &c.gate.gap_s, 0.02f, 10.0f},
    };
    for (size_t i = 0; i < sizeof fields / sizeof fields[0]; ++i) {
        const float bad[5] = {nextafterf(fields[i].low, -1.0f), nextafterf(fields[i].high, INFINITY), NAN, INFINITY,
                              -INFINITY};
        for (int k = 0; k < 5; ++k) {
            c = config;
            *fields[i].field = bad[k];
            TEST_ASSERT_EQUAL_STRING(fields[i].name, jcal_hinge_config_check(&c));
            TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_init(&engine, &c));
        }
        c = config;
        *fields[i].field = fields[i].low;
        TEST_ASSERT_NULL(jcal_hinge_config_check(&c));
        *fields[i].field = fields[i].high;
        TEST_ASSERT_NULL(jcal_hinge_config_check(&c));
    }
}

static void a_gyroscope_as_it_comes_needs_a_larger_mismatch(void)
{
    jcal_hinge_config_t c = jcal_hinge_config_default();
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_config_set_gyroscope(&c, JCAL_GYR_CALIBRATED));
    TEST_ASSERT_EQUAL_FLOAT(config.rate_mismatch, c.rate_mismatch); /* that is the default */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_config_set_gyroscope(&c, JCAL_GYR_AS_IT_COMES));
    TEST_ASSERT_EQUAL_FLOAT(0.01f, c.rate_mismatch);
    TEST_ASSERT_NULL(jcal_hinge_config_check(&c));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_config_set_gyroscope(&c, (jcal_gyr_grade_t)2));
    TEST_ASSERT_EQUAL_FLOAT(0.01f, c.rate_mismatch);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_config_set_gyroscope(NULL, JCAL_GYR_CALIBRATED));
}

static void a_sign_hint_that_is_none_is_named(void)
{
    const int beyond[2] = {-1, 3};
    for (int k = 0; k < 2; ++k) {
        memcpy(&config.sign_hint, &beyond[k], sizeof config.sign_hint);
        TEST_ASSERT_EQUAL_STRING("sign_hint", jcal_hinge_config_check(&config));
        TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_init(&engine, &config));
    }
}

static void a_refused_config_leaves_self_untouched(void)
{
    const motion_t motion = motion_lively(1);
    run(&engine, &motion, 0, 300);
    const jcal_hinge_t before = engine;
    config.lever_arm_m = -1.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_init(&engine, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_init(&engine, NULL));
    TEST_ASSERT_EQUAL_MEMORY(&before, &engine, sizeof engine);
}

static void null_arguments_are_refused_everywhere(void)
{
    const motion_t motion = motion_lively(1);
    const jcal_pair_t pair = motion_sample(&motion, 0);
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_init(NULL, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_push(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_update(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_reset(NULL));
    TEST_ASSERT_EQUAL_UINT32(0, result_of(&engine).head.samples);
}

static void before_any_sample_nothing_is_known_and_that_is_said(void)
{
    const jcal_hinge_result_t r = result_of(&engine);
    assert_sane(&r);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, r.head.hint);
    TEST_ASSERT_EQUAL_INT(JCAL_ENGINE_STREAM, r.head.engine);
    TEST_ASSERT_FALSE(r.has_axes);
    TEST_ASSERT_FALSE(r.paper_accepted);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(r.axis1) + jcal_vec3_norm(r.axis2));
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty2_rad);
    TEST_ASSERT_TRUE(r.head.t_us == 0u);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_hinge_step(&engine));
}

static void nan_and_infinity_are_rejected_and_counted_wherever_they_stand(void)
{
    const motion_t motion = motion_lively(5);
    const float bad[3] = {NAN, INFINITY, -INFINITY};
    uint32_t count = 0;
    run(&engine, &motion, 0, 100);
    const jcal_hinge_t before = engine;
    for (int b = 0; b < 3; ++b) {
        for (int field = 0; field < 12; ++field) {
            jcal_pair_t pair = motion_sample(&motion, 100);
            float *const vectors[4] = {&pair.imu1.gyr_rad_s.x, &pair.imu1.acc_m_s2.x, &pair.imu2.gyr_rad_s.x,
                                       &pair.imu2.acc_m_s2.x};
            vectors[field / 3][field % 3] = bad[b];
            TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_update(&engine, &pair));
            ++count;
        }
    }
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_UINT32(100 + count, r.head.samples);
    TEST_ASSERT_EQUAL_UINT32(count, r.head.rejected);
    TEST_ASSERT_EQUAL_UINT32(count, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_MEMORY(&before.coarse.moments, &engine.coarse.moments, sizeof engine.coarse.moments);
}

static void a_full_inbox_is_an_error_and_loses_nothing(void)
{
    const motion_t motion = motion_lively(6);
    jcal_hinge_t other = engine;
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_push(&engine, &pair));
    }
    const jcal_pair_t next = motion_sample(&motion, JCAL_INBOX_CAPACITY);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_hinge_push(&engine, &next));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_push(&engine, &next)); /* the same sample is still welcome */
    while (jcal_hinge_step(&engine) == JCAL_OK) {
    }
    run(&other, &motion, 0, JCAL_INBOX_CAPACITY + 1u);
    assert_same_state(&engine, &other);
    TEST_ASSERT_TRUE(result_of(&engine).head.t_us == next.t_us);
    TEST_ASSERT_EQUAL_UINT32(JCAL_INBOX_CAPACITY + 1u, result_of(&engine).head.samples);
}

static void update_makes_room_in_a_full_inbox(void)
{
    const motion_t motion = motion_lively(6);
    jcal_hinge_t other = engine;
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_push(&engine, &pair));
    }
    run(&engine, &motion, JCAL_INBOX_CAPACITY, 100);
    while (jcal_hinge_step(&engine) == JCAL_OK) {
    }
    run(&other, &motion, 0, 100);
    assert_same_state(&engine, &other);
}

static void bursts_of_pushes_and_steps_equal_one_update_per_sample(void)
{
    const motion_t motion = motion_lively(7);
    jcal_hinge_t other = engine;
    uint32_t k = 0;
    for (uint32_t burst = 0; k < RUN; ++burst) {
        for (uint32_t i = 0; i <= (burst % JCAL_INBOX_CAPACITY); ++i) {
            const jcal_pair_t pair = motion_sample(&motion, k++);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_push(&engine, &pair));
        }
        while (jcal_hinge_step(&engine) == JCAL_OK) {
        }
    }
    run(&other, &motion, 0, k);
    assert_same_state(&engine, &other);
}

static void shifting_all_times_changes_no_bit(void)
{
    const motion_t motion = motion_lively(10);
    const uint64_t shifts[2] = {UINT64_C(1700000000123457), UINT64_MAX - UINT64_C(100000000)};
    for (int s = 0; s < 2; ++s) {
        jcal_hinge_t other;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&other, &config));
        for (uint32_t k = 0; k < 500; ++k) {
            jcal_pair_t pair = motion_sample(&motion, k);
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
            pair.t_us += shifts[s];
            TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&other, &pair));
        }
        assert_same_state(&engine, &other);
    }
}

static void a_copy_made_at_any_time_goes_on_to_the_same_bits(void)
{
    const motion_t motion = motion_lively(11);
    for (uint32_t cut = 1; cut < 400; cut += 57) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
        run(&engine, &motion, 0, cut);
        const jcal_pair_t waiting = motion_sample(&motion, cut);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_push(&engine, &waiting));
        jcal_hinge_t copy = engine;
        memset(&engine, 0x5a, sizeof engine); /* nothing in the copy points back */
        jcal_hinge_t whole;
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&whole, &config));
        run(&whole, &motion, 0, 500);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_step(&copy));
        run(&copy, &motion, cut + 1u, 500);
        assert_same_state(&whole, &copy);
    }
}

static void two_instances_side_by_side_do_not_touch_each_other(void)
{
    const motion_t first = motion_lively(12);
    const motion_t second = motion_lively(13);
    jcal_hinge_t a = engine;
    jcal_hinge_t b = engine;
    jcal_hinge_t alone = engine;
    for (uint32_t k = 0; k < 500; ++k) {
        run(&a, &first, k, k + 1);
        run(&b, &second, k, k + 1);
    }
    run(&engine, &first, 0, 500);
    run(&alone, &second, 0, 500);
    assert_same_state(&engine, &a);
    assert_same_state(&alone, &b);
}

static void reset_forgets_the_data_and_keeps_the_config(void)
{
    const motion_t first = motion_lively(14);
    const motion_t second = motion_lively(15);
    jcal_hinge_t fresh;
    config.sign_hint = JCAL_SIGN_OPPOSITE;
    config.max_bound_rad = 0.1f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&fresh, &config));
    run(&engine, &first, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
    assert_same_state(&fresh, &engine);
    run(&engine, &second, 0, RUN);
    run(&fresh, &second, 0, RUN);
    assert_same_state(&fresh, &engine);
}

static void what_was_never_prepared_knows_nothing(void)
{
    const motion_t motion = motion_lively(16);
    memset(&engine, 0, sizeof engine);
    for (uint32_t k = 0; k < 200; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_update(&engine, &pair));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_hinge_step(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_reset(&engine));
    TEST_ASSERT_EQUAL_STRING("config", jcal_hinge_config_check(NULL));
}

static void the_state_fits_its_budget(void)
{
    TEST_ASSERT_TRUE(sizeof(jcal_hinge_t) <= 2048u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(the_default_config_is_valid);
    RUN_TEST(every_field_out_of_its_range_is_named);
    RUN_TEST(a_gyroscope_as_it_comes_needs_a_larger_mismatch);
    RUN_TEST(a_sign_hint_that_is_none_is_named);
    RUN_TEST(a_refused_config_leaves_self_untouched);
    RUN_TEST(null_arguments_are_refused_everywhere);
    RUN_TEST(before_any_sample_nothing_is_known_and_that_is_said);
    RUN_TEST(nan_and_infinity_are_rejected_and_counted_wherever_they_stand);
    RUN_TEST(a_full_inbox_is_an_error_and_loses_nothing);
    RUN_TEST(update_makes_room_in_a_full_inbox);
    RUN_TEST(bursts_of_pushes_and_steps_equal_one_update_per_sample);
    RUN_TEST(shifting_all_times_changes_no_bit);
    RUN_TEST(a_copy_made_at_any_time_goes_on_to_the_same_bits);
    RUN_TEST(two_instances_side_by_side_do_not_touch_each_other);
    RUN_TEST(reset_forgets_the_data_and_keeps_the_config);
    RUN_TEST(what_was_never_prepared_knows_nothing);
    RUN_TEST(the_state_fits_its_budget);
    return UNITY_END();
}

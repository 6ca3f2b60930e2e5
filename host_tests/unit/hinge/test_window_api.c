/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge_window.h: what it takes, refuses, keeps and forgets.
#include "unit/hinge/window_fixture.h"

static void samples_that_are_not_finite_are_rejected_and_counted(void)
{
    const motion_t motion = motion_lively(5);
    const float bad[3] = {NAN, INFINITY, -INFINITY};
    for (int b = 0; b < 3; ++b) {
        for (int field = 0; field < 12; ++field) {
            jcal_pair_t pair = motion_sample(&motion, 0);
            float *const vectors[4] = {&pair.imu1.gyr_rad_s.x, &pair.imu1.acc_m_s2.x, &pair.imu2.gyr_rad_s.x,
                                       &pair.imu2.acc_m_s2.x};
            vectors[field / 3][field % 3] = bad[b];
            TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_window_update(&engine, &pair));
        }
    }
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_UINT32(36, r.head.samples);
    TEST_ASSERT_EQUAL_UINT32(36, r.head.rejected);
    TEST_ASSERT_EQUAL_UINT32(36, r.head.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_hinge_window_step(&engine));
}

static void time_that_does_not_increase_is_rejected(void)
{
    const motion_t motion = motion_lively(5);
    jcal_pair_t pair = motion_sample(&motion, 10);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_update(&engine, &pair));
    jcal_pair_t again = motion_sample(&motion, 11);
    again.t_us = pair.t_us;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_window_update(&engine, &again));
    again.t_us = pair.t_us - 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_window_update(&engine, &again));
    TEST_ASSERT_EQUAL_UINT32(2, result_of(&engine).head.rejected_by[JCAL_REJECT_TIME_ORDER]);
}

static void impossible_readings_are_rejected(void)
{
    const motion_t motion = motion_lively(5);
    run(&engine, &motion, 0, 3);
    jcal_pair_t pair = motion_sample(&motion, 3);
    pair.imu2.gyr_rad_s.y = 300.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_window_update(&engine, &pair));
    TEST_ASSERT_EQUAL_UINT32(1, result_of(&engine).head.rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
}

static void shifting_all_times_changes_no_bit(void)
{
    const motion_t motion = motion_lively(10);
    jcal_hinge_window_t other;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&other, &config, storage2, sizeof storage2));
    for (uint32_t k = 0; k < 500; ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        (void)jcal_hinge_window_update(&engine, &pair);
        pair.t_us += UINT64_C(1700000000123457);
        (void)jcal_hinge_window_update(&other, &pair);
    }
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&other);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis1, &b.axis1, sizeof a.axis1);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis2, &b.axis2, sizeof a.axis2);
    TEST_ASSERT_EQUAL_MEMORY(storage, storage2, sizeof storage);
}

static void a_copy_with_its_storage_attached_goes_on_to_the_same_bits(void)
{
    const motion_t motion = motion_lively(11);
    run(&engine, &motion, 0, 517);
    jcal_hinge_window_t copy = engine;
    memcpy(storage2, storage, sizeof storage);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_attach(&copy, storage2, sizeof storage2));
    run(&engine, &motion, 517, 900);
    run(&copy, &motion, 517, 900);
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&copy);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis1, &b.axis1, sizeof a.axis1);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis2, &b.axis2, sizeof a.axis2);
    TEST_ASSERT_EQUAL_MEMORY(storage, storage2, sizeof storage);
}

static void reset_forgets_everything_but_the_config(void)
{
    const motion_t first = motion_lively(12);
    const motion_t second = motion_lively(13);
    run(&engine, &first, 0, 600);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_reset(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    TEST_ASSERT_EQUAL_UINT32(0, result_of(&engine).head.samples);
    run(&engine, &second, 0, 600);
    jcal_hinge_window_t fresh;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&fresh, &config, storage2, sizeof storage2));
    run(&fresh, &second, 0, 600);
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&fresh);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis1, &b.axis1, sizeof a.axis1);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis2, &b.axis2, sizeof a.axis2);
}

static void push_fills_the_inbox_and_step_empties_it(void)
{
    const motion_t motion = motion_lively(14);
    uint32_t k = 0;
    for (; k < JCAL_INBOX_CAPACITY; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_push(&engine, &pair));
    }
    const jcal_pair_t late = motion_sample(&motion, k);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FULL, jcal_hinge_window_push(&engine, &late));
    for (uint32_t s = 0; s < k; ++s) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_step(&engine));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_IDLE, jcal_hinge_window_step(&engine));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_push(&engine, &late));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_step(&engine));
}

static void storage_that_is_too_small_or_not_aligned_is_refused(void)
{
    jcal_hinge_window_t untouched;
    jcal_hinge_window_t self;
    memset(&untouched, 0x5a, sizeof untouched);
    memset(&self, 0x5a, sizeof self);
    TEST_ASSERT_EQUAL_size_t(sizeof storage, jcal_hinge_window_storage_bytes(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_hinge_window_init(&self, &config, storage, sizeof storage - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE,
                          jcal_hinge_window_init(&self, &config, (char *)storage + 1, sizeof storage));
    TEST_ASSERT_EQUAL_MEMORY(&untouched, &self, sizeof self);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_hinge_window_attach(&engine, storage2, sizeof storage2 - 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_STORAGE, jcal_hinge_window_attach(&engine, (char *)storage2 + 2, sizeof storage2));
}

static void assert_config_refused(const char *field)
{
    jcal_hinge_window_t self;
    TEST_ASSERT_EQUAL_STRING(field, jcal_hinge_window_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_window_init(&self, &config, storage, sizeof storage));
    config = jcal_hinge_window_config_default();
}

static void every_config_field_out_of_range_is_named(void)
{
    config = jcal_hinge_window_config_default();
    TEST_ASSERT_NULL(jcal_hinge_window_config_check(&config));
    config.n_max = 18;
    assert_config_refused("n_max");
    config.n_max = 10002;
    assert_config_refused("n_max");
    config.half_window = 101;
    assert_config_refused("half_window");
    config.acc_min = 10001;
    assert_config_refused("acc_min");
    config.accept_count = 0;
    assert_config_refused("accept_count");
    config.accept_count = 101;
    assert_config_refused("accept_count");
    const float bad[3] = {NAN, -1.0f, 2e10f};
    for (int k = 0; k < 3; ++k) {
        config.w0 = bad[k];
        assert_config_refused("w0");
        config.energy_max_rad2_s2 = bad[k];
        assert_config_refused("energy_max_rad2_s2");
        config.accept_bound_rad = bad[k];
        assert_config_refused("accept_bound_rad");
        config.solve_period_s = bad[k];
        assert_config_refused("solve_period_s");
    }
    config.energy_max_rad2_s2 = 0.0f;
    assert_config_refused("energy_max_rad2_s2");
    config.hinge.max_bound_rad = NAN;
    assert_config_refused("max_bound_rad");
}

static void null_pointers_are_refused_everywhere(void)
{
    jcal_pair_t pair = {0};
    jcal_hinge_result_t result;
    uint32_t ids[N_MAX];
    size_t n = N_MAX;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_init(NULL, &config, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_init(&engine, NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_init(&engine, &config, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_attach(NULL, storage, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_attach(&engine, NULL, sizeof storage));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_push(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_push(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_step(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_update(NULL, &pair));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_update(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(NULL, ids, &n, ids, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, NULL, &n, ids, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, NULL, ids, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, &n, NULL, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, &n, ids, NULL));
}

static void what_was_never_prepared_knows_nothing(void)
{
    const motion_t motion = motion_lively(16);
    memset(&engine, 0, sizeof engine);
    for (uint32_t k = 0; k < 200; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_window_update(&engine, &pair));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_step(&engine));
    TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    TEST_ASSERT_EQUAL_UINT(0, jcal_hinge_window_storage_bytes(NULL));
    TEST_ASSERT_EQUAL_STRING("config", jcal_hinge_window_config_check(NULL));
}

static void selection_into_too_little_room_is_refused(void)
{
    const motion_t motion = motion_lively(15);
    uint32_t ids[N_MAX];
    size_t room = 5;
    size_t enough = N_MAX;
    run(&engine, &motion, 0, 100);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, &room, ids, &enough));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, &enough, ids, &room));
    TEST_ASSERT_EQUAL_size_t(5, room);
}

static void update_makes_room_in_a_full_inbox(void)
{
    const motion_t motion = motion_lively(14);
    jcal_hinge_window_t other;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&other, &config, storage2, sizeof storage2));
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_push(&engine, &pair));
    }
    run(&engine, &motion, JCAL_INBOX_CAPACITY, 300);
    while (jcal_hinge_window_step(&engine) == JCAL_OK) {
    }
    run(&other, &motion, 0, 300);
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&other);
    TEST_ASSERT_EQUAL_UINT32(300, a.head.samples);
    TEST_ASSERT_TRUE(a.head.t_us == b.head.t_us);
    TEST_ASSERT_EQUAL_MEMORY(storage, storage2, sizeof storage);
}

/* `v` turned by about 4 deg, more than max_bound. */
static jcal_vec3_t turned_away(jcal_vec3_t v)
{
    const jcal_tangent_t t = jcal_sphere_tangent(v);
    return jcal_sphere_move(v, &t, 4.0f * JCAL_RAD_PER_DEG, 0.0f);
}

static void an_axis_on_which_the_engines_disagree_is_weak_and_not_ready(void)
{
    const motion_t motion = motion_lively(2);
    run(&engine, &motion, 0, RUN);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    for (int sensor = 0; sensor < 2; ++sensor) {
        jcal_hinge_window_t copy = engine;
        copy.axes.j[sensor] = turned_away(copy.axes.j[sensor]);
        const jcal_hinge_result_t apart = result_of(&copy);
        TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, apart.head.status);
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, apart.head.reason);
        TEST_ASSERT_EQUAL_INT((sensor == 0) ? JCAL_WEAK_AXIS1 : JCAL_WEAK_AXIS2, apart.head.weak);
    }
    jcal_hinge_window_t other = engine;
    other.axes.j[1] = jcal_vec3_scale(other.axes.j[1], -1.0f);
    TEST_ASSERT_EQUAL_INT(JCAL_AMBIGUOUS, result_of(&other).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_SIGN_OPEN, result_of(&other).head.reason);
}

static void before_the_first_full_solve_the_result_says_what_it_waits_for(void)
{
    config.solve_period_s = 60.0f; /* longer than the run: the guard is ready before there are axes */
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, 800);
    jcal_hinge_result_t guard;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_get(&engine.guard, &guard));
    TEST_ASSERT_EQUAL_INT(JCAL_READY, guard.head.status);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_FALSE(r.has_axes);
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NO_DATA, r.head.reason);
    TEST_ASSERT_EQUAL_INT(JCAL_WEAK_AXIS1, r.head.weak);
    TEST_ASSERT_EQUAL_INT(JCAL_HINT_MOVE_JOINT, r.head.hint);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty1_rad);
    TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_RAD, r.uncertainty2_rad);
    TEST_ASSERT_TRUE(r.progress_axis1 < 0.1f);
}

static void ready_is_left_a_fifth_above_the_limit(void)
{
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, 1000);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_TRUE(engine.was_ready);
    const float bound_rad = fmaxf(r.uncertainty1_rad, r.uncertainty2_rad);
    engine.cfg.hinge.max_bound_rad = bound_rad / 1.19f;
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    engine.cfg.hinge.max_bound_rad = bound_rad / 1.21f;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, result_of(&engine).head.reason);
    engine.was_ready = false;
    engine.cfg.hinge.max_bound_rad = bound_rad / 1.01f;
    TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, result_of(&engine).head.status);
}

static void the_sign_stays_once_the_guard_was_ready(void)
{
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, 1000);
    TEST_ASSERT_TRUE(engine.guard.kept_sign[0] != 0);
    engine.guard.kept_sign[0] = 1;
    engine.axes.j[0] = jcal_vec3(0.70f, -0.71f, 0.1f);
    TEST_ASSERT_EQUAL_FLOAT(0.70f, result_of(&engine).axis1.x);
    engine.axes.j[0] = jcal_vec3(-0.70f, 0.71f, 0.1f); /* the opposite, as the solver may find it */
    TEST_ASSERT_EQUAL_FLOAT(0.70f, result_of(&engine).axis1.x);
    engine.guard.kept_sign[0] = 0;
    engine.cfg.hinge.axis1_toward = jcal_vec3(-1.0f, 0.0f, 0.0f);
    TEST_ASSERT_EQUAL_FLOAT(-0.70f, result_of(&engine).axis1.x);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(before_the_first_full_solve_the_result_says_what_it_waits_for);
    RUN_TEST(ready_is_left_a_fifth_above_the_limit);
    RUN_TEST(the_sign_stays_once_the_guard_was_ready);
    RUN_TEST(samples_that_are_not_finite_are_rejected_and_counted);
    RUN_TEST(time_that_does_not_increase_is_rejected);
    RUN_TEST(impossible_readings_are_rejected);
    RUN_TEST(shifting_all_times_changes_no_bit);
    RUN_TEST(a_copy_with_its_storage_attached_goes_on_to_the_same_bits);
    RUN_TEST(reset_forgets_everything_but_the_config);
    RUN_TEST(push_fills_the_inbox_and_step_empties_it);
    RUN_TEST(storage_that_is_too_small_or_not_aligned_is_refused);
    RUN_TEST(every_config_field_out_of_range_is_named);
    RUN_TEST(null_pointers_are_refused_everywhere);
    RUN_TEST(what_was_never_prepared_knows_nothing);
    RUN_TEST(selection_into_too_little_room_is_refused);
    RUN_TEST(update_makes_room_in_a_full_inbox);
    RUN_TEST(an_axis_on_which_the_engines_disagree_is_weak_and_not_ready);
    return UNITY_END();
}

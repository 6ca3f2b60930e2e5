/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge_window.h through its API.
#include "jointcal/hinge_window.h"

#include "hinge_motion.h"
#include "math/angle.h"
#include "math/sphere.h"
#include "unity.h"

#include <math.h>
#include <string.h>

enum { N_MAX = 200, HALF_WINDOW = 10, BYTES = JCAL_HINGE_WINDOW_STORAGE_BYTES(N_MAX, HALF_WINDOW), RUN = 1500 };

/* Exact constraints with noise of 0.01 rad/s and 0.05 m/s^2 on 200 rows: a few tenths of a degree. */
static const float AXIS_TOL_RAD = 0.5f * JCAL_RAD_PER_DEG;

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

static void run(jcal_hinge_window_t *self, const motion_t *motion, uint32_t begin, uint32_t end)
{
    for (uint32_t k = begin; k < end; ++k) {
        const jcal_pair_t pair = motion_sample(motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_update(self, &pair));
    }
}

static jcal_hinge_result_t result_of(const jcal_hinge_window_t *self)
{
    jcal_hinge_result_t result;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_get(self, &result));
    return result;
}

/* Both axes up to their common sign. */
static void assert_axes(const jcal_hinge_result_t *result, const motion_t *motion)
{
    const jcal_vec3_t truth1 = motion_axis(motion, 0);
    const jcal_vec3_t truth2 = motion_axis(motion, 1);
    const float sign = (jcal_vec3_dot(result->axis1, truth1) < 0.0f) ? -1.0f : 1.0f;
    TEST_ASSERT_TRUE(result->has_axes);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(result->axis1, sign), truth1) < AXIS_TOL_RAD);
    TEST_ASSERT_TRUE(jcal_sphere_angle(jcal_vec3_scale(result->axis2, sign), truth2) < AXIS_TOL_RAD);
}

static void axes_are_recovered_for_any_mounting_with_the_right_pairing(void)
{
    for (uint32_t mounting = 0; mounting < 12; ++mounting) {
        const motion_t motion = motion_lively(mounting);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_reset(&engine));
        run(&engine, &motion, 0, RUN);
        const jcal_hinge_result_t result = result_of(&engine);
        assert_axes(&result, &motion);
        TEST_ASSERT_TRUE(result.sign_margin > 2.0f);
        TEST_ASSERT_EQUAL_INT(JCAL_ENGINE_WINDOW, result.engine);
    }
}

static void the_largest_component_of_axis1_is_positive_and_axes_are_unit(void)
{
    for (uint32_t mounting = 20; mounting < 26; ++mounting) {
        const motion_t motion = motion_lively(mounting);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_reset(&engine));
        run(&engine, &motion, 0, 400);
        const jcal_hinge_result_t r = result_of(&engine);
        const float low = fminf(r.axis1.x, fminf(r.axis1.y, r.axis1.z));
        const float high = fmaxf(r.axis1.x, fmaxf(r.axis1.y, r.axis1.z));
        TEST_ASSERT_TRUE(high >= -low);
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(r.axis1));
        TEST_ASSERT_FLOAT_WITHIN(1e-6f, 1.0f, jcal_vec3_norm(r.axis2));
    }
}

static void the_paper_accepts_only_after_n_min_full_solves(void)
{
    /* Random starts fall into other minima now and then, so few are asked for. */
    const motion_t motion = motion_lively(1);
    uint32_t accepted_at = 0;
    config.accept_count = 2;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    for (uint32_t k = 0; (k < 3000u) && (accepted_at == 0); ++k) {
        run(&engine, &motion, k, k + 1);
        accepted_at = result_of(&engine).paper_accepted ? k : 0;
    }
    TEST_ASSERT_TRUE(accepted_at >= 50u * (config.accept_count + 1u)); /* the first solve has no predecessor */
    const jcal_hinge_result_t result = result_of(&engine);
    assert_axes(&result, &motion);
}

static void a_stiff_joint_is_not_accepted(void)
{
    motion_t motion = motion_lively(2);
    motion.joint_speed = 0.0;
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_FALSE(result_of(&engine).paper_accepted);
}

static void zeros_give_no_nan_and_are_not_accepted(void)
{
    for (uint32_t k = 0; k < 800; ++k) {
        const jcal_pair_t zero = {.t_us = (uint64_t)k * 20000u};
        (void)jcal_hinge_window_update(&engine, &zero);
        const jcal_hinge_result_t r = result_of(&engine);
        TEST_ASSERT_FALSE(r.paper_accepted);
        TEST_ASSERT_TRUE(jcal_vec3_is_finite(r.axis1) && jcal_vec3_is_finite(r.axis2) && isfinite(r.sign_margin));
    }
}

static void a_sign_hint_decides_the_pairing(void)
{
    motion_t motion = motion_lively(4);
    motion.q_s1_a = jcal_quat_normalise(jcal_quat(1.0f, 0.1f, 0.0f, 0.0f));
    motion.q_s2_b = motion.q_s1_a; /* the truth is JCAL_SIGN_SAME */
    const jcal_sign_hint_t hints[2] = {JCAL_SIGN_SAME, JCAL_SIGN_OPPOSITE};
    for (int k = 0; k < 2; ++k) {
        config.hinge.sign_hint = hints[k];
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
        run(&engine, &motion, 0, 600);
        const jcal_hinge_result_t r = result_of(&engine);
        TEST_ASSERT_EQUAL_INT(k == 0, (r.axis1.z * r.axis2.z) > 0.0f);
        TEST_ASSERT_EQUAL_INT(k == 0, r.sign_margin > 1.0f);
    }
}

static void a_sign_hint_holds_at_every_moment(void)
{
    motion_t motion = motion_lively(4);
    motion.q_s1_a = jcal_quat_normalise(jcal_quat(1.0f, 0.1f, 0.0f, 0.0f));
    motion.q_s2_b = motion.q_s1_a;
    config.hinge.sign_hint = JCAL_SIGN_OPPOSITE;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    run(&engine, &motion, 0, 500);
    for (uint32_t k = 500; k < 1000; ++k) {
        run(&engine, &motion, k, k + 1);
        const jcal_hinge_result_t r = result_of(&engine);
        TEST_ASSERT_TRUE((r.axis1.z * r.axis2.z) < 0.0f);
    }
}

static void the_margin_of_perfect_data_is_capped(void)
{
    motion_t motion = motion_lively(16);
    motion.gyr_noise_rad_s = 0.0;
    motion.acc_noise_m_s2 = 0.0;
    run(&engine, &motion, 0, 600);
    const jcal_hinge_result_t r = result_of(&engine);
    assert_axes(&r, &motion);
    TEST_ASSERT_EQUAL_FLOAT(1e6f, r.sign_margin);
}

static void solves_asked_for_too_early_or_too_often_wait(void)
{
    const motion_t motion = motion_lively(17);
    config.solve_period_s = 0.1f;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    run(&engine, &motion, 0, HALF_WINDOW + 3);
    TEST_ASSERT_FALSE(result_of(&engine).has_axes);
    run(&engine, &motion, HALF_WINDOW + 3, 1000);
    const jcal_hinge_result_t r = result_of(&engine);
    assert_axes(&r, &motion);
}

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
    TEST_ASSERT_EQUAL_UINT32(36, r.samples);
    TEST_ASSERT_EQUAL_UINT32(36, r.rejected);
    TEST_ASSERT_EQUAL_UINT32(36, r.rejected_by[JCAL_REJECT_NOT_FINITE]);
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
    TEST_ASSERT_EQUAL_UINT32(2, result_of(&engine).rejected_by[JCAL_REJECT_TIME_ORDER]);
}

static void impossible_readings_are_rejected(void)
{
    const motion_t motion = motion_lively(5);
    run(&engine, &motion, 0, 3);
    jcal_pair_t pair = motion_sample(&motion, 3);
    pair.imu2.gyr_rad_s.y = 300.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECTED, jcal_hinge_window_update(&engine, &pair));
    TEST_ASSERT_EQUAL_UINT32(1, result_of(&engine).rejected_by[JCAL_REJECT_OUT_OF_RANGE]);
}

/* Numbers of the selected samples as flags. */
static size_t selection_of(const jcal_hinge_window_t *self, bool *gyr, bool *acc, size_t count, size_t *n_acc)
{
    uint32_t gyr_ids[N_MAX];
    uint32_t acc_ids[N_MAX];
    size_t n_gyr = N_MAX;
    *n_acc = N_MAX;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_selection(self, gyr_ids, &n_gyr, acc_ids, n_acc));
    memset(gyr, 0, count * sizeof gyr[0]);
    memset(acc, 0, count * sizeof acc[0]);
    for (size_t k = 0; k < n_gyr; ++k) {
        TEST_ASSERT_TRUE((gyr_ids[k] < count) && !gyr[gyr_ids[k]]);
        gyr[gyr_ids[k]] = true;
    }
    for (size_t k = 0; k < *n_acc; ++k) {
        TEST_ASSERT_TRUE((acc_ids[k] < count) && !acc[acc_ids[k]]);
        acc[acc_ids[k]] = true;
    }
    return n_gyr;
}

static void selection_counts_rejected_samples_too(void)
{
    const motion_t motion = motion_lively(6);
    static bool gyr[RUN];
    static bool acc[RUN];
    size_t n_acc = 0;
    for (uint32_t k = 0; k < 100; ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        pair.imu1.gyr_rad_s.x = (k % 7 == 3) ? NAN : pair.imu1.gyr_rad_s.x;
        (void)jcal_hinge_window_update(&engine, &pair);
    }
    /* 86 accepted; the last HALF_WINDOW of them still wait for their scores. */
    TEST_ASSERT_EQUAL_size_t(86 - HALF_WINDOW, selection_of(&engine, gyr, acc, RUN, &n_acc));
    TEST_ASSERT_EQUAL_size_t(86 - HALF_WINDOW, n_acc);
    for (uint32_t k = 0; k < 100; ++k) {
        const bool expected = (k % 7 != 3) && (k < 89);
        TEST_ASSERT_EQUAL_INT(expected, gyr[k]);
        TEST_ASSERT_EQUAL_INT(expected, acc[k]);
    }
}

static void selection_equals_algorithm_2_on_all_samples(void)
{
    const motion_t motion = motion_lively(7);
    static bool gyr[RUN];
    static bool acc[RUN];
    static float delta[RUN];
    static float score[RUN];
    size_t n_acc = 0;
    run(&engine, &motion, 0, RUN);
    for (uint32_t k = 0; k < RUN; ++k) {
        const jcal_pair_t p = motion_sample(&motion, k);
        delta[k] = jcal_vec3_norm(p.imu1.gyr_rad_s) - jcal_vec3_norm(p.imu2.gyr_rad_s);
    }
    const int scored = RUN - HALF_WINDOW;
    for (int k = 0; k < scored; ++k) {
        score[k] = 1e9f;
        for (int l = (k < HALF_WINDOW) ? 0 : k - HALF_WINDOW; l <= k + HALF_WINDOW; ++l) {
            score[k] = (fabsf(delta[l]) < fabsf(score[k])) ? delta[l] : score[k];
        }
    }
    TEST_ASSERT_EQUAL_size_t(N_MAX, selection_of(&engine, gyr, acc, RUN, &n_acc));
    for (int k = 0; k < scored; ++k) {
        int above = 0;
        int below = 0;
        for (int l = 0; l < scored; ++l) {
            above += (score[l] > score[k]) ? 1 : 0;
            below += (score[l] < score[k]) ? 1 : 0;
        }
        const int equal = scored - above - below;
        TEST_ASSERT_TRUE(!((above + equal <= N_MAX / 2) || (below + equal <= N_MAX / 2)) || gyr[k]);
        TEST_ASSERT_TRUE((above < N_MAX / 2) || (below < N_MAX / 2) || !gyr[k]);
    }
}

static void windows_do_not_reach_across_a_gap(void)
{
    const motion_t motion = motion_lively(8);
    static bool gyr[RUN];
    static bool acc[RUN];
    size_t n_acc = 0;
    run(&engine, &motion, 0, 30);
    for (uint32_t k = 30; k < 60; ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        pair.t_us += 5000000u;
        TEST_ASSERT_TRUE(jcal_hinge_window_update(&engine, &pair) >= JCAL_OK);
    }
    (void)selection_of(&engine, gyr, acc, RUN, &n_acc);
    for (uint32_t k = 0; k < 49; ++k) { /* those whose window the gap cut off were dropped */
        const bool waiting = (k >= 20) && (k < 30);
        TEST_ASSERT_TRUE(!(waiting && gyr[k]));
        TEST_ASSERT_TRUE(waiting || (k == 30) || gyr[k]);
    }
}

static void equal_seeds_give_equal_bits_and_another_seed_the_same_axes(void)
{
    const motion_t motion = motion_lively(9);
    jcal_hinge_window_t other;
    run(&engine, &motion, 0, 900);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&other, &config, storage2, sizeof storage2));
    run(&other, &motion, 0, 900);
    const jcal_hinge_result_t a = result_of(&engine);
    const jcal_hinge_result_t b = result_of(&other);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis1, &b.axis1, sizeof a.axis1);
    TEST_ASSERT_EQUAL_MEMORY(&a.axis2, &b.axis2, sizeof a.axis2);
    TEST_ASSERT_EQUAL_FLOAT(a.sign_margin, b.sign_margin);
    config.seed = 99;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&other, &config, storage2, sizeof storage2));
    run(&other, &motion, 0, 900);
    const jcal_hinge_result_t c = result_of(&other);
    TEST_ASSERT_TRUE(jcal_sphere_angle(a.axis1, c.axis1) < 1e-4f);
    TEST_ASSERT_TRUE(jcal_sphere_angle(a.axis2, c.axis2) < 1e-4f);
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
    TEST_ASSERT_EQUAL_UINT32(0, result_of(&engine).samples);
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
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_get(NULL, &result));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_get(&engine, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_reset(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(NULL, ids, &n, ids, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, NULL, &n, ids, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, NULL, ids, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, &n, NULL, &n));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_hinge_window_selection(&engine, ids, &n, ids, NULL));
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

static void smallest_buffers_and_no_window_still_work_after_hours(void)
{
    const motion_t motion = motion_lively(3);
    config.n_max = 20;
    config.half_window = 0;
    config.acc_min = 20;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    run(&engine, &motion, 0, 360000); /* two hours at 50 Hz */
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis1, motion_axis(&motion, 0)) < 3.0f * JCAL_RAD_PER_DEG);
    TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis2, motion_axis(&motion, 1)) < 3.0f * JCAL_RAD_PER_DEG);
    TEST_ASSERT_EQUAL_UINT32(360000, r.samples);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(axes_are_recovered_for_any_mounting_with_the_right_pairing);
    RUN_TEST(the_largest_component_of_axis1_is_positive_and_axes_are_unit);
    RUN_TEST(the_paper_accepts_only_after_n_min_full_solves);
    RUN_TEST(a_stiff_joint_is_not_accepted);
    RUN_TEST(zeros_give_no_nan_and_are_not_accepted);
    RUN_TEST(a_sign_hint_decides_the_pairing);
    RUN_TEST(a_sign_hint_holds_at_every_moment);
    RUN_TEST(the_margin_of_perfect_data_is_capped);
    RUN_TEST(solves_asked_for_too_early_or_too_often_wait);
    RUN_TEST(samples_that_are_not_finite_are_rejected_and_counted);
    RUN_TEST(time_that_does_not_increase_is_rejected);
    RUN_TEST(impossible_readings_are_rejected);
    RUN_TEST(selection_counts_rejected_samples_too);
    RUN_TEST(selection_equals_algorithm_2_on_all_samples);
    RUN_TEST(windows_do_not_reach_across_a_gap);
    RUN_TEST(equal_seeds_give_equal_bits_and_another_seed_the_same_axes);
    RUN_TEST(shifting_all_times_changes_no_bit);
    RUN_TEST(a_copy_with_its_storage_attached_goes_on_to_the_same_bits);
    RUN_TEST(reset_forgets_everything_but_the_config);
    RUN_TEST(push_fills_the_inbox_and_step_empties_it);
    RUN_TEST(storage_that_is_too_small_or_not_aligned_is_refused);
    RUN_TEST(every_config_field_out_of_range_is_named);
    RUN_TEST(null_pointers_are_refused_everywhere);
    RUN_TEST(selection_into_too_little_room_is_refused);
    RUN_TEST(smallest_buffers_and_no_window_still_work_after_hours);
    return UNITY_END();
}

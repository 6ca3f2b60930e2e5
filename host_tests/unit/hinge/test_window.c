/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/hinge_window.h: axes, pairing, selection.
#include "unit/hinge/window_fixture.h"

/* Two hours at 50 Hz; on an emulated target two minutes, in which the buffers are filled hundreds of times too. */
#if defined(JCAL_TEST_SHORT)
enum { LONG_RUN = 6000, MOUNTINGS = 2, MOUNTINGS_SHORT = 2 };
#else
enum { LONG_RUN = 360000, MOUNTINGS = 12, MOUNTINGS_SHORT = 6 };
#endif

static void axes_are_recovered_for_any_mounting_with_the_right_pairing(void)
{
    for (uint32_t mounting = 0; mounting < (uint32_t)MOUNTINGS; ++mounting) {
        const motion_t motion = motion_lively(mounting);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_reset(&engine));
        run(&engine, &motion, 0, RUN);
        const jcal_hinge_result_t result = result_of(&engine);
        assert_axes(&result, &motion);
        TEST_ASSERT_TRUE(result.sign_margin > 2.0f);
        TEST_ASSERT_EQUAL_INT(JCAL_ENGINE_WINDOW, result.head.engine);
    }
}

static void the_largest_component_of_axis1_is_positive_and_axes_are_unit(void)
{
    for (uint32_t mounting = 20; mounting < 20u + (uint32_t)MOUNTINGS_SHORT; ++mounting) {
        const motion_t motion = motion_lively(mounting);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_reset(&engine));
        run(&engine, &motion, 0, 400);
        const jcal_hinge_result_t r = result_of(&engine);
        assert_normal_form(&r);
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

static void sensors_at_rest_give_no_nan_and_are_not_accepted(void)
{
    motion_t motion = motion_lively(18);
    motion.speed = 0.0;
    motion.joint_speed = 0.0;
    motion.gyr_noise_rad_s = 1e-7;
    motion.acc_noise_m_s2 = 1e-5;
    for (uint32_t k = 0; k < RUN; ++k) { /* readings that differ in the last digits only may be rejected */
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_TRUE(jcal_hinge_window_update(&engine, &pair) >= JCAL_OK);
    }
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_TRUE(jcal_vec3_is_finite(r.axis1) && jcal_vec3_is_finite(r.axis2) && isfinite(r.sign_margin));
    TEST_ASSERT_FALSE(r.paper_accepted);
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

static float dominant(jcal_vec3_t v)
{
    const float xy = (fabsf(v.x) > fabsf(v.y)) ? v.x : v.y;
    return (fabsf(xy) > fabsf(v.z)) ? xy : v.z;
}

static void a_sign_hint_decides_the_pairing(void)
{
    const jcal_sign_hint_t hints[2] = {JCAL_SIGN_SAME, JCAL_SIGN_OPPOSITE};
    for (int k = 0; k < 4; ++k) {
        const bool truth_is_same = k < 2;
        const motion_t motion = motion_paired(truth_is_same);
        config.hinge.sign_hint = hints[k % 2];
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
        run(&engine, &motion, 0, 600);
        const jcal_hinge_result_t r = result_of(&engine);
        const bool told_same = (k % 2) == 0;
        TEST_ASSERT_EQUAL_INT(told_same, (dominant(r.axis1) * dominant(r.axis2)) > 0.0f);
        /* The right pairing costs a hundred times less than the wrong one; held in the wrong one by a wrong hint, the
           axes lie where it costs least, and the right one is not much more costly there, if at all. */
        TEST_ASSERT_EQUAL_INT(told_same == truth_is_same, r.sign_margin > 10.0f);
    }
}

static void a_sign_hint_holds_at_every_moment(void)
{
    const motion_t motion = motion_paired(true);
    config.hinge.sign_hint = JCAL_SIGN_OPPOSITE;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    run(&engine, &motion, 0, 500);
    for (uint32_t k = 500; k < 1000; ++k) {
        run(&engine, &motion, k, k + 1);
        const jcal_hinge_result_t r = result_of(&engine);
        TEST_ASSERT_TRUE(dominant(r.axis1) > 0.0f);
        TEST_ASSERT_TRUE(dominant(r.axis2) < 0.0f);
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

static void smallest_buffers_and_no_window_still_work_after_hours(void)
{
    const motion_t motion = motion_lively(3);
    config.n_max = 20;
    config.half_window = 0;
    config.acc_min = 20;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_window_init(&engine, &config, storage, sizeof storage));
    run(&engine, &motion, 0, LONG_RUN);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis1, motion_axis(&motion, 0)) < 3.0f * JCAL_RAD_PER_DEG);
    TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis2, motion_axis(&motion, 1)) < 3.0f * JCAL_RAD_PER_DEG);
    TEST_ASSERT_EQUAL_UINT32(LONG_RUN, r.head.samples);
}

/* What was selected before a slip is of another joint: the window begins anew with the engine that watches beside it. */
static void a_slip_empties_the_window_and_the_new_axes_are_found(void)
{
    const motion_t motion = motion_lively(1);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    motion_t after = motion; /* sensor 2 turned by 60 deg about (1, 1, 1) */
    const float part = 0.5f / 1.7320508f;
    after.q_s2_b = jcal_quat_mul(after.q_s2_b, jcal_quat(0.8660254f, part, part, part));
    uint32_t k = RUN;
    while ((k < (RUN + 250u)) && (result_of(&engine).head.status != JCAL_MOVED)) { /* 5 s */
        run(&engine, &after, k, k + 1u);
        ++k;
    }
    const jcal_hinge_result_t moved = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_MOVED, moved.head.status);
    TEST_ASSERT_FALSE(moved.has_axes);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_vec3_norm(moved.axis2));
    run(&engine, &after, k, k + RUN);
    const jcal_hinge_result_t r = result_of(&engine);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, r.head.status);
    TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis1, motion_axis(&after, 0)) < r.uncertainty1_rad);
    TEST_ASSERT_TRUE(jcal_sphere_line_angle(r.axis2, motion_axis(&after, 1)) < r.uncertainty2_rad);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(axes_are_recovered_for_any_mounting_with_the_right_pairing);
    RUN_TEST(the_largest_component_of_axis1_is_positive_and_axes_are_unit);
    RUN_TEST(the_paper_accepts_only_after_n_min_full_solves);
    RUN_TEST(a_stiff_joint_is_not_accepted);
    RUN_TEST(sensors_at_rest_give_no_nan_and_are_not_accepted);
    RUN_TEST(zeros_give_no_nan_and_are_not_accepted);
    RUN_TEST(a_sign_hint_decides_the_pairing);
    RUN_TEST(a_sign_hint_holds_at_every_moment);
    RUN_TEST(the_margin_of_perfect_data_is_capped);
    RUN_TEST(solves_asked_for_too_early_or_too_often_wait);
    RUN_TEST(selection_counts_rejected_samples_too);
    RUN_TEST(selection_equals_algorithm_2_on_all_samples);
    RUN_TEST(windows_do_not_reach_across_a_gap);
    RUN_TEST(equal_seeds_give_equal_bits_and_another_seed_the_same_axes);
    RUN_TEST(smallest_buffers_and_no_window_still_work_after_hours);
    RUN_TEST(a_slip_empties_the_window_and_the_new_axes_are_found);
    return UNITY_END();
}

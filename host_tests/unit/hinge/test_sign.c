/* SPDX-License-Identifier: MIT */
/// @file
/// The sign that a hinge reports its axes with, and what a hint of the pairing means, where the largest components nearly tie.
#include "hinge/point.h"
#include "hinge/stream.h"
#include "joint/sign.h"
#include "unit/hinge/fixture.h"

/* An engine that is ready; its motion is of another mounting for each number. */
static void make_ready(uint32_t mounting)
{
    const motion_t motion = motion_lively(mounting);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
}

/* The estimate moves to these axes, as noise might move it. */
static void put(jcal_vec3_t j1, jcal_vec3_t j2)
{
    jcal_hinge_point_set(&engine.refine.point, jcal_vec3_normalise(j1), jcal_vec3_normalise(j2));
}

/* Both axes are reported with the sign of axis 1, or with the opposite one. */
static void assert_reported(float sign)
{
    const jcal_hinge_result_t r = result_of(&engine);
    const jcal_vec3_t j1 = jcal_vec3_scale(engine.refine.point.axis1.j, sign);
    const jcal_vec3_t j2 = jcal_vec3_scale(engine.refine.point.axis2.j, sign);
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(&j1.x, &r.axis1.x, 3);
    TEST_ASSERT_EQUAL_FLOAT_ARRAY(&j2.x, &r.axis2.x, 3);
}

static void before_ready_the_largest_component_is_positive(void)
{
    engine.coarse.has_point = true;
    put(jcal_vec3(0.71f, -0.70f, 0.1f), jcal_vec3(0.0f, 1.0f, 0.0f));
    assert_reported(1.0f);
    put(jcal_vec3(0.70f, -0.71f, 0.1f), jcal_vec3(0.0f, 1.0f, 0.0f));
    assert_reported(-1.0f);
}

static void once_ready_a_tie_of_components_turns_nothing_round(void)
{
    make_ready(9);
    engine.kept_sign[0] = 0;
    put(jcal_vec3(0.71f, -0.70f, 0.1f), jcal_vec3(0.0f, 1.0f, 0.0f));
    jcal_hinge_take_stock(&engine); /* ready, whatever the axes: their sums did not change */
    assert_reported(1.0f);
    put(jcal_vec3(0.70f, -0.71f, 0.1f), jcal_vec3(0.0f, 1.0f, 0.0f));
    jcal_hinge_take_stock(&engine);
    assert_reported(1.0f);
    /* The search may find the same axis as its opposite. */
    put(jcal_vec3(-0.70f, 0.71f, -0.1f), jcal_vec3(0.0f, -1.0f, 0.0f));
    assert_reported(-1.0f);
}

static void noise_about_a_tie_turns_nothing_round(void)
{
    motion_t motion = motion_lively(9);
    motion.gyr_noise_rad_s = 0.03;
    /* The joint axis lies in the middle of x and -y of sensor 1: R(sensor to segment) takes it to z. */
    motion.q_s1_a = jcal_quat(0.70710678f, -0.5f, -0.5f, 0.0f);
    jcal_vec3_t last = {0.0f, 0.0f, 0.0f};
    bool changed[2] = {false, false}; /* which component was the largest */
    for (uint32_t k = 0; k < (6u * RUN); ++k) {
        const jcal_pair_t pair = motion_sample(&motion, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        const jcal_hinge_result_t r = result_of(&engine);
        if (r.head.status == JCAL_READY) {
            TEST_ASSERT_TRUE(jcal_vec3_dot(last, r.axis1) >= 0.0f);
            last = r.axis1;
            changed[(fabsf(r.axis1.x) > fabsf(r.axis1.y)) ? 0 : 1] = true;
        }
    }
    TEST_ASSERT_TRUE(changed[0] && changed[1]); /* or the run did not show anything */
}

static void the_named_direction_chooses_until_ready(void)
{
    const jcal_vec3_t j1 = motion_axis(&(motion_t){.q_s1_a = motion_lively(9).q_s1_a}, 0);
    for (int turn = 0; turn < 2; ++turn) {
        const float sign = (turn == 0) ? 3.0f : -3.0f;
        config.axis1_toward = jcal_vec3_scale(j1, sign);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_init(&engine, &config));
        make_ready(9);
        TEST_ASSERT_TRUE((sign * jcal_vec3_dot(result_of(&engine).axis1, j1)) > 2.9f);
        engine.cfg.axis1_toward = jcal_vec3_scale(j1, -sign);
        TEST_ASSERT_TRUE((sign * jcal_vec3_dot(result_of(&engine).axis1, j1)) > 2.9f);
    }
}

static void a_direction_that_is_no_number_is_refused(void)
{
    config.axis1_toward.y = NAN;
    TEST_ASSERT_EQUAL_STRING("axis1_toward", jcal_hinge_config_check(&config));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_hinge_init(&engine, &config));
}

static void a_reset_frees_the_sign(void)
{
    make_ready(9);
    TEST_ASSERT_TRUE(engine.kept_sign[0] != 0);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
    TEST_ASSERT_EQUAL_INT8(0, engine.kept_sign[0]);
    TEST_ASSERT_EQUAL_INT8(0, engine.kept_sign[1]);
}

static void a_hint_of_the_pairing_means_the_same_beyond_a_tie(void)
{
    const int8_t none[2] = {0, 0};
    const int8_t kept[2] = {1, 2};
    jcal_hinge_point_t point = engine.refine.point;
    jcal_hinge_point_set(&point, jcal_vec3_normalise(jcal_vec3(0.70f, -0.71f, 0.0f)), jcal_vec3(0.0f, 1.0f, 0.0f));
    TEST_ASSERT_FALSE(jcal_hinge_obeys(&point, JCAL_SIGN_SAME, none));
    TEST_ASSERT_TRUE(jcal_hinge_obeys(&point, JCAL_SIGN_SAME, kept));
    TEST_ASSERT_FALSE(jcal_hinge_obeys(&point, JCAL_SIGN_OPPOSITE, kept));
    jcal_hinge_obey(&point, JCAL_SIGN_OPPOSITE, kept);
    TEST_ASSERT_EQUAL_FLOAT(-1.0f, point.axis2.j.y);
    /* The same for axis 2: it is held by its second component, although the first has become larger. */
    jcal_hinge_point_set(&point, jcal_vec3(1.0f, 0.0f, 0.0f), jcal_vec3_normalise(jcal_vec3(-0.71f, 0.70f, 0.0f)));
    TEST_ASSERT_FALSE(jcal_hinge_obeys(&point, JCAL_SIGN_SAME, none));
    TEST_ASSERT_TRUE(jcal_hinge_obeys(&point, JCAL_SIGN_SAME, kept));
}

static void a_tie_does_not_end_ready_where_the_pairing_is_hinted(void)
{
    motion_t motion = motion_paired(true);
    motion.q_s1_a = jcal_quat(0.70710678f, -0.5f, -0.5f, 0.0f);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    const bool same = jcal_sign_held(engine.refine.point.axis1.j, engine.kept_sign[0]) ==
                      jcal_sign_held(engine.refine.point.axis2.j, engine.kept_sign[1]);
    engine.cfg.sign_hint = same ? JCAL_SIGN_SAME : JCAL_SIGN_OPPOSITE;
    const float sign = jcal_vec3_dot(engine.refine.point.axis1.j, motion_axis(&motion, 0)) < 0.0f ? -1.0f : 1.0f;
    const jcal_vec3_t j2 = engine.refine.point.axis2.j;
    for (int side = 0; side < 2; ++side) {
        put(jcal_vec3_scale(jcal_vec3(0.707f + (0.001f * (float)side), -0.7075f, 0.0f), sign), j2);
        jcal_hinge_take_stock(&engine);
        TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(before_ready_the_largest_component_is_positive);
    RUN_TEST(once_ready_a_tie_of_components_turns_nothing_round);
    RUN_TEST(noise_about_a_tie_turns_nothing_round);
    RUN_TEST(the_named_direction_chooses_until_ready);
    RUN_TEST(a_direction_that_is_no_number_is_refused);
    RUN_TEST(a_reset_frees_the_sign);
    RUN_TEST(a_hint_of_the_pairing_means_the_same_beyond_a_tie);
    RUN_TEST(a_tie_does_not_end_ready_where_the_pairing_is_hinted);
    return UNITY_END();
}

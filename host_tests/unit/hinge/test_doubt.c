/* SPDX-License-Identifier: MIT */
/// @file
/// Motion that belongs to no hinge before the sensors are on one: its sums are given up.
#include "hinge/judge.h"
#include "hinge/stream.h"
#include "unit/hinge/fixture.h"

/* Both sensors as they turn on two other joints: no hinge. */
static jcal_pair_t strangers(uint32_t k)
{
    const motion_t one = motion_lively(3);
    motion_t other = motion_lively(5);
    other.speed = 1.4;
    jcal_pair_t pair = motion_sample(&one, k);
    pair.imu2 = motion_sample(&other, k + 777u).imu2;
    return pair;
}

/* Handles the sensors for `samples`, then goes on with the joint; returns the samples of the joint until ready. */
static uint32_t ready_after_handling(uint32_t samples)
{
    const motion_t motion = motion_lively(9);
    for (uint32_t k = 0; k < samples; ++k) {
        jcal_pair_t pair = strangers(k);
        pair.t_us = 1000000u + (20000u * (uint64_t)k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        TEST_ASSERT_NOT_EQUAL(JCAL_READY, result_of(&engine).head.status);
    }
    for (uint32_t k = 0; k < (3u * RUN); ++k) {
        jcal_pair_t pair = motion_sample(&motion, k);
        pair.t_us = 1000000u + (20000u * (uint64_t)(samples + k));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        if (result_of(&engine).head.status == JCAL_READY) {
            const jcal_hinge_result_t r = result_of(&engine);
            assert_axes(&r, &motion);
            return k;
        }
    }
    return UINT32_MAX;
}

static void handling_delays_ready_by_15_seconds_at_most(void)
{
    const uint32_t without = ready_after_handling(0);
    TEST_ASSERT_TRUE(without < RUN);
    const uint32_t lengths[2] = {500u, 3000u}; /* 10 s and a minute */
    for (int i = 0; i < 2; ++i) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_reset(&engine));
        const uint32_t after = ready_after_handling(lengths[i]);
        TEST_ASSERT_TRUE(after < (without + 750u));
    }
}

static void what_does_not_fit_says_so_while_it_begins_anew(void)
{
    bool began = false;
    float longest_s = 0.0f;
    for (uint32_t k = 0; k < 3000u; ++k) {
        const jcal_pair_t pair = strangers(k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        longest_s = fmaxf(longest_s, engine.watch.seen_s[0]);
        if (engine.verdict.after_doubt) {
            began = true;
            const jcal_hinge_result_t r = result_of(&engine);
            TEST_ASSERT_EQUAL_INT(JCAL_COLLECTING, r.head.status);
            TEST_ASSERT_EQUAL_INT(JCAL_REASON_DOES_NOT_FIT, r.head.reason);
            TEST_ASSERT_EQUAL_INT(JCAL_HINT_CHECK_SENSORS, r.head.hint);
        }
    }
    TEST_ASSERT_TRUE(began);
    TEST_ASSERT_TRUE(longest_s < 4.1f);
}

static void a_joint_that_is_ready_is_not_doubted(void)
{
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    engine.verdict.contradicted = true;
    for (uint32_t k = RUN; k < (2u * RUN); ++k) {
        engine.verdict.contradicted = true;
        run(&engine, &motion, k, k + 1u);
    }
    TEST_ASSERT_EQUAL_INT(JCAL_READY, result_of(&engine).head.status);
    TEST_ASSERT_TRUE(engine.coarse.has_point);
}

static void agreement_as_long_as_the_doubt_ends_it(void)
{
    const motion_t motion = motion_lively(9);
    engine.verdict.after_doubt = true;
    engine.cfg.max_bound_rad = 0.001f; /* never ready */
    run(&engine, &motion, 0, RUN);
    TEST_ASSERT_FALSE(engine.verdict.after_doubt);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, engine.watch.seen_s[0]);
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_UNCERTAIN, result_of(&engine).head.reason);
}

static void rest_is_no_contradiction(void)
{
    const motion_t motion = motion_lively(9);
    run(&engine, &motion, 0, 20);
    engine.watch.seen_s[0] = 3.9f;
    engine.verdict.contradicted = true;
    motion_t rest = motion;
    rest.speed = 0.0;
    rest.joint_speed = 0.0;
    for (uint32_t k = 20; k < 40u; ++k) { /* before the next judgements */
        const jcal_pair_t pair = motion_sample(&rest, k);
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_hinge_update(&engine, &pair));
        engine.verdict.contradicted = true;
    }
    TEST_ASSERT_TRUE(engine.watch.seen_s[0] <
                     4.0f); /* what the low-pass lets through in its first moments counts as motion */
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(handling_delays_ready_by_15_seconds_at_most);
    RUN_TEST(what_does_not_fit_says_so_while_it_begins_anew);
    RUN_TEST(a_joint_that_is_ready_is_not_doubted);
    RUN_TEST(agreement_as_long_as_the_doubt_ends_it);
    RUN_TEST(rest_is_no_contradiction);
    return UNITY_END();
}

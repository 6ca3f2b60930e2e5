/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of ball/bounds.h: a lever of which the sums tell nothing, or hardly anything, beside one that they know.
#include "ball/bounds.h"

#include "jointcal/head.h"

#include <math.h>
#include <string.h>
#include <unity.h>

static jcal_ball_t ball;

void setUp(void)
{
}

void tearDown(void)
{
}

/// Sums of a joint whose sensor 2 turned about all axes alike, sum B'B = 1 s^-2 s, and whose sensor 1 turned by `turned1` of that.
static void make_up(float turned1)
{
    static const size_t diagonal[] = {2u, 5u, 9u};
    memset(&ball, 0, sizeof ball);
    ball.sums.motion_s = 10.0f;
    ball.sums.block_motion_s[0] = 10.0f;
    ball.sums.levers.own1[0] = 1.0f;
    ball.sums.levers.own2[0] = 1.0f;
    ball.sums.levers.block[0].re[0] = 1.0f; /* velocities that agree tell the heading */
    for (size_t i = 0u; i < 3u; ++i) {
        ball.sums.levers.own1[diagonal[i]] = turned1;
        ball.sums.levers.own2[diagonal[i]] = 1.0f;
    }
    ball.point.heading[0].re = 1.0f;
    ball.point.heading[1].re = 1.0f;
    ball.point.size = 1e-4f;
    for (unsigned part = 0u; part < JCAL_BALL_BOUND_SLICES; ++part) {
        jcal_ball_bound(&ball, part);
    }
}

/* Both levers are zero and nothing is left, so that a bound is 3 mm and half of the standard deviation: of information
   turned / (size (0.16 W + 1 s)), that is turned / 2.6e-4 m^-2. */
static void what_is_told_has_its_bound(void)
{
    make_up(0.01f);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.003f + 0.5f * sqrtf(2.6e-4f / 0.01f), ball.verdict.bound1_m);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.003f + 0.5f * sqrtf(2.6e-4f), ball.verdict.bound2_m);
}

/* Nothing, less than rounding, and little more than that: no bound, and none the less one of the other lever and of the heading. */
static void what_nothing_tells_of_spoils_no_other(void)
{
    const float turned[] = {0.0f, 1e-8f, 1e-6f, 4e-6f, 8e-6f};
    make_up(1.0f);
    const jcal_ball_verdict_t both = ball.verdict;
    TEST_ASSERT_TRUE(both.heading_rad < 0.1f);
    for (size_t i = 0u; i < sizeof turned / sizeof turned[0]; ++i) {
        make_up(turned[i]);
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, ball.verdict.bound1_m);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, both.bound2_m, ball.verdict.bound2_m);
        TEST_ASSERT_FLOAT_WITHIN(1e-5f, both.heading_rad, ball.verdict.heading_rad);
    }
}

/* The ridge of the solve takes a share of a lever: the bound has it. The normal equations say 0.1 m, the estimate 0.06. */
static void what_the_ridge_takes_is_in_the_bound(void)
{
    make_up(0.01f);
    const float without = ball.verdict.bound1_m;
    ball.sums.levers.own1[3] = 0.01f * 0.1f; /* slope along y: r = 0.1 m */
    ball.point.r1.y = 0.06f;
    jcal_ball_bound(&ball, JCAL_BALL_BOUND_SLICES - 1u);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, without + 0.04f + JCAL_BALL_SKIN1 * 0.06f, ball.verdict.bound1_m);
}

/* Errors of the regressors shorten a lever, and of one that is open nothing is left: the other has its bound none the less. */
static void errors_of_one_lever_are_its_own(void)
{
    make_up(1.0f);
    for (int open = 1; open <= 2; ++open) {
        ball.point.lack = 4e-4f; /* beside (0.2 m)^2 that is 1 % of what is known */
        ball.point.r1 = (jcal_vec3_t){(open == 2) ? 0.2f : 0.0f, 0.0f, 0.0f};
        ball.point.r2 = (jcal_vec3_t){(open == 1) ? 0.2f : 0.0f, 0.0f, 0.0f};
        for (size_t i = 0u; i < 3u; ++i) {
            static const size_t diagonal[] = {2u, 5u, 9u};
            ball.sums.levers.own1[diagonal[i]] = (open == 1) ? 0.0f : 1.0f;
            ball.sums.levers.own2[diagonal[i]] = (open == 2) ? 0.0f : 1.0f;
        }
        ball.sums.levers.own1[1] = (open == 2) ? 0.2f : 0.0f; /* slope along x */
        ball.sums.levers.own2[1] = (open == 1) ? 0.2f : 0.0f;
        for (unsigned part = 0u; part < JCAL_BALL_BOUND_SLICES; ++part) {
            jcal_ball_bound(&ball, part);
        }
        const float open_m = (open == 1) ? ball.verdict.bound1_m : ball.verdict.bound2_m;
        const float known_m = (open == 1) ? ball.verdict.bound2_m : ball.verdict.bound1_m;
        const float skin = ((open == 1) ? JCAL_BALL_SKIN2 : JCAL_BALL_SKIN1) * 0.2f;
        TEST_ASSERT_EQUAL_FLOAT(JCAL_BOUND_UNKNOWN_M, open_m);
        TEST_ASSERT_FLOAT_WITHIN(2e-5f, 0.003f + 0.5f * sqrtf(2.6e-4f) + 0.2f * 0.01f / 0.99f + skin, known_m);
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(what_is_told_has_its_bound);
    RUN_TEST(what_nothing_tells_of_spoils_no_other);
    RUN_TEST(what_the_ridge_takes_is_in_the_bound);
    RUN_TEST(errors_of_one_lever_are_its_own);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of joint/watch.h: what is a slip and what is not.
#include "joint/watch.h"

#include <string.h>
#include <unity.h>

#define DT_S 0.02f

static jcal_watch_t watch;

void setUp(void)
{
    memset(&watch, 0, sizeof watch);
}

void tearDown(void)
{
}

/* Feeds a residual's square for some time of motion; when the alarm rang, s, or -1. */
static float feed(unsigned kind, float square, float seconds)
{
    for (float t = 0.0f; t < seconds; t += DT_S) {
        jcal_watch_add(&watch, kind, square, DT_S);
        if (jcal_watch_alarm(&watch)) {
            return t;
        }
    }
    return -1.0f;
}

static void a_slip_is_noticed_within_a_second_of_motion(void)
{
    for (unsigned kind = 0u; kind < 2u; ++kind) {
        setUp();
        TEST_ASSERT_TRUE(feed(kind, 0.5f, 10.0f) < 0.0f);
        jcal_watch_start(&watch);
        TEST_ASSERT_TRUE(feed(kind, 0.5f, 30.0f) < 0.0f);
        const float after_s = feed(kind, 20.0f, 10.0f);
        /* the mean over 1 s rises as 1 - exp(-t) to six times 0.5: 0.14 s */
        TEST_ASSERT_TRUE((after_s > 0.05f) && (after_s < 1.0f));
    }
}

static void before_there_is_a_calibration_nothing_rings(void)
{
    TEST_ASSERT_TRUE(feed(0u, 0.1f, 10.0f) < 0.0f);
    TEST_ASSERT_TRUE(feed(0u, 1000.0f, 10.0f) < 0.0f);
    jcal_watch_start(&watch);
    TEST_ASSERT_FALSE(jcal_watch_alarm(&watch)); /* what was then is the usual now */
}

static void a_factor_of_five_is_not_enough(void)
{
    (void)feed(0u, 1.0f, 10.0f);
    jcal_watch_start(&watch);
    (void)feed(0u, 1.0f, 30.0f);
    TEST_ASSERT_TRUE(feed(0u, 5.0f, 20.0f) < 0.0f);
}

static void calm_moments_are_no_measure(void)
{
    (void)feed(0u, 1e-4f, 10.0f);
    jcal_watch_start(&watch);
    const jcal_watch_t calm = watch;
    TEST_ASSERT_TRUE(feed(0u, 1.4f, 20.0f) < 0.0f); /* below six times a quarter */
    watch = calm;
    TEST_ASSERT_TRUE(feed(0u, 8.0f, 20.0f) > 0.0f);
}

static void rest_tells_nothing(void)
{
    (void)feed(0u, 0.5f, 10.0f);
    jcal_watch_start(&watch);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, jcal_watch_motion(0.0f));
    TEST_ASSERT_EQUAL_FLOAT(0.5f, jcal_watch_motion(0.25f));
    TEST_ASSERT_TRUE(jcal_watch_motion(25.0f) > 0.98f);
    for (int k = 0; k < 100000; ++k) {
        jcal_watch_add(&watch, 0u, 1000.0f, DT_S * jcal_watch_motion(0.0f));
    }
    TEST_ASSERT_FALSE(jcal_watch_alarm(&watch));
}

static void a_few_spoilt_samples_are_no_slip(void)
{
    (void)feed(0u, 0.5f, 10.0f);
    jcal_watch_start(&watch);
    (void)feed(0u, 0.5f, 30.0f);
    jcal_watch_add(&watch, 0u, 1e6f, DT_S);
    jcal_watch_add(&watch, 0u, 1e6f, DT_S);
    TEST_ASSERT_FALSE(jcal_watch_alarm(&watch));
}

static void a_slow_growth_moves_what_is_usual(void)
{
    (void)feed(0u, 0.5f, 10.0f);
    jcal_watch_start(&watch);
    float square = 0.5f;
    for (int k = 0; k < 60; ++k) {
        square *= 1.05f; /* eighteen times in a minute */
        TEST_ASSERT_TRUE(feed(0u, square, 1.0f) < 0.0f);
    }
}

static void starting_again_changes_nothing(void)
{
    (void)feed(0u, 0.5f, 10.0f);
    jcal_watch_start(&watch);
    (void)feed(0u, 2.0f, 0.5f);
    const jcal_watch_t before = watch;
    jcal_watch_start(&watch);
    TEST_ASSERT_EQUAL_MEMORY(&before, &watch, sizeof watch);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(a_slip_is_noticed_within_a_second_of_motion);
    RUN_TEST(before_there_is_a_calibration_nothing_rings);
    RUN_TEST(a_factor_of_five_is_not_enough);
    RUN_TEST(calm_moments_are_no_measure);
    RUN_TEST(rest_tells_nothing);
    RUN_TEST(a_few_spoilt_samples_are_no_slip);
    RUN_TEST(a_slow_growth_moves_what_is_usual);
    RUN_TEST(starting_again_changes_nothing);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/orientation.h and sample/rate.h: which pairs are refused and why, and rates between two orientations.
#include "jointcal/orientation.h"
#include "sample/rate.h"
#include "unit/angles/pose.h"

#include <string.h>
#include <unity.h>

static jcal_orientation_gate_t gate;
static jcal_gate_config_t config;
static uint64_t now_us;

void setUp(void)
{
    memset(&gate, 0, sizeof gate);
    config = jcal_gate_config_default();
    now_us = 1000000u;
}

void tearDown(void)
{
}

/* The k-th of a series of different pairs, 10 ms after the one before. */
static jcal_orientation_pair_t next(int k)
{
    now_us += 10000u;
    const jcal_orientation_pair_t pair = {now_us, pose_single(pose_any(k)), pose_single(pose_any(k + 500))};
    return pair;
}

static jcal_reject_t check(const jcal_orientation_pair_t *pair)
{
    return jcal_orientation_gate_check(&gate, &config, pair);
}

static void good_pairs_pass(void)
{
    for (int k = 0; k < 100; ++k) {
        const jcal_orientation_pair_t pair = next(k);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
    TEST_ASSERT_EQUAL_UINT32(100u, gate.samples);
    TEST_ASSERT_EQUAL_FLOAT(0.0f, gate.bad_share);
    for (int i = 0; i < JCAL_REJECT_COUNT; ++i) {
        TEST_ASSERT_EQUAL_UINT32(0u, gate.rejected_by[i]);
    }
}

static void each_component_must_be_finite(void)
{
    for (int i = 0; i < 8; ++i) {
        const float bad[3] = {NAN, INFINITY, -INFINITY};
        for (int b = 0; b < 3; ++b) {
            jcal_orientation_pair_t pair = next(i);
            float *const q[2] = {&pair.q1.w, &pair.q2.w};
            q[i / 4][i % 4] = bad[b];
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NOT_FINITE, check(&pair));
        }
    }
    TEST_ASSERT_EQUAL_UINT32(24u, gate.rejected_by[JCAL_REJECT_NOT_FINITE]);
    TEST_ASSERT_FALSE(gate.has_last); /* nothing of them is remembered */
}

static void lengths_may_differ_from_one_by_a_twentieth(void)
{
    const struct {
        float length;
        jcal_reject_t expected;
    } cases[] = {{0.94f, JCAL_REJECT_OUT_OF_RANGE},
                 {0.96f, JCAL_REJECT_NONE},
                 {1.04f, JCAL_REJECT_NONE},
                 {1.06f, JCAL_REJECT_OUT_OF_RANGE},
                 {0.0f, JCAL_REJECT_OUT_OF_RANGE}};
    for (int sensor = 0; sensor < 2; ++sensor) {
        for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
            jcal_orientation_pair_t pair = next((int)i);
            float *const q = (sensor == 0) ? &pair.q1.w : &pair.q2.w;
            for (int k = 0; k < 4; ++k) {
                q[k] *= cases[i].length;
            }
            TEST_ASSERT_EQUAL_INT(cases[i].expected, check(&pair));
        }
    }
}

static void time_must_increase(void)
{
    jcal_orientation_pair_t pair = next(1);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    const uint64_t first_us = pair.t_us;
    pair = next(2);
    pair.t_us = first_us;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, check(&pair));
    pair.t_us = first_us - 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, check(&pair));
    pair.t_us = first_us + 1u;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
}

static void a_repeated_quaternion_is_a_lost_packet_and_then_frozen(void)
{
    for (int sensor = 0; sensor < 2; ++sensor) {
        setUp();
        const jcal_orientation_pair_t first = next(1);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&first));
        for (int k = 1; k <= 60; ++k) {
            jcal_orientation_pair_t pair = next(k + 1);
            if (sensor == 0) {
                pair.q1 = first.q1;
            } else {
                pair.q2 = first.q2;
            }
            /* 0.3 s by default: 30 of 10 ms, give or take the rounding of their sum */
            const jcal_reject_t got = check(&pair);
            if (k < 30) {
                TEST_ASSERT_EQUAL_INT(JCAL_REJECT_REPEATED, got);
            }
            if (k > 31) {
                TEST_ASSERT_EQUAL_INT(JCAL_REJECT_FROZEN, got);
            }
        }
        TEST_ASSERT_TRUE(gate.bad_share > 0.5f);
        const jcal_orientation_pair_t again = next(77);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&again));
    }
}

static void a_change_of_any_component_is_a_new_value(void)
{
    for (int component = 0; component < 4; ++component) {
        setUp();
        jcal_orientation_pair_t pair = next(1);
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
        pair.t_us += 10000u;
        float *const parts[4] = {&pair.q1.w, &pair.q1.x, &pair.q1.y, &pair.q1.z};
        *parts[component] += 0.01f;
        pair.q2 = next(2).q2;
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    }
}

static void a_turned_sign_is_another_number_but_the_same_orientation(void)
{
    jcal_orientation_pair_t pair = next(1);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    const jcal_quat_t q = pair.q1;
    pair = next(2);
    pair.q1 = (jcal_quat_t){-q.w, -q.x, -q.y, -q.z};
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    const jcal_vec3_t rate = jcal_rate_between(q, pair.q1, 0.01f);
    TEST_ASSERT_FLOAT_WITHIN(1e-4f, 0.0f, jcal_vec3_norm(rate));
}

static void the_first_pair_after_a_hole_is_refused(void)
{
    jcal_orientation_pair_t pair = next(1);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    now_us += 245000u;
    pair = next(2);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_GAP, check(&pair));
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_orientation_gate_complaint(&gate)); /* one alone says nothing */
    pair = next(3);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    now_us += 230000u;
    pair = next(4);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
}

static void a_stream_of_which_more_than_a_fifth_is_bad_is_complained_of(void)
{
    for (int share = 0; share < 2; ++share) { /* a sixth, a third */
        setUp();
        for (int k = 1; k < 600; ++k) {
            jcal_orientation_pair_t pair = next(k);
            if ((k % ((share == 0) ? 6 : 3)) == 0) {
                pair.q2.y = NAN;
            }
            (void)check(&pair);
        }
        TEST_ASSERT_EQUAL_INT((share == 0) ? JCAL_REASON_NONE : JCAL_REASON_BAD_SAMPLES,
                              jcal_orientation_gate_complaint(&gate));
    }
    setUp();
    for (int k = 1; k < 20; ++k) {
        const jcal_orientation_pair_t pair = next(k);
        (void)check(&pair);
        now_us += 400000u; /* all that comes is after a hole, and none is taken */
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REASON_BAD_SAMPLES, jcal_orientation_gate_complaint(&gate));
}

static void the_cause_that_counts_is_the_first(void)
{
    jcal_orientation_pair_t pair = next(1);
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, check(&pair));
    pair.q2.x = NAN; /* and time stands still */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NOT_FINITE, check(&pair));
    pair.q2.x = 3.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, check(&pair));
    pair.t_us += 900000u; /* a hole, too */
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_OUT_OF_RANGE, check(&pair));
}

/* Rates. */

static void the_rate_is_that_of_the_turn(void)
{
    for (int k = 0; k < 50; ++k) {
        const double angle = 0.06 * k; /* up to 3 rad */
        const double axis[3] = {sin(1.0 * k), cos(2.0 * k), 0.5};
        const double length = sqrt(axis[0] * axis[0] + axis[1] * axis[1] + axis[2] * axis[2]);
        const pose_quat_t from = pose_any(k);
        const pose_quat_t to = pose_mul(pose_turn(angle, axis[0], axis[1], axis[2]), from); /* about earth-fixed axes */
        const jcal_vec3_t rate = jcal_rate_between(pose_single(from), pose_single(to), 0.5f);
        TEST_ASSERT_DOUBLE_WITHIN(5e-6, angle / 0.5 * axis[0] / length, (double)rate.x);
        TEST_ASSERT_DOUBLE_WITHIN(5e-6, angle / 0.5 * axis[1] / length, (double)rate.y);
        TEST_ASSERT_DOUBLE_WITHIN(5e-6, angle / 0.5 * axis[2] / length, (double)rate.z);
    }
}

static void small_turns_keep_their_digits(void)
{
    /* (A42) with an arc cosine is wrong by 3e-4 rad here; a component of a quaternion is good to 3e-8. */
    const double angles[] = {1e-6, 1e-5, 1e-4, 2.1e-4, 1e-3};
    for (size_t i = 0; i < sizeof angles / sizeof angles[0]; ++i) {
        const pose_quat_t from = {1.0, 0.0, 0.0, 0.0};
        const pose_quat_t to = pose_turn(angles[i], 0.0, 1.0, 0.0);
        const jcal_vec3_t rate = jcal_rate_between(pose_single(from), pose_single(to), 1.0f);
        TEST_ASSERT_DOUBLE_WITHIN(1e-6 * angles[i], angles[i], (double)rate.y);
    }
}

static void signs_of_quaternions_do_not_matter_to_the_rate(void)
{
    const pose_quat_t from = pose_any(3);
    const pose_quat_t to = pose_mul(pose_turn(0.2, 0.3, -0.5, 0.8), from);
    const jcal_quat_t a = pose_single(from);
    const jcal_quat_t b = pose_single(to);
    const jcal_quat_t turned = {-b.w, -b.x, -b.y, -b.z};
    const jcal_vec3_t one = jcal_rate_between(a, b, 0.04f);
    const jcal_vec3_t other = jcal_rate_between(a, turned, 0.04f);
    TEST_ASSERT_FLOAT_WITHIN(1e-5f, 0.0f, jcal_vec3_norm(jcal_vec3_sub(one, other)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(good_pairs_pass);
    RUN_TEST(each_component_must_be_finite);
    RUN_TEST(lengths_may_differ_from_one_by_a_twentieth);
    RUN_TEST(time_must_increase);
    RUN_TEST(a_repeated_quaternion_is_a_lost_packet_and_then_frozen);
    RUN_TEST(a_change_of_any_component_is_a_new_value);
    RUN_TEST(a_turned_sign_is_another_number_but_the_same_orientation);
    RUN_TEST(the_first_pair_after_a_hole_is_refused);
    RUN_TEST(the_cause_that_counts_is_the_first);
    RUN_TEST(a_stream_of_which_more_than_a_fifth_is_bad_is_complained_of);
    RUN_TEST(the_rate_is_that_of_the_turn);
    RUN_TEST(small_turns_keep_their_digits);
    RUN_TEST(signs_of_quaternions_do_not_matter_to_the_rate);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/sample/clock.h, and of both gates with clocks that jump.
#include "jointcal/orientation.h"
#include "sample/clock.h"
#include "unit/sample/gate_fixture.h"

static const float GAP_S = 0.25f;

static jcal_clock_t watch;

static jcal_reject_t at(uint64_t t_us)
{
    float dt_s;
    return jcal_clock_check(&watch, GAP_S, t_us, &dt_s);
}

/* Samples 0.02 s apart from `from_us` on; how many are rejected before one is believed. */
static uint32_t rejected_from(uint64_t from_us)
{
    uint32_t rejected = 0;
    for (uint32_t k = 0; k < 100u; ++k) {
        if (at(from_us + (20000u * k)) == JCAL_REJECT_NONE) {
            break;
        }
        ++rejected;
    }
    return rejected;
}

static void begin_at(uint64_t t_us)
{
    memset(&watch, 0, sizeof watch);
    TEST_ASSERT_EQUAL_UINT32(0, rejected_from(t_us));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, at(t_us + 20000u));
}

static void one_wild_time_stamp_costs_one_sample(void)
{
    const uint64_t wild[] = {1ull << 40, UINT64_MAX, 7u, 0u};
    for (int i = 0; i < 4; ++i) {
        begin_at(5000000u);
        TEST_ASSERT_EQUAL_INT((wild[i] > 5000000u) ? JCAL_REJECT_GAP : JCAL_REJECT_TIME_ORDER, at(wild[i]));
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, at(5040000u));
    }
}

static void a_hole_costs_the_sample_after_it(void)
{
    const uint64_t holes[] = {300000u, 1ull << 32, (1ull << 32) + 20000u, 1ull << 60};
    for (int i = 0; i < 4; ++i) {
        begin_at(5000000u);
        TEST_ASSERT_EQUAL_UINT32(1, rejected_from(5020000u + holes[i]));
    }
}

static void a_clock_that_begins_anew_is_believed_after_four_tenths_of_a_second(void)
{
    begin_at(0xFFFFFFFFu); /* 32-bit microseconds run over */
    TEST_ASSERT_EQUAL_UINT32(21, rejected_from(0u));
    begin_at(UINT64_MAX - 5000000u);
    TEST_ASSERT_EQUAL_UINT32(21, rejected_from(1u));
    begin_at(5000000u);
    for (uint32_t k = 0; k < 20u; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, at(20000u * k));
    }
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_GAP, at(20000u * 20u));
    TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, at(20000u * 21u));
}

static void packets_in_the_wrong_order_never_take_the_clock_back(void)
{
    begin_at(0u);
    for (uint64_t block = 0; block < 50u; ++block) {
        for (uint64_t k = 10; k < 20u; ++k) { /* the second half of each block first */
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_NONE, at(20000u * ((20u * block) + k)));
        }
        for (uint64_t k = (block == 0u) ? 2u : 0u; k < 10u; ++k) {
            TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, at(20000u * ((20u * block) + k)));
        }
    }
}

static void a_clock_that_stands_is_never_believed(void)
{
    begin_at(5000000u);
    for (uint32_t k = 0; k < 200u; ++k) {
        TEST_ASSERT_EQUAL_INT(JCAL_REJECT_TIME_ORDER, at(1000u));
    }
}

static void both_gates_go_on_within_a_second_and_count_it(void)
{
    jcal_orientation_gate_t orientations;
    memset(&orientations, 0, sizeof orientations);
    accept(100);
    now_us = 0u;
    uint32_t rejected = 0;
    for (uint32_t k = 0; k < 50u; ++k) {
        const jcal_pair_t pair = good();
        rejected += (check(&pair) == JCAL_REJECT_NONE) ? 0u : 1u;
        TEST_ASSERT_EQUAL_INT(JCAL_REASON_NONE, jcal_gate_complaint(&gate)); /* what is ready stays so */
    }
    TEST_ASSERT_EQUAL_UINT32(21, rejected);
    TEST_ASSERT_EQUAL_UINT32(20, gate.rejected_by[JCAL_REJECT_TIME_ORDER]);
    TEST_ASSERT_EQUAL_UINT32(1, gate.rejected_by[JCAL_REJECT_GAP]);
    for (uint32_t k = 0; k < 200u; ++k) {
        const float x = 0.001f * (float)k;
        const jcal_quat_t q = {sqrtf(1.0f - (x * x)), x, 0.0f, 0.0f};
        const jcal_orientation_pair_t pair = {(k < 100u) ? (9000000u + (20000u * k)) : (20000u * (k - 100u)), q, q};
        (void)jcal_orientation_gate_check(&orientations, &config, &pair);
    }
    TEST_ASSERT_EQUAL_UINT32(20, orientations.rejected_by[JCAL_REJECT_TIME_ORDER]);
    TEST_ASSERT_EQUAL_UINT32(1, orientations.rejected_by[JCAL_REJECT_GAP]);
}

/* Samples `step_us` apart; how many it takes until the rate is called too low. */
static uint32_t slow_after(uint32_t step_us)
{
    uint64_t t_us = 0;
    for (uint32_t k = 0; k < 1000u; ++k) {
        if (jcal_clock_is_slow(&watch)) {
            return k;
        }
        t_us += step_us;
        (void)at(t_us);
    }
    return 0;
}

static void fewer_than_ten_samples_a_second_are_too_few(void)
{
    const uint32_t enough_us[] = {1000u, 50000u, 100000u, 104000u};
    for (int i = 0; i < 4; ++i) {
        memset(&watch, 0, sizeof watch);
        TEST_ASSERT_EQUAL_UINT32(0, slow_after(enough_us[i]));
    }
    const uint32_t slow_us[] = {106000u, 125000u, 200000u, 300000u, 2000000u};
    for (int i = 0; i < 5; ++i) {
        memset(&watch, 0, sizeof watch);
        TEST_ASSERT_UINT32_WITHIN(2, 22, slow_after(slow_us[i]));
    }
}

static void a_rate_that_comes_back_is_enough_again(void)
{
    memset(&watch, 0, sizeof watch);
    uint64_t t_us = 0;
    for (uint32_t k = 0; k < 500u; ++k) { /* however long it was too low */
        t_us += 150000u;
        (void)at(t_us);
    }
    TEST_ASSERT_TRUE(jcal_clock_is_slow(&watch));
    for (uint32_t k = 0; k < JCAL_CLOCK_SLOW_MOST; ++k) {
        t_us += 20000u;
        (void)at(t_us);
    }
    TEST_ASSERT_FALSE(jcal_clock_is_slow(&watch));
}

static void single_losses_are_no_low_rate(void)
{
    memset(&watch, 0, sizeof watch);
    uint64_t t_us = 0;
    for (uint32_t k = 0; k < 1000u; ++k) { /* every third sample comes late */
        t_us += ((k % 3u) == 0u) ? 200000u : 20000u;
        (void)at(t_us);
        TEST_ASSERT_FALSE(jcal_clock_is_slow(&watch));
    }
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(one_wild_time_stamp_costs_one_sample);
    RUN_TEST(a_hole_costs_the_sample_after_it);
    RUN_TEST(a_clock_that_begins_anew_is_believed_after_four_tenths_of_a_second);
    RUN_TEST(packets_in_the_wrong_order_never_take_the_clock_back);
    RUN_TEST(a_clock_that_stands_is_never_believed);
    RUN_TEST(fewer_than_ten_samples_a_second_are_too_few);
    RUN_TEST(a_rate_that_comes_back_is_enough_again);
    RUN_TEST(single_losses_are_no_low_rate);
    RUN_TEST(both_gates_go_on_within_a_second_and_count_it);
    return UNITY_END();
}

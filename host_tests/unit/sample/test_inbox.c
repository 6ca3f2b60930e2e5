/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/sample/inbox.h.
#include "sample/inbox.h"

#include "unity.h"

#include <string.h>

static jcal_inbox_t inbox;

void setUp(void)
{
    memset(&inbox, 0, sizeof inbox);
}

void tearDown(void)
{
}

/* Every member differs from every other and from those of any other k below 1000. */
static jcal_pair_t numbered(uint32_t k)
{
    const float f = (float)k;
    const jcal_pair_t pair = {.t_us = ((uint64_t)k << 33) + k,
                              .imu1 = {{f + 0.01f, f + 0.02f, f + 0.03f}, {f + 0.04f, f + 0.05f, f + 0.06f}},
                              .imu2 = {{f + 0.07f, f + 0.08f, f + 0.09f}, {f + 0.10f, f + 0.11f, f + 0.12f}}};
    return pair;
}

static void put(uint32_t k)
{
    const jcal_pair_t pair = numbered(k);
    TEST_ASSERT_FALSE(jcal_inbox_full(&inbox));
    jcal_inbox_put(&inbox, &pair);
}

static void assert_takes(uint32_t k)
{
    const jcal_pair_t expected = numbered(k);
    jcal_pair_t taken;
    TEST_ASSERT_TRUE(jcal_inbox_take(&inbox, &taken));
    TEST_ASSERT_TRUE(taken.t_us == expected.t_us);
    TEST_ASSERT_EQUAL_MEMORY(&expected.imu1, &taken.imu1, sizeof taken.imu1);
    TEST_ASSERT_EQUAL_MEMORY(&expected.imu2, &taken.imu2, sizeof taken.imu2);
}

static void an_empty_inbox_gives_nothing_and_leaves_the_output_untouched(void)
{
    jcal_pair_t out = numbered(7);
    TEST_ASSERT_FALSE(jcal_inbox_take(&inbox, &out));
    TEST_ASSERT_TRUE(out.t_us == numbered(7).t_us);
    TEST_ASSERT_FALSE(jcal_inbox_full(&inbox));
}

static void pairs_come_out_in_the_order_in_which_they_went_in(void)
{
    uint32_t in = 0;
    uint32_t out = 0;
    for (uint32_t round = 0; round < 100; ++round) {
        const uint32_t burst = 1u + (round % JCAL_INBOX_CAPACITY);
        for (uint32_t k = 0; k < burst; ++k) {
            put(in++);
        }
        for (uint32_t k = 0; k < burst; ++k) {
            assert_takes(out++);
        }
    }
    jcal_pair_t none;
    TEST_ASSERT_FALSE(jcal_inbox_take(&inbox, &none));
}

static void it_is_full_at_its_capacity_and_not_before(void)
{
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        put(k);
    }
    TEST_ASSERT_TRUE(jcal_inbox_full(&inbox));
    assert_takes(0);
    TEST_ASSERT_FALSE(jcal_inbox_full(&inbox));
    put(JCAL_INBOX_CAPACITY);
    TEST_ASSERT_TRUE(jcal_inbox_full(&inbox));
    for (uint32_t k = 1; k <= JCAL_INBOX_CAPACITY; ++k) {
        assert_takes(k);
    }
}

static void counters_that_run_over_lose_nothing(void)
{
    inbox.written = UINT32_MAX - 1u; /* 2 years at 50 Hz */
    inbox.taken = UINT32_MAX - 1u;
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        put(k);
    }
    TEST_ASSERT_TRUE(jcal_inbox_full(&inbox));
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        assert_takes(k);
    }
    jcal_pair_t none;
    TEST_ASSERT_FALSE(jcal_inbox_take(&inbox, &none));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_empty_inbox_gives_nothing_and_leaves_the_output_untouched);
    RUN_TEST(pairs_come_out_in_the_order_in_which_they_went_in);
    RUN_TEST(it_is_full_at_its_capacity_and_not_before);
    RUN_TEST(counters_that_run_over_lose_nothing);
    return UNITY_END();
}

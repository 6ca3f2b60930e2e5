/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of lib/sample/ring.h, with the pairs of private/inbox.h in its slots.
#include "sample/ring.h"

#include "jointcal/private/inbox.h"

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
    uint32_t slot;
    TEST_ASSERT_TRUE(jcal_ring_room(&inbox.ring, &slot));
    inbox.slots[slot] = pair;
    jcal_ring_publish(&inbox.ring);
}

static bool take(jcal_pair_t *out)
{
    uint32_t slot;
    if (!jcal_ring_peek(&inbox.ring, &slot)) {
        return false;
    }
    *out = inbox.slots[slot];
    jcal_ring_release(&inbox.ring);
    return true;
}

static bool is_full(void)
{
    return jcal_ring_waiting(&inbox.ring) == JCAL_INBOX_CAPACITY;
}

static void assert_takes(uint32_t k)
{
    const jcal_pair_t expected = numbered(k);
    jcal_pair_t taken;
    TEST_ASSERT_TRUE(take(&taken));
    TEST_ASSERT_TRUE(taken.t_us == expected.t_us);
    TEST_ASSERT_EQUAL_MEMORY(&expected.imu1, &taken.imu1, sizeof taken.imu1);
    TEST_ASSERT_EQUAL_MEMORY(&expected.imu2, &taken.imu2, sizeof taken.imu2);
}

static void an_empty_inbox_gives_nothing_and_leaves_the_output_untouched(void)
{
    jcal_pair_t out = numbered(7);
    TEST_ASSERT_FALSE(take(&out));
    TEST_ASSERT_TRUE(out.t_us == numbered(7).t_us);
    TEST_ASSERT_FALSE(is_full());
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
    TEST_ASSERT_FALSE(take(&none));
}

static void it_is_full_at_its_capacity_and_not_before(void)
{
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        put(k);
    }
    TEST_ASSERT_TRUE(is_full());
    assert_takes(0);
    TEST_ASSERT_FALSE(is_full());
    put(JCAL_INBOX_CAPACITY);
    TEST_ASSERT_TRUE(is_full());
    for (uint32_t k = 1; k <= JCAL_INBOX_CAPACITY; ++k) {
        assert_takes(k);
    }
}

static void a_sample_that_finds_no_room_is_counted_and_changes_nothing_else(void)
{
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        put(k);
    }
    uint32_t slot = 99u;
    for (uint32_t k = 1; k <= 3; ++k) {
        const jcal_inbox_t before = inbox;
        TEST_ASSERT_FALSE(jcal_ring_room(&inbox.ring, &slot));
        TEST_ASSERT_EQUAL_UINT32(99, slot);
        TEST_ASSERT_EQUAL_UINT32(k, inbox.ring.overrun);
        TEST_ASSERT_EQUAL_MEMORY(before.slots, inbox.slots, sizeof inbox.slots);
    }
    assert_takes(0);
}

static void a_slot_is_free_only_after_it_was_given_back(void)
{
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        put(k);
    }
    uint32_t taken;
    uint32_t free_slot;
    TEST_ASSERT_TRUE(jcal_ring_peek(&inbox.ring, &taken));
    TEST_ASSERT_FALSE(jcal_ring_room(&inbox.ring, &free_slot)); /* an interrupt while step copies */
    jcal_ring_release(&inbox.ring);
    TEST_ASSERT_TRUE(jcal_ring_room(&inbox.ring, &free_slot));
    TEST_ASSERT_EQUAL_UINT32(taken, free_slot);
}

static void counters_that_run_over_lose_nothing(void)
{
    inbox.ring.written = UINT16_MAX - 1u; /* 22 minutes at 50 Hz */
    inbox.ring.taken = UINT16_MAX - 1u;
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        put(k);
    }
    TEST_ASSERT_TRUE(is_full());
    for (uint32_t k = 0; k < JCAL_INBOX_CAPACITY; ++k) {
        assert_takes(k);
    }
    jcal_pair_t none;
    TEST_ASSERT_FALSE(take(&none));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(an_empty_inbox_gives_nothing_and_leaves_the_output_untouched);
    RUN_TEST(pairs_come_out_in_the_order_in_which_they_went_in);
    RUN_TEST(it_is_full_at_its_capacity_and_not_before);
    RUN_TEST(a_sample_that_finds_no_room_is_counted_and_changes_nothing_else);
    RUN_TEST(a_slot_is_free_only_after_it_was_given_back);
    RUN_TEST(counters_that_run_over_lose_nothing);
    return UNITY_END();
}

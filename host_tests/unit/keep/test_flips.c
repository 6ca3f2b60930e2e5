/* SPDX-License-Identifier: MIT */
/// @file
/// Every single and every double bit error of a record and of the head of a slot is noticed.
#include "unit/keep/fixture.h"

#define RECORD_BITS (8u * JCAL_KEPT_BYTES)
#define HEAD_BITS (8u * JCAL_KEEP_HEAD_BYTES)

/* Pairs whose first bit is a multiple of this: on emulated targets a part of them; the PC has them all. */
#ifdef JCAL_TEST_SHORT
#define STRIDE 37u
#else
#define STRIDE 1u
#endif

void setUp(void)
{
}

void tearDown(void)
{
}

static void flip(uint8_t *bytes, unsigned bit)
{
    bytes[bit / 8u] ^= (uint8_t)(1u << (bit % 8u));
}

static void flips_of_a_record_are_noticed(void)
{
    const jcal_kept_t kept = hinge_of(3u);
    const jcal_kept_wanted_t wanted = wanted_of(&kept);
    uint8_t bytes[JCAL_KEPT_BYTES];
    jcal_kept_t out;
    unsigned missed = 0u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_kept_encode(&kept, bytes));
    for (unsigned a = 0u; a < RECORD_BITS; a++) {
        flip(bytes, a);
        missed += (jcal_kept_decode(bytes, &wanted, &out) != JCAL_KEPT_DAMAGED) ? 1u : 0u;
        for (unsigned b = a + 1u; a % STRIDE == 0u && b < RECORD_BITS; ++b) {
            flip(bytes, b);
            missed += (jcal_kept_decode(bytes, &wanted, &out) != JCAL_KEPT_DAMAGED) ? 1u : 0u;
            flip(bytes, b);
        }
        flip(bytes, a);
    }
    TEST_ASSERT_EQUAL_UINT(0u, missed);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_kept_decode(bytes, &wanted, &out));
}

/* A head that is not whole makes the older image count, never one that is put together of both. */
static void flips_of_a_head_bring_the_older_image_back(void)
{
    ram_flash_t ram;
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 10u));
    TEST_ASSERT_TRUE(write_image(&flash, 11u));
    uint8_t *head = ram.bytes[1];
    unsigned missed = 0u;
    for (unsigned a = 0u; a < HEAD_BITS; a++) {
        flip(head, a);
        missed += (jcal_keep_writes(&flash) != 1u) ? 1u : 0u;
        for (unsigned b = a + 1u; a % STRIDE == 0u && b < HEAD_BITS; ++b) {
            flip(head, b);
            missed += (jcal_keep_writes(&flash) != 1u) ? 1u : 0u;
            flip(head, b);
        }
        TEST_ASSERT_EQUAL_INT(10, image_of(&flash, (uint8_t)(a % FLASH_JOINTS)));
        flip(head, a);
    }
    TEST_ASSERT_EQUAL_UINT(0u, missed);
    TEST_ASSERT_EQUAL_INT(11, image_of(&flash, 0u));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(flips_of_a_record_are_noticed);
    RUN_TEST(flips_of_a_head_bring_the_older_image_back);
    return UNITY_END();
}

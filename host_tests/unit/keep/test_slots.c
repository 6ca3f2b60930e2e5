/* SPDX-License-Identifier: MIT */
/// @file
/// Tests of jointcal/keep_flash.h: images that take turns, power that goes at every byte and stage, flash that fails, how often.
#include "keep/bytes.h"
#include "unit/keep/fixture.h"

static ram_flash_t ram;

void setUp(void)
{
}

void tearDown(void)
{
    TEST_ASSERT_FALSE(ram.is_misused);
}

static void assert_all_of(const jcal_flash_t *flash, int n)
{
    for (uint8_t joint = 0u; joint < FLASH_JOINTS; ++joint) {
        TEST_ASSERT_EQUAL_INT(n, image_of(flash, joint));
    }
}

static void images_take_turns(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    assert_all_of(&flash, -1);
    TEST_ASSERT_EQUAL_UINT32(0u, jcal_keep_writes(&flash));
    for (unsigned n = 0u; n < 7u; ++n) {
        TEST_ASSERT_TRUE(write_image(&flash, n));
        assert_all_of(&flash, (int)n);
        TEST_ASSERT_EQUAL_UINT32(n + 1u, jcal_keep_writes(&flash));
    }
    TEST_ASSERT_EQUAL_UINT(4u, ram.erases[0]);
    TEST_ASSERT_EQUAL_UINT(3u, ram.erases[1]);
}

/* python: struct.pack("<4sBBHI16x", b"JCKS", 1, 128, 3, 2) and its zlib.crc32. */
static void the_head_is_that_of_the_description(void)
{
    static const uint8_t HEAD[JCAL_KEEP_HEAD_BYTES] = {0x4A, 0x43, 0x4B, 0x53, 0x01, 0x80, 0x03, 0x00, 0x02, 0x00, 0x00,
                                                       0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                                                       0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x85, 0x85, 0x88, 0x3E};
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u) && write_image(&flash, 1u));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(HEAD, ram.bytes[1], sizeof HEAD);
}

/* The power goes after `left` bytes and stages of the next write; then it comes back, and a further write goes through. */
static bool cut_short(const jcal_flash_t *flash, unsigned before, uint32_t left)
{
    for (unsigned n = 0u; n < before; ++n) {
        TEST_ASSERT_TRUE(write_image(flash, n));
    }
    ram.left = left;
    const bool whole = write_image(flash, before);
    ram.left = POWER_FOR_EVER;
    const int first = image_of(flash, 0u);
    TEST_ASSERT_TRUE(first == (int)before || first == (int)before - 1);
    TEST_ASSERT_TRUE(!whole || first == (int)before);
    assert_all_of(flash, first);
    ram.is_misused = false; /* the byte that was cut short is not programmed again; the next write must erase it */
    TEST_ASSERT_TRUE(write_image(flash, 50u));
    assert_all_of(flash, 50);
    return whole;
}

static void power_may_go_at_every_byte_and_stage(void)
{
    const uint32_t all = ERASE_STAGES + 1u + FLASH_BYTES;
    for (unsigned before = 0u; before < 3u; ++before) {
        for (uint32_t left = 0u; left <= all; ++left) {
            const jcal_flash_t flash = ram_flash(&ram);
            ram.noise = 1u + 7919u * (left + 1000u * before);
            TEST_ASSERT_EQUAL(left == all, cut_short(&flash, before, left));
        }
    }
}

/* Two writes in a row that are cut short leave what was before both. */
static void power_may_go_twice(void)
{
    for (uint32_t left = 0u; left < ERASE_STAGES + FLASH_BYTES; left += 5u) {
        const jcal_flash_t flash = ram_flash(&ram);
        TEST_ASSERT_TRUE(write_image(&flash, 0u) && write_image(&flash, 1u));
        ram.left = left;
        TEST_ASSERT_FALSE(write_image(&flash, 2u));
        ram.left = ERASE_STAGES + FLASH_BYTES - left;
        TEST_ASSERT_FALSE(write_image(&flash, 3u));
        ram.left = POWER_FOR_EVER;
        assert_all_of(&flash, 1);
    }
}

static void damage_of_one_joint_is_healed_from_the_older_image(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u) && write_image(&flash, 1u));
    ram.bytes[1][JCAL_KEEP_IMAGE_BYTES(1u) + 40u] ^= 4u;
    TEST_ASSERT_EQUAL_INT(1, image_of(&flash, 0u));
    TEST_ASSERT_EQUAL_INT(0, image_of(&flash, 1u));
    TEST_ASSERT_EQUAL_INT(1, image_of(&flash, 2u));
    ram.bytes[0][JCAL_KEEP_IMAGE_BYTES(1u) + 90u] ^= 1u;
    TEST_ASSERT_EQUAL_INT(-1, image_of(&flash, 1u));
    ram.bytes[0][9] ^= 1u;
    ram.bytes[1][9] ^= 1u;
    assert_all_of(&flash, -1);
}

/* Only damage is healed: what the newest image says of other sensors or of nothing holds. */
static void a_joint_of_other_sensors_is_not_taken_from_the_older_image(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u));
    jcal_keep_writer_t writer;
    jcal_kept_t other = hinge_of(0u);
    other.serial2 = 77u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, FLASH_JOINTS));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_put(&writer, &other));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_drop(&writer, 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_commit(&writer));
    const jcal_kept_t former = hinge_of(0u);
    const jcal_kept_t ball = ball_of(1u);
    const jcal_kept_wanted_t wanted = wanted_of(&former);
    const jcal_kept_wanted_t dropped = wanted_of(&ball);
    jcal_kept_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_OTHER_SENSORS, jcal_keep_load(&flash, &wanted, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_NONE, jcal_keep_load(&flash, &dropped, &out));
    TEST_ASSERT_EQUAL_INT(0, image_of(&flash, 2u));
}

/* Joints that were not put are carried over as they are, with the number of the write that they came from. */
static void joints_are_carried_over(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u) && write_image(&flash, 1u));
    jcal_keep_writer_t writer;
    const jcal_kept_t now = joint_of_image(1u, 9u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, FLASH_JOINTS));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_put(&writer, &now));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_put(&writer, &now));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_drop(&writer, 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_commit(&writer));
    TEST_ASSERT_EQUAL_INT(1, image_of(&flash, 0u));
    TEST_ASSERT_EQUAL_INT(9, image_of(&flash, 1u));
    TEST_ASSERT_EQUAL_INT(1, image_of(&flash, 2u));
    const jcal_kept_wanted_t wanted = wanted_of(&now);
    const jcal_kept_t first = joint_of_image(0u, 1u);
    const jcal_kept_wanted_t carried = wanted_of(&first);
    jcal_kept_t out;
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_keep_load(&flash, &wanted, &out));
    TEST_ASSERT_EQUAL_UINT32(3u, out.sequence);
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_FITS, jcal_keep_load(&flash, &carried, &out));
    TEST_ASSERT_EQUAL_UINT32(2u, out.sequence);
}

/* A smaller table forgets the joints that it has no place for. */
static void the_table_may_change(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u));
    jcal_keep_writer_t writer;
    for (unsigned joints = 1u; joints <= FLASH_JOINTS; joints += 2u) {
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, joints));
        TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_commit(&writer));
        TEST_ASSERT_EQUAL_INT(0, image_of(&flash, 0u));
        TEST_ASSERT_EQUAL_INT(-1, image_of(&flash, 2u));
    }
}

static void worn_flash_is_noticed_and_nothing_is_lost(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u));
    ram.worn_from = 2u;
    jcal_keep_writer_t writer;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FLASH, jcal_keep_begin(&writer, &flash, FLASH_JOINTS));
    const jcal_kept_t kept = hinge_of(0u);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_put(&writer, &kept));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_commit(&writer));
    assert_all_of(&flash, 0);
    ram.refuses_to_read = true;
    TEST_ASSERT_EQUAL_UINT32(0u, jcal_keep_writes(&flash));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FLASH, jcal_keep_begin(&writer, &flash, FLASH_JOINTS));
}

static bool forgets_to_program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    (void)slot;
    (void)offset;
    (void)bytes;
    (void)n;
    return true;
}

static void what_reads_otherwise_is_noticed(void)
{
    jcal_flash_t flash = ram_flash(&ram);
    flash.program = forgets_to_program;
    jcal_keep_writer_t writer;
    const jcal_kept_t kept = hinge_of(0u);
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, FLASH_JOINTS));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FLASH, jcal_keep_put(&writer, &kept));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_commit(&writer));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, FLASH_JOINTS));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_FLASH, jcal_keep_commit(&writer));
}

static void wrong_arguments_are_refused(void)
{
    jcal_flash_t flash = ram_flash(&ram);
    jcal_keep_writer_t writer;
    jcal_kept_t out;
    const jcal_kept_t kept = hinge_of(0u);
    const jcal_kept_wanted_t wanted = wanted_of(&kept);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_begin(NULL, &flash, 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_begin(&writer, NULL, 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_begin(&writer, &flash, 0u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_begin(&writer, &flash, JCAL_KEEP_JOINTS_MAX + 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_keep_begin(&writer, &flash, FLASH_JOINTS + 1u));
    flash.unit_bytes = 3u;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_keep_begin(&writer, &flash, 1u));
    flash.unit_bytes = 64u;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_keep_begin(&writer, &flash, 1u));
    flash.unit_bytes = 0u;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_CONFIG, jcal_keep_begin(&writer, &flash, 1u));
    flash.unit_bytes = 32u;
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_begin(&writer, &flash, 1u));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_put(&writer, NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_put(NULL, &kept));
    const jcal_kept_t beyond = hinge_of(1u);
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_put(&writer, &beyond));
    jcal_kept_t wrong = kept;
    wrong.axis1.x = 0.0f;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_put(&writer, &wrong));
    TEST_ASSERT_EQUAL_INT(JCAL_OK, jcal_keep_put(&writer, &kept)); /* the write went on */
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_commit(NULL));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, jcal_keep_load(NULL, &wanted, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, jcal_keep_load(&flash, NULL, &out));
    TEST_ASSERT_EQUAL_INT(JCAL_KEPT_DAMAGED, jcal_keep_load(&flash, &wanted, NULL));
    flash.erase = NULL;
    TEST_ASSERT_EQUAL_INT(JCAL_ERR_ARG, jcal_keep_begin(&writer, &flash, 1u));
    TEST_ASSERT_EQUAL_UINT32(0u, jcal_keep_writes(&flash));
}

static void numbers_of_writes_may_wrap(void)
{
    const jcal_flash_t flash = ram_flash(&ram);
    TEST_ASSERT_TRUE(write_image(&flash, 0u) && write_image(&flash, 1u));
    uint8_t *head = ram.bytes[1];
    jcal_put_u32(head + 8, 0xFFFFFFFFu);
    jcal_put_u32(head + 28, jcal_crc32(head, 28u));
    head = ram.bytes[0];
    jcal_put_u32(head + 8, 0xFFFFFFFEu);
    jcal_put_u32(head + 28, jcal_crc32(head, 28u));
    assert_all_of(&flash, 1);
    TEST_ASSERT_TRUE(write_image(&flash, 2u));
    assert_all_of(&flash, 2);
    TEST_ASSERT_TRUE(write_image(&flash, 3u));
    assert_all_of(&flash, 3);
    TEST_ASSERT_EQUAL_UINT32(1u, jcal_keep_writes(&flash));
}

/* A day of 16 hours in which there is always something worth a write has 13, at 1, 3, 7 ... minutes. */
static void a_day_has_at_most_thirteen_writes(void)
{
    static const unsigned MINUTES[] = {1u, 3u, 7u, 15u, 31u, 63u, 127u, 255u, 383u, 511u, 639u, 767u, 895u};
    jcal_keep_schedule_t schedule;
    jcal_keep_schedule_init(&schedule);
    const uint64_t begin_us = UINT64_C(5000000000);
    unsigned writes = 0u;
    for (unsigned s = 0u; s < 16u * 3600u; ++s) {
        const uint64_t t_us = begin_us + UINT64_C(1000000) * s;
        if (jcal_keep_due(&schedule, t_us, true)) {
            TEST_ASSERT_TRUE(writes < sizeof MINUTES / sizeof MINUTES[0]);
            TEST_ASSERT_EQUAL_UINT(60u * MINUTES[writes], s);
            jcal_keep_written(&schedule, t_us);
            ++writes;
        }
    }
    TEST_ASSERT_EQUAL_UINT(13u, writes);
}

static void the_first_write_waits_from_when_it_is_worth_it(void)
{
    jcal_keep_schedule_t schedule;
    jcal_keep_schedule_init(&schedule);
    TEST_ASSERT_FALSE(jcal_keep_due(&schedule, 500000000u, false));
    TEST_ASSERT_FALSE(jcal_keep_due(&schedule, 600000000u, true));
    TEST_ASSERT_FALSE(jcal_keep_due(&schedule, 659999999u, true));
    TEST_ASSERT_FALSE(jcal_keep_due(&schedule, 660000000u, false));
    TEST_ASSERT_TRUE(jcal_keep_due(&schedule, 660000000u, true));
    /* a clock that goes back waits anew */
    TEST_ASSERT_FALSE(jcal_keep_due(&schedule, 1000u, true));
    TEST_ASSERT_FALSE(jcal_keep_due(&schedule, 60000999u, true));
    TEST_ASSERT_TRUE(jcal_keep_due(&schedule, 60001000u, true));
    TEST_ASSERT_FALSE(jcal_keep_due(NULL, 0u, true));
    jcal_keep_schedule_init(NULL);
    jcal_keep_written(NULL, 0u);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(images_take_turns);
    RUN_TEST(the_head_is_that_of_the_description);
    RUN_TEST(power_may_go_at_every_byte_and_stage);
    RUN_TEST(power_may_go_twice);
    RUN_TEST(damage_of_one_joint_is_healed_from_the_older_image);
    RUN_TEST(a_joint_of_other_sensors_is_not_taken_from_the_older_image);
    RUN_TEST(joints_are_carried_over);
    RUN_TEST(the_table_may_change);
    RUN_TEST(worn_flash_is_noticed_and_nothing_is_lost);
    RUN_TEST(what_reads_otherwise_is_noticed);
    RUN_TEST(wrong_arguments_are_refused);
    RUN_TEST(numbers_of_writes_may_wrap);
    RUN_TEST(a_day_has_at_most_thirteen_writes);
    RUN_TEST(the_first_write_waits_from_when_it_is_worth_it);
    return UNITY_END();
}

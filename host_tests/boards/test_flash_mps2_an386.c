/* SPDX-License-Identifier: MIT */
/// @file
/// The stand-in for flash of the MPS2: memory without a controller. A byte is written at once.
#include "simulated.h"

void setUp(void)
{
    new_chip();
}

void tearDown(void)
{
}

static void power_up(void)
{
}

static void is_at_rest(void)
{
}

uint32_t access_read(uintptr_t address)
{
    (void)address;
    misused("no register");
    return 0u;
}

void access_write(uintptr_t address, uint32_t word)
{
    (void)address;
    (void)word;
    misused("no register");
}

uint8_t access_read_byte(uintptr_t address)
{
    TEST_ASSERT_TRUE(is_flash(address));
    return chip.bytes[address - FLASH_SLOTS];
}

void access_write_byte(uintptr_t address, uint8_t byte)
{
    TEST_ASSERT_TRUE(is_flash(address));
    one_access();
    chip.bytes[address - FLASH_SLOTS] = byte;
}

void access_barrier(void)
{
}

static void bits_are_cleared_only(void)
{
    const jcal_flash_t flash = board_flash();
    const uint8_t first[4] = {0xF0, 0xF0, 0xF0, 0xF0};
    const uint8_t second[4] = {0x3C, 0x3C, 0x3C, 0x3C};
    TEST_ASSERT_TRUE(flash.program(flash.context, 0u, 0u, first, 4u));
    TEST_ASSERT_TRUE(flash.program(flash.context, 0u, 0u, second, 4u));
    TEST_ASSERT_EACH_EQUAL_HEX8(0x30, chip.bytes, 4);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(images_take_turns_and_come_back);
    RUN_TEST(an_erase_clears_one_slot_whole_and_nothing_else);
    RUN_TEST(programmed_bytes_are_where_they_belong);
    RUN_TEST(what_is_in_no_slot_is_refused_untouched);
    RUN_TEST(power_may_go_at_each_access);
    RUN_TEST(bits_are_cleared_only);
    return UNITY_END();
}

/* SPDX-License-Identifier: MIT */
/// @file
/// The flash driver of the nRF52840 on a model of its controller [Product Specification, NVMC]: written and erased only where CONFIG allows it, by
/// whole words, each at most twice between erases; nothing is begun or configured while READY is 0.
#include "simulated.h"

#define REG_CONFIG 0x4001E504u
#define REG_ERASEPAGE 0x4001E508u
#define MODE_READ 0u
#define MODE_WRITE 1u
#define WRITES_MAX 2u /* nWRITE */

static uint32_t config;

void setUp(void)
{
    new_chip();
    power_up();
}

void tearDown(void)
{
}

static void power_up(void)
{
    config = MODE_READ;
}

static void is_at_rest(void)
{
    TEST_ASSERT_EQUAL_UINT32(MODE_READ, config);
    TEST_ASSERT_EQUAL_INT(NOTHING, chip.doing);
}

uint32_t access_read(uintptr_t address)
{
    one_access();
    if (address == 0x4001E400u) {
        return is_busy() ? 0u : 1u;
    }
    misused("a register that is not read");
    return 0u;
}

static void write_register(uintptr_t address, uint32_t word)
{
    if (chip.doing != NOTHING || chip.is_stuck) {
        misused("a register written while the controller is busy");
        return;
    }
    if (address == REG_CONFIG && word <= 2u) {
        config = word;
    } else if (address == REG_ERASEPAGE && config == 2u && is_flash(word) && ((word % 4096u) == 0u)) {
        begin_doing(AN_ERASE, (uint32_t)(word - FLASH_SLOTS), 0u);
    } else {
        misused("a register or a value that is none");
    }
}

void access_write(uintptr_t address, uint32_t word)
{
    one_access();
    if (!is_flash(address)) {
        write_register(address, word);
        return;
    }
    const uint32_t at = (uint32_t)(address - FLASH_SLOTS);
    if (config != 1u || (at % 4u) != 0u || chip.writes[at / 4u] >= WRITES_MAX || chip.is_stuck) {
        misused("flash written that must not be");
        return;
    }
    begin_doing(A_WORD, at, word);
}

uint8_t access_read_byte(uintptr_t address)
{
    return read_flash(address);
}

void access_write_byte(uintptr_t address, uint8_t byte)
{
    (void)address;
    (void)byte;
    misused("less than a word: a fault");
}

void access_barrier(void)
{
}

/* The model itself: what is not allowed changes nothing. */
static void flash_that_is_not_unlocked_stays(void)
{
    access_write(FLASH_SLOTS, 0u);
    TEST_ASSERT_NOT_NULL(chip.misuse);
    access_write(REG_CONFIG, MODE_WRITE);
    access_write(REG_ERASEPAGE, (uint32_t)FLASH_SLOTS);
    complete();
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, chip.bytes, SIMULATED_BYTES);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(images_take_turns_and_come_back);
    RUN_TEST(an_erase_clears_one_slot_whole_and_nothing_else);
    RUN_TEST(programmed_bytes_are_where_they_belong);
    RUN_TEST(what_is_in_no_slot_is_refused_untouched);
    RUN_TEST(power_may_go_at_each_access);
    RUN_TEST(a_stuck_controller_is_given_up);
    RUN_TEST(flash_that_is_not_unlocked_stays);
    return UNITY_END();
}

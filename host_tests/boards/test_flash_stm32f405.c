/* SPDX-License-Identifier: MIT */
/// @file
/// The flash driver of the STM32F405 on a model of its controller [RM0090, embedded flash memory interface]: CR is locked until both keys came in order,
/// a sector is erased by SER, SNB and STRT, words are programmed with PG and PSIZE 2; what is done otherwise sets an error and writes nothing.
#include "simulated.h"

/* Bits of the manual, beside what the driver makes of them. */
#define REG_KEYR 0x40023C04u
#define REG_SR 0x40023C0Cu
#define REG_CR 0x40023C10u
#define BIT_WRPERR (1u << 4)
#define BIT_PGPERR (1u << 6)
#define BIT_PGSERR (1u << 7)
#define BIT_BSY (1u << 16)
#define ALL_ERRORS ((1u << 1) | BIT_WRPERR | (1u << 5) | BIT_PGPERR | BIT_PGSERR)
#define BIT_PG 1u
#define BIT_SER 2u
#define BIT_MER 4u
#define BIT_STRT (1u << 16)
#define BIT_LOCK (UINT32_C(1) << 31)

static uint32_t sr, cr;
static unsigned keys; /* of the two that came in order */
static bool is_shut;  /* a wrong key came: until the next reset */
static bool is_protected;

void setUp(void)
{
    new_chip();
    is_protected = false;
    power_up();
}

void tearDown(void)
{
}

static void power_up(void)
{
    sr = 0u;
    cr = BIT_LOCK;
    keys = 0u;
    is_shut = false;
}

static void is_at_rest(void)
{
    TEST_ASSERT_EQUAL_HEX32(BIT_LOCK, cr);
    TEST_ASSERT_EQUAL_INT(NOTHING, chip.doing);
}

uint32_t access_read(uintptr_t address)
{
    one_access();
    if (address == REG_SR) {
        const uint32_t busy = is_busy() ? BIT_BSY : 0u;
        cr &= (busy != 0u) ? UINT32_MAX : ~BIT_STRT;
        return sr | busy;
    }
    if (address != REG_CR) {
        misused("a register that is not read");
    }
    return cr;
}

static void take_key(uint32_t key)
{
    static const uint32_t KEYS[2] = {0x45670123u, 0xCDEF89ABu};
    if (is_shut || (cr & BIT_LOCK) == 0u || key != KEYS[keys]) {
        is_shut = true;
        misused("a wrong key: a bus error");
        return;
    }
    ++keys;
    if (keys == 2u) {
        keys = 0u;
        cr &= ~BIT_LOCK;
    }
}

/* Sectors 1 and 2 are the slots; 0 holds the vectors, and those behind the code. */
static void start(void)
{
    const uint32_t sector = (cr >> 3) & 15u;
    if ((cr & (BIT_SER | BIT_MER | BIT_PG)) != BIT_SER || sector < 1u || sector > 2u) {
        misused("an erase of something else");
    } else if (is_protected) {
        sr |= BIT_WRPERR;
    } else {
        begin_doing(AN_ERASE, (sector - 1u) * FLASH_SLOT_BYTES, 0u);
    }
}

static void write_cr(uint32_t word)
{
    if (chip.doing != NOTHING || chip.is_stuck) {
        misused("CR written while the controller is busy");
    } else if ((cr & BIT_LOCK) != 0u) {
        misused("CR written while it is locked");
    } else {
        cr = word;
        if ((word & BIT_STRT) != 0u) {
            start();
        }
    }
}

static void write_flash(uint32_t at, uint32_t word)
{
    if ((cr & BIT_LOCK) != 0u || (cr & BIT_PG) == 0u) {
        sr |= BIT_PGSERR;
    } else if (((cr >> 8) & 3u) != 2u) {
        sr |= BIT_PGPERR;
    } else if (is_protected) {
        sr |= BIT_WRPERR;
    } else if ((at % 4u) != 0u) {
        misused("a word at no word's place");
    } else {
        begin_doing(A_WORD, at, word);
    }
}

void access_write(uintptr_t address, uint32_t word)
{
    one_access();
    if (is_flash(address)) {
        write_flash((uint32_t)(address - FLASH_SLOTS), word);
    } else if (address == REG_SR) {
        sr &= ~(word & ALL_ERRORS);
    } else if (address == REG_KEYR) {
        take_key(word);
    } else if (address == REG_CR) {
        write_cr(word);
    } else {
        misused("a register that is not written");
    }
}

uint8_t access_read_byte(uintptr_t address)
{
    return read_flash(address);
}

void access_write_byte(uintptr_t address, uint8_t byte)
{
    (void)address;
    (void)byte;
    sr |= BIT_PGPERR;
}

void access_barrier(void)
{
}

/* After a debugger some bits are set; programming goes on with them in some chips, and not in others. */
static void errors_from_before_are_cleared_first(void)
{
    const jcal_flash_t flash = board_flash();
    sr = BIT_PGSERR | BIT_PGPERR;
    TEST_ASSERT_TRUE(write_image(&flash, 0u));
    TEST_ASSERT_EQUAL_INT(0, image_of(&flash, 0u));
    assert_no_misuse();
}

static void a_protected_sector_fails_the_write(void)
{
    const jcal_flash_t flash = board_flash();
    TEST_ASSERT_TRUE(write_image(&flash, 0u));
    is_protected = true;
    TEST_ASSERT_FALSE(flash.erase(flash.context, 1u));
    uint8_t bytes[32] = {0};
    TEST_ASSERT_FALSE(flash.program(flash.context, 1u, 0u, bytes, 32u));
    TEST_ASSERT_FALSE(write_image(&flash, 1u));
    is_at_rest();
    TEST_ASSERT_EQUAL_INT(0, image_of(&flash, 0u));
    is_protected = false;
    TEST_ASSERT_TRUE(write_image(&flash, 1u));
    TEST_ASSERT_EQUAL_INT(1, image_of(&flash, 0u));
    assert_no_misuse();
}

/* A controller that stays locked, for somebody sent a wrong key: nothing is written, and that is said. */
static void a_controller_that_stays_locked_fails_the_write(void)
{
    const jcal_flash_t flash = board_flash();
    is_shut = true;
    TEST_ASSERT_FALSE(flash.erase(flash.context, 0u));
    uint8_t bytes[32] = {0};
    TEST_ASSERT_FALSE(flash.program(flash.context, 0u, 0u, bytes, 32u));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, chip.bytes, SIMULATED_BYTES);
}

/* The model itself: what is not allowed changes nothing. */
static void flash_that_is_not_unlocked_stays(void)
{
    access_write(FLASH_SLOTS, 0u);
    TEST_ASSERT_EQUAL_HEX32(BIT_PGSERR, sr);
    access_write(REG_CR, BIT_SER | (1u << 3) | BIT_STRT);
    TEST_ASSERT_NOT_NULL(chip.misuse);
    access_write(REG_KEYR, 0xCDEF89ABu);
    access_write(REG_KEYR, 0x45670123u);
    TEST_ASSERT_EQUAL_HEX32(BIT_LOCK, cr);
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
    RUN_TEST(errors_from_before_are_cleared_first);
    RUN_TEST(a_protected_sector_fails_the_write);
    RUN_TEST(a_controller_that_stays_locked_fails_the_write);
    RUN_TEST(flash_that_is_not_unlocked_stays);
    return UNITY_END();
}

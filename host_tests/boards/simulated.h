/* SPDX-License-Identifier: MIT */
/// @file
/// Flash of two slots as a chip's controller has it: an erase or a word takes a while, bits are only ever cleared, and the power may go at any
/// access. What a controller does with its registers is the test's part; what a driver must not do is counted as misuse.
#ifndef BOARDS_SIMULATED_H
#define BOARDS_SIMULATED_H

#include "unit/keep/fixture.h"

#include "flash.h"

#include <setjmp.h>
#include <stdio.h>

#define SIMULATED_POLLS 5u /* so often a controller is asked before it is ready */
#define SIMULATED_BYTES (2u * FLASH_SLOT_BYTES)

typedef enum { NOTHING = 0, AN_ERASE, A_WORD } under_way_t;

typedef struct {
    uint8_t bytes[SIMULATED_BYTES];
    uint8_t writes[SIMULATED_BYTES / 4u]; /* of each word since its erase */
    under_way_t doing;
    uint32_t at;      /* where: byte of `bytes` */
    uint32_t word;    /* what */
    uint32_t polls;   /* until it is done */
    bool is_stuck;    /* never is */
    bool sticks;      /* the next thing that is begun never is */
    uint32_t left;    /* accesses until the power goes */
    jmp_buf power;    /* where it comes back */
    uint32_t noise;   /* which bits have changed in what was cut short */
    uint32_t touched; /* accesses so far */
    const char *misuse;
} simulated_t;

static simulated_t chip;

static inline void misused(const char *how)
{
    chip.misuse = (chip.misuse == NULL) ? how : chip.misuse;
}

/* What is under way is done. */
static inline void complete(void)
{
    if (chip.doing == AN_ERASE) {
        memset(&chip.bytes[chip.at], 0xFF, FLASH_SLOT_BYTES);
        memset(&chip.writes[chip.at / 4u], 0, FLASH_SLOT_BYTES / 4u);
    } else if (chip.doing == A_WORD) {
        for (unsigned k = 0u; k < 4u; ++k) {
            chip.bytes[chip.at + k] &= (uint8_t)(chip.word >> (8u * k));
        }
        ++chip.writes[chip.at / 4u];
    }
    chip.doing = NOTHING;
}

static inline void begin_doing(under_way_t what, uint32_t at, uint32_t word)
{
    if (chip.doing != NOTHING) {
        misused("begun before the last was done");
        complete();
    }
    chip.doing = what;
    chip.at = at;
    chip.word = word;
    chip.polls = SIMULATED_POLLS;
    chip.is_stuck = chip.sticks;
}

/* Asked once more whether it is ready. */
static inline bool is_busy(void)
{
    if ((chip.doing == NOTHING) || chip.is_stuck) {
        return chip.is_stuck;
    }
    if (chip.polls > 0u) {
        --chip.polls;
        return true;
    }
    complete();
    return false;
}

/* Some of the bits that were to change have changed. */
static inline void cut_short(void)
{
    for (uint32_t i = 0u; (chip.doing == AN_ERASE) && (i < FLASH_SLOT_BYTES); ++i) {
        chip.bytes[chip.at + i] |= (uint8_t)(chance(&chip.noise) >> 9);
    }
    for (unsigned k = 0u; (chip.doing == A_WORD) && (k < 4u); ++k) {
        chip.bytes[chip.at + k] &= (uint8_t)((chip.word >> (8u * k)) | (chance(&chip.noise) >> 9));
    }
    chip.doing = NOTHING;
    longjmp(chip.power, 1);
}

/* Each access of a register, each write to flash. */
static inline void one_access(void)
{
    ++chip.touched;
    if (chip.left != POWER_FOR_EVER) {
        if (chip.left == 0u) {
            cut_short();
        }
        --chip.left;
    }
}

static inline bool is_flash(uintptr_t address)
{
    return (address >= FLASH_SLOTS) && (address < (FLASH_SLOTS + SIMULATED_BYTES));
}

/* A byte of flash, which must not be read while the controller works at it. */
static inline uint8_t read_flash(uintptr_t address)
{
    TEST_ASSERT_TRUE(is_flash(address));
    if (chip.doing != NOTHING) {
        misused("flash read while the controller is busy");
    }
    return chip.bytes[address - FLASH_SLOTS];
}

/* A part that comes from the factory, and whatever the test's controller has besides. */
static inline void new_chip(void)
{
    memset(&chip, 0, sizeof chip);
    memset(chip.bytes, 0xFF, sizeof chip.bytes);
    chip.left = POWER_FOR_EVER;
    chip.noise = 2463534242u;
}

/* ---- what each driver must do */

static void power_up(void);   /* of the test: registers as a reset leaves them */
static void is_at_rest(void); /* of the test: nothing can be written */

static inline void assert_no_misuse(void)
{
    TEST_ASSERT_NULL_MESSAGE(chip.misuse, chip.misuse);
}

static inline void images_take_turns_and_come_back(void)
{
    const jcal_flash_t flash = board_flash();
    for (unsigned n = 0u; n < 5u; ++n) {
        TEST_ASSERT_TRUE(write_image(&flash, n));
        is_at_rest();
        for (uint8_t joint = 0u; joint < FLASH_JOINTS; ++joint) {
            TEST_ASSERT_EQUAL_INT((int)n, image_of(&flash, joint));
        }
        power_up();
    }
    TEST_ASSERT_EQUAL_UINT32(5u, jcal_keep_writes(&flash));
    assert_no_misuse();
}

static inline void an_erase_clears_one_slot_whole_and_nothing_else(void)
{
    const jcal_flash_t flash = board_flash();
    for (unsigned slot = 0u; slot < 2u; ++slot) {
        memset(chip.bytes, 0x5A, sizeof chip.bytes);
        TEST_ASSERT_TRUE(flash.erase(flash.context, slot));
        is_at_rest();
        for (uint32_t i = 0u; i < SIMULATED_BYTES; ++i) {
            TEST_ASSERT_EQUAL_HEX8((i / FLASH_SLOT_BYTES == slot) ? 0xFF : 0x5A, chip.bytes[i]);
        }
    }
    assert_no_misuse();
}

static inline void programmed_bytes_are_where_they_belong(void)
{
    const jcal_flash_t flash = board_flash();
    uint8_t bytes[64];
    for (unsigned i = 0u; i < sizeof bytes; ++i) {
        bytes[i] = (uint8_t)(3u * i + 1u);
    }
    const uint32_t offset = FLASH_SLOT_BYTES - (uint32_t)sizeof bytes;
    TEST_ASSERT_TRUE(flash.program(flash.context, 1u, offset, bytes, sizeof bytes));
    is_at_rest();
    TEST_ASSERT_EQUAL_MEMORY(bytes, &chip.bytes[SIMULATED_BYTES - sizeof bytes], sizeof bytes);
    for (uint32_t i = 0u; i < SIMULATED_BYTES - sizeof bytes; ++i) {
        TEST_ASSERT_EQUAL_HEX8(0xFF, chip.bytes[i]);
    }
    uint8_t read[64] = {0};
    TEST_ASSERT_TRUE(flash.read(flash.context, 1u, offset, read, sizeof read));
    TEST_ASSERT_EQUAL_MEMORY(bytes, read, sizeof read);
    assert_no_misuse();
}

static inline void what_is_in_no_slot_is_refused_untouched(void)
{
    const jcal_flash_t flash = board_flash();
    uint8_t bytes[32] = {0};
    const uint32_t before = chip.touched;
    TEST_ASSERT_FALSE(flash.erase(flash.context, 2u));
    TEST_ASSERT_FALSE(flash.program(flash.context, 2u, 0u, bytes, 32u));
    TEST_ASSERT_FALSE(flash.program(flash.context, 0u, FLASH_SLOT_BYTES - 16u, bytes, 32u));
    TEST_ASSERT_FALSE(flash.program(flash.context, 0u, UINT32_MAX - 15u, bytes, 32u));
    TEST_ASSERT_FALSE(flash.program(flash.context, 0u, 2u, bytes, 32u));
    TEST_ASSERT_FALSE(flash.program(flash.context, 0u, 0u, bytes, 30u));
    TEST_ASSERT_FALSE(flash.read(flash.context, 2u, 0u, bytes, 32u));
    TEST_ASSERT_FALSE(flash.read(flash.context, 1u, FLASH_SLOT_BYTES, bytes, 4u));
    TEST_ASSERT_EQUAL_UINT32(before, chip.touched);
}

/* The power goes at the access after `left` of a write; then it comes back. */
static inline bool write_with_cut(const jcal_flash_t *flash, unsigned n, uint32_t left)
{
    chip.left = left;
    volatile bool whole = false;
    if (setjmp(chip.power) == 0) {
        whole = write_image(flash, n);
    }
    chip.left = POWER_FOR_EVER;
    power_up();
    return whole;
}

static inline void power_may_go_at_each_access(void)
{
    const jcal_flash_t flash = board_flash();
    unsigned cuts[2] = {0u, 0u}; /* after which the image before was in use, and the new one */
    bool whole = false;
    for (uint32_t left = 0u; !whole; ++left) {
        new_chip();
        power_up();
        TEST_ASSERT_TRUE(write_image(&flash, 0u) && write_image(&flash, 1u));
        whole = write_with_cut(&flash, 2u, left);
        const int first = image_of(&flash, 0u);
        TEST_ASSERT_TRUE(first == 1 || first == 2);
        for (uint8_t joint = 1u; joint < FLASH_JOINTS; ++joint) {
            TEST_ASSERT_EQUAL_INT(first, image_of(&flash, joint));
        }
        ++cuts[first - 1];
        TEST_ASSERT_TRUE(write_image(&flash, 3u));
        TEST_ASSERT_EQUAL_INT(3, image_of(&flash, 0u));
        is_at_rest();
        assert_no_misuse();
    }
    TEST_ASSERT_GREATER_THAN_UINT(JCAL_KEEP_IMAGE_BYTES(FLASH_JOINTS) / 4u, cuts[0]);
    TEST_ASSERT_GREATER_THAN_UINT(0u, cuts[1]);
}

static inline void assert_gives_up(const jcal_flash_t *flash)
{
    static const uint8_t BYTES[32] = {0};
    TEST_ASSERT_FALSE(write_image(flash, 1u));
    TEST_ASSERT_FALSE(flash->erase(flash->context, 1u));
    TEST_ASSERT_FALSE(flash->program(flash->context, 1u, 0u, BYTES, sizeof BYTES));
    TEST_ASSERT_EQUAL_HEX8(0xFF, chip.bytes[FLASH_SLOT_BYTES]);
    assert_no_misuse();
}

/* A controller that does not answer, from the beginning or from an erase on: false in time, nothing written, nothing asked of it meanwhile. */
static inline void a_stuck_controller_is_given_up(void)
{
    const jcal_flash_t flash = board_flash();
    TEST_ASSERT_TRUE(write_image(&flash, 0u));
    chip.is_stuck = true;
    assert_gives_up(&flash);
    chip.is_stuck = false;
    TEST_ASSERT_EQUAL_INT(0, image_of(&flash, 0u));
    chip.sticks = true;
    assert_gives_up(&flash);
    TEST_ASSERT_EQUAL_INT(AN_ERASE, chip.doing);
}

#endif

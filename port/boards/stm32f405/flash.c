/* SPDX-License-Identifier: MIT */
/* STM32F405 [RM0090, embedded flash memory interface]: sectors of 16, 64 and 128 KiB; the slots are sectors 1 and 2, of 16 KiB. Programmed by
 * words, at 2.7 to 3.6 V; 10,000 erases. There is one bank: whoever runs from flash stands still while a sector is erased (0.25 to
 * 0.5 s) or a word is written (16 us), interrupts too, and the sender must be held back before.
 *
 * Caches: instruction and data cache are off after reset. Who switches the data cache on must flush it after an erase.
 * Run on a model of the controller only (host_tests/boards): QEMU's netduinoplus2 has none, and there was no board. */
#include "flash.h"

#define FLASH 0x40023C00u
#define FLASH_KEYR (FLASH + 0x04u)
#define FLASH_SR (FLASH + 0x0Cu)
#define FLASH_CR (FLASH + 0x10u)
#define KEY1 0x45670123u
#define KEY2 0xCDEF89ABu
#define SR_ERRORS 0xF2u /* operation, write protection, alignment, parallelism, sequence: write 1 to clear */
#define SR_BSY (1u << 16)
#define CR_PG (1u << 0)
#define CR_SER (1u << 1)
#define CR_SECTOR_SHIFT 3u
#define CR_BY_WORDS (2u << 8)
#define CR_STRT (1u << 16)
#define CR_LOCK (UINT32_C(1) << 31)

#define FIRST_SECTOR 1u

/* Longer than a sector's erase, should the controller not answer: passes of a loop of at least four cycles at 16 MHz, 5 s. */
#ifndef PATIENCE
#define PATIENCE 20000000u
#endif

static bool is_idle(void)
{
    for (uint32_t left = PATIENCE; left > 0u; left--) {
        if ((access_read(FLASH_SR) & SR_BSY) == 0u) {
            return true;
        }
    }
    return false;
}

/* What was under way is done, and nothing went wrong. */
static bool wait(void)
{
    return is_idle() && ((access_read(FLASH_SR) & SR_ERRORS) == 0u);
}

/* A write to CR while the controller is busy would hold the processor until it is not. */
static bool unlock(void)
{
    if (!is_idle()) {
        return false;
    }
    access_write(FLASH_SR, SR_ERRORS);
    if ((access_read(FLASH_CR) & CR_LOCK) != 0u) {
        access_write(FLASH_KEYR, KEY1);
        access_write(FLASH_KEYR, KEY2);
    }
    return (access_read(FLASH_CR) & CR_LOCK) == 0u;
}

static bool lock(void)
{
    if (!is_idle()) {
        return false;
    }
    access_write(FLASH_CR, CR_LOCK);
    access_barrier();
    return true;
}

static bool erase(void *context, unsigned slot)
{
    (void)context;
    if ((slot >= 2u) || !unlock()) {
        return false;
    }
    access_write(FLASH_CR, CR_BY_WORDS | CR_SER | ((FIRST_SECTOR + slot) << CR_SECTOR_SHIFT));
    access_write(FLASH_CR, access_read(FLASH_CR) | CR_STRT);
    access_barrier();
    const bool ok = wait();
    return lock() && ok;
}

static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    if (!flash_has(slot, offset, n) || !unlock()) {
        return false;
    }
    access_write(FLASH_CR, CR_BY_WORDS | CR_PG);
    bool ok = true;
    for (uint32_t i = 0u; ok && (i < n); i += 4u) {
        access_write(flash_address(slot, offset + i), flash_word(bytes + i));
        access_barrier();
        ok = wait();
    }
    return lock() && ok;
}

jcal_flash_t board_flash(void)
{
    const jcal_flash_t flash = {0, FLASH_SLOT_BYTES, 4u, erase, program, flash_read};
    return flash;
}

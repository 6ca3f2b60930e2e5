/* SPDX-License-Identifier: MIT */
/* nRF52840 [Product Specification, NVMC]: pages of 4 KiB, programmed by words; 10,000 erases. The processor stands still while it runs from
 * flash and a page is erased (85 ms) or a word is written (41 us): the UART's six bytes of room are not enough then, and the sender
 * must be held back before. Flash is not to be written while a radio stack of a SoftDevice runs; its own calls do that then.
 *
 * Run on a model of the controller only (host_tests/boards): neither on the board, nor in an emulator. */
#include "flash.h"

#define NVMC 0x4001E000u
#define NVMC_READY (NVMC + 0x400u)  /* bit 0: nothing is under way */
#define NVMC_CONFIG (NVMC + 0x504u) /* 0: read only, 1: write, 2: erase */
#define NVMC_ERASEPAGE (NVMC + 0x508u)

#define CONFIG_READ 0u
#define CONFIG_WRITE 1u
#define CONFIG_ERASE 2u

/* Longer than a page's erase by far, should the controller not answer: passes of a loop of at least four cycles at 64 MHz, 0.3 s. */
#ifndef PATIENCE
#define PATIENCE 5000000u
#endif

static bool wait(void)
{
    for (uint32_t left = PATIENCE; left > 0u; left--) {
        if ((access_read(NVMC_READY) & 1u) != 0u) {
            return true;
        }
    }
    return false;
}

/* Only a controller that is ready is told anything. */
static bool configure(uint32_t mode)
{
    if (!wait()) {
        return false;
    }
    access_write(NVMC_CONFIG, mode);
    access_barrier();
    return true;
}

static bool erase(void *context, unsigned slot)
{
    (void)context;
    if ((slot >= 2u) || !configure(CONFIG_ERASE)) {
        return false;
    }
    access_write(NVMC_ERASEPAGE, (uint32_t)flash_address(slot, 0u));
    return configure(CONFIG_READ);
}

static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    if (!flash_has(slot, offset, n) || !configure(CONFIG_WRITE)) {
        return false;
    }
    bool ok = true;
    for (uint32_t i = 0u; ok && (i < n); i += 4u) {
        access_write(flash_address(slot, offset + i), flash_word(bytes + i));
        ok = wait();
    }
    return configure(CONFIG_READ) && ok;
}

jcal_flash_t board_flash(void)
{
    const jcal_flash_t flash = {0, FLASH_SLOT_BYTES, 4u, erase, program, flash_read};
    return flash;
}

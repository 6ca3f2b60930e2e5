/* SPDX-License-Identifier: MIT */
/* Two slots of flash for kept calibrations. As it is, every write fails and nothing is remembered; ../nrf52840/flash.c is an example. The
 * slots are two pieces that the chip erases one by one: give them a region SLOTS of their own in memory.ld. */
#include "flash.h"

static bool erase(void *context, unsigned slot)
{
    (void)context;
    (void)slot;
    return false; /* TO FILL IN: make all bytes of the slot 0xFF; flash_address(slot, 0) is where it begins. */
}

static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    (void)bytes;
    (void)flash_has(slot, offset, n);
    return false; /* TO FILL IN: write n bytes at flash_address(slot, offset), in units of at most 32. */
}

jcal_flash_t board_flash(void)
{
    const jcal_flash_t flash = {0, FLASH_SLOT_BYTES, 4u, erase, program, flash_read};
    return flash;
}

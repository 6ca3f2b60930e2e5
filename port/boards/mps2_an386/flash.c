/* SPDX-License-Identifier: MIT */
/* Arm MPS2 has no flash of its own: memory that behaves like it, outside of what a reset clears. It lasts as long as the power. */
#include "flash.h"

static bool erase(void *context, unsigned slot)
{
    (void)context;
    if (slot >= 2u) {
        return false;
    }
    for (uint32_t i = 0u; i < FLASH_SLOT_BYTES; i++) {
        access_write_byte(flash_address(slot, i), 0xFFu);
    }
    return true;
}

static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    if (!flash_has(slot, offset, n)) {
        return false;
    }
    for (uint32_t i = 0u; i < n; i++) {
        const uintptr_t to = flash_address(slot, offset + i);
        access_write_byte(to, (uint8_t)(access_read_byte(to) & bytes[i])); /* bits are cleared only, as in flash */
    }
    return true;
}

jcal_flash_t board_flash(void)
{
    const jcal_flash_t flash = {0, FLASH_SLOT_BYTES, 1u, erase, program, flash_read};
    return flash;
}

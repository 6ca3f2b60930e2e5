/* SPDX-License-Identifier: MIT */
/* Arm MPS2 has no flash of its own: memory that behaves like it, outside of what a reset clears. It lasts as long as the power. */
#include "flash.h"

static bool erase(void *context, unsigned slot)
{
    (void)context;
    if (slot >= 2u) {
        return false;
    }
    volatile uint8_t *const bytes = (volatile uint8_t *)flash_address(slot, 0u);
    for (uint32_t i = 0u; i < (uint32_t)(uintptr_t)keep_slot_bytes; i++) {
        bytes[i] = 0xFFu;
    }
    return true;
}

static bool program(void *context, unsigned slot, uint32_t offset, const uint8_t *bytes, uint32_t n)
{
    (void)context;
    if (!flash_has(slot, offset, n)) {
        return false;
    }
    volatile uint8_t *const to = (volatile uint8_t *)flash_address(slot, offset);
    for (uint32_t i = 0u; i < n; i++) {
        to[i] = (uint8_t)(to[i] & bytes[i]); /* bits are cleared only, as in flash */
    }
    return true;
}

jcal_flash_t board_flash(void)
{
    const jcal_flash_t flash = {0, (uint32_t)(uintptr_t)keep_slot_bytes, 1u, erase, program, flash_read};
    return flash;
}

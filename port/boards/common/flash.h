/* SPDX-License-Identifier: MIT */
/// @file
/// Two slots of flash for kept calibrations (jointcal/keep_flash.h). Each board implements it in flash.c; where they lie says its
/// memory.ld, region SLOTS.
#ifndef JCAL_BOARDS_FLASH_H
#define JCAL_BOARDS_FLASH_H

#include "jointcal/keep_flash.h"

/// Both slots, from the linker script: `keep_slot_bytes` is a symbol whose address is the size of one.
extern uint8_t keep_slots[];
extern uint8_t keep_slot_bytes[];

/// The port of this board.
jcal_flash_t board_flash(void);

/// Where a byte of a slot is.
static inline uintptr_t flash_address(unsigned slot, uint32_t offset)
{
    return (uintptr_t)keep_slots + ((uintptr_t)slot * (uintptr_t)keep_slot_bytes) + offset;
}

/// True if n bytes from `offset` on lie in a slot, and are whole words.
static inline bool flash_has(unsigned slot, uint32_t offset, uint32_t n)
{
    const uint32_t size = (uint32_t)(uintptr_t)keep_slot_bytes;
    return (slot < 2u) && (offset <= size) && (n <= (size - offset)) && ((offset % 4u) == 0u) && ((n % 4u) == 0u);
}

/// Four bytes as the word that a little-endian processor reads there.
static inline uint32_t flash_word(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] | ((uint32_t)bytes[1] << 8) | ((uint32_t)bytes[2] << 16) | ((uint32_t)bytes[3] << 24);
}

/// Flash is read like any memory: what `read` of jcal_flash_t asks for.
static inline bool flash_read(void *context, unsigned slot, uint32_t offset, uint8_t *bytes, uint32_t n)
{
    (void)context;
    const volatile uint8_t *const from = (const volatile uint8_t *)flash_address(slot, offset);
    if (!flash_has(slot, offset, n)) {
        return false;
    }
    for (uint32_t i = 0u; i < n; i++) {
        bytes[i] = from[i];
    }
    return true;
}

#endif

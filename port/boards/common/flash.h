/* SPDX-License-Identifier: MIT */
/// @file
/// Two slots of flash for kept calibrations (jointcal/keep_flash.h). Each board implements it in flash.c; where they lie says its
/// memory.ld, region SLOTS.
#ifndef JCAL_BOARDS_FLASH_H
#define JCAL_BOARDS_FLASH_H

#include "access.h"
#include "jointcal/keep_flash.h"

#ifndef BOARDS_SIMULATED
/// Both slots, from the linker script: `keep_slot_bytes` is a symbol whose address is the size of one.
extern uint8_t keep_slots[];
extern uint8_t keep_slot_bytes[];
#define FLASH_SLOTS ((uintptr_t)keep_slots)
#define FLASH_SLOT_BYTES ((uint32_t)(uintptr_t)keep_slot_bytes)
#endif

/// The port of this board.
jcal_flash_t board_flash(void);

/// Where a byte of a slot is.
static inline uintptr_t flash_address(unsigned slot, uint32_t offset)
{
    return FLASH_SLOTS + ((uintptr_t)slot * FLASH_SLOT_BYTES) + offset;
}

/// True if n bytes from `offset` on lie in a slot, and are whole words.
static inline bool flash_has(unsigned slot, uint32_t offset, uint32_t n)
{
    return (slot < 2u) && (offset <= FLASH_SLOT_BYTES) && (n <= (FLASH_SLOT_BYTES - offset)) && ((offset % 4u) == 0u) &&
           ((n % 4u) == 0u);
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
    if (!flash_has(slot, offset, n)) {
        return false;
    }
    for (uint32_t i = 0u; i < n; i++) {
        bytes[i] = access_read_byte(flash_address(slot, offset + i));
    }
    return true;
}

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What a flash driver does to its controller and to flash: single reads and writes. On a PC (BOARDS_SIMULATED) a model of the controller
/// answers them, host_tests/boards.
#ifndef JCAL_BOARDS_ACCESS_H
#define JCAL_BOARDS_ACCESS_H

#include <stdint.h>

#ifdef BOARDS_SIMULATED
uint32_t access_read(uintptr_t address);
void access_write(uintptr_t address, uint32_t word);
uint8_t access_read_byte(uintptr_t address);
void access_write_byte(uintptr_t address, uint8_t byte);
void access_barrier(void);
#else

/// A register, or a word of flash.
static inline uint32_t access_read(uintptr_t address)
{
    return *(volatile uint32_t *)address;
}

static inline void access_write(uintptr_t address, uint32_t word)
{
    *(volatile uint32_t *)address = word;
}

/// A byte of flash.
static inline uint8_t access_read_byte(uintptr_t address)
{
    return *(const volatile uint8_t *)address;
}

static inline void access_write_byte(uintptr_t address, uint8_t byte)
{
    *(volatile uint8_t *)address = byte;
}

/// What was written has arrived before anything that follows.
static inline void access_barrier(void)
{
    __asm volatile("dsb\n isb" ::: "memory");
}
#endif

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// A clock from the processor's SysTick timer [Armv7-M Architecture Reference Manual, DDI0403, B3.3], for boards where it goes on in sleep.
///
/// It counts down over SYSTICK_PERIOD_US and then interrupts, which also ends a sleep. The board has a counter of periods, a handler that adds
/// one, and gives the handler to SYSTEM_VECTOR_TABLE.
#ifndef JCAL_BOARDS_SYSTICK_H
#define JCAL_BOARDS_SYSTICK_H

#include "cortex_m.h"

#define SYSTICK_CTRL REGISTER(0xE000E010u) /* bits 0 to 2: on, interrupt, the processor's clock */
#define SYSTICK_LOAD REGISTER(0xE000E014u) /* 24 bits */
#define SYSTICK_VALUE REGISTER(0xE000E018u)
#define ICSR REGISTER(0xE000ED04u)
#define ICSR_SYSTICK_PENDS (UINT32_C(1) << 26)

#define SYSTICK_PERIOD_US 10000u

static inline void systick_start(uint32_t clock_hz)
{
    SYSTICK_LOAD = clock_hz / (1000000u / SYSTICK_PERIOD_US) - 1u;
    SYSTICK_VALUE = 0;
    SYSTICK_CTRL = 7u;
}

/// Time since the start, us. The handler must not run meanwhile: interrupts are masked, or one of the same priority runs.
static inline uint64_t systick_now_us(uint32_t clock_hz, uint64_t periods)
{
    const uint32_t load = clock_hz / (1000000u / SYSTICK_PERIOD_US) - 1u;
    uint32_t value = SYSTICK_VALUE;
    if ((ICSR & ICSR_SYSTICK_PENDS) != 0) {
        value = SYSTICK_VALUE; /* of the new period, which the handler has not counted */
        periods++;
    }
    return periods * SYSTICK_PERIOD_US + (load - value) / (clock_hz / 1000000u);
}

#endif

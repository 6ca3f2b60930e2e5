/* SPDX-License-Identifier: MIT */
/// @file
/// The few things of a Cortex-M processor that every board here uses [Armv7-M Architecture Reference Manual, DDI0403].
#ifndef JCAL_BOARDS_CORTEX_M_H
#define JCAL_BOARDS_CORTEX_M_H

#include <stdint.h>

/// A register of a peripheral or of the processor.
#define REGISTER(address) (*(volatile uint32_t *)(uintptr_t)(address))

/// Coprocessor access control: full access to the FPU is bits 20 to 23.
#define CPACR REGISTER(0xE000ED88u)
/// Vector table offset.
#define VTOR REGISTER(0xE000ED08u)
/// Enables interrupts 32 n to 32 n + 31.
#define NVIC_ENABLE(n) REGISTER(0xE000E100u + 4u * (n))

static inline void enable_interrupt(unsigned number)
{
    NVIC_ENABLE(number / 32u) = UINT32_C(1) << (number % 32u);
}

/// An entry of the vector table.
typedef void (*vector_t)(void);

/// Interrupts that every table begins with: stack, reset, and 14 exceptions of the processor.
#define SYSTEM_VECTORS 16u

/// First of all: sets up memory and calls main. In common/start.c.
void start_reset(void);
/// Faults and interrupts that nobody expects: stops with the error light on and a line on the UART.
void start_fault(void);
/// End of the stack, from the linker script.
extern uint32_t start_stack_top;

/// The first 16 entries of a vector table; the last is of SysTick. Those that are not named are faults.
#define SYSTEM_VECTOR_TABLE(systick)                                                                                   \
    (vector_t)(uintptr_t) & start_stack_top, start_reset, start_fault, start_fault, start_fault, start_fault,          \
        start_fault, 0, 0, 0, 0, start_fault, start_fault, 0, start_fault, systick

#endif

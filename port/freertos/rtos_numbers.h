/* SPDX-License-Identifier: MIT */
/// @file
/// What the image counts about itself, in memory, where a debugger or tools/rtos_demo.sh reads it.
#ifndef JCAL_FREERTOS_RTOS_NUMBERS_H
#define JCAL_FREERTOS_RTOS_NUMBERS_H

#include <stdint.h>

/// Bytes and counts; the script reads them in this order.
typedef struct {
    uint32_t hub_stack,
        hub_stack_free;  ///< Of the hub's task, and what of it was never used; renewed every 1024 beats.
    uint32_t beat_stack, beat_stack_free;  ///< Of the task of high priority.
    uint32_t beats, wrong_beats;           ///< How often that one ran, and found an FPU register changed.
    uint32_t sleeps;                       ///< How often the idle task slept.
} rtos_numbers_t;

extern volatile rtos_numbers_t rtos_numbers;

#endif

/* SPDX-License-Identifier: MIT */
/// @file
/// What FreeRTOS is to be for the hub: three tasks, no heap, checks on. The meaning of each line is in the kernel's documentation.
#ifndef FREERTOS_CONFIG_H
#define FREERTOS_CONFIG_H

#include <stdint.h>

/* CONFIG_CLOCK_HZ comes from the build: it belongs to the board. */
#define configCPU_CLOCK_HZ ((uint32_t)CONFIG_CLOCK_HZ)
#define configTICK_RATE_HZ 1000u
#define configTICK_TYPE_WIDTH_IN_BITS TICK_TYPE_WIDTH_32_BITS
#define configUSE_PREEMPTION 1
#define configUSE_TIME_SLICING 0
#define configMAX_PRIORITIES 4
#define configMAX_TASK_NAME_LEN 8
#define configUSE_PORT_OPTIMISED_TASK_SELECTION 1

#define configSUPPORT_STATIC_ALLOCATION 1
#define configSUPPORT_DYNAMIC_ALLOCATION 0
#define configKERNEL_PROVIDED_STATIC_MEMORY 0
/* In words; the idle task only sleeps. */
#define configMINIMAL_STACK_SIZE 96u

#define configUSE_IDLE_HOOK 1
#define configUSE_TICK_HOOK 0
#define configUSE_TASK_NOTIFICATIONS 1
#define configUSE_TIMERS 0
#define configUSE_MUTEXES 0
#define configUSE_CO_ROUTINES 0
#define configUSE_TRACE_FACILITY 0

/* Method 2: a pattern at the end of the stack, looked at whenever a task is left. */
#define configCHECK_FOR_STACK_OVERFLOW 2
#define configCHECK_HANDLER_INSTALLATION 1

#define INCLUDE_vTaskDelay 1
#define INCLUDE_vTaskSuspend 1
#define INCLUDE_xTaskDelayUntil 1
#define INCLUDE_uxTaskGetStackHighWaterMark 1

/* The upper bits are what a processor has: three with every vendor. Kernel lowest, interrupts that call it from 0x40 down in urgency. */
#define configKERNEL_INTERRUPT_PRIORITY 0xE0
#define configMAX_SYSCALL_INTERRUPT_PRIORITY 0x40

void rtos_failed(void);
#define configASSERT(condition)                                                                                        \
    do {                                                                                                               \
        if (!(condition)) {                                                                                            \
            rtos_failed();                                                                                             \
        }                                                                                                              \
    } while (0)

#endif

/* SPDX-License-Identifier: MIT */
/* The hub under FreeRTOS: receives in the UART's interrupt, works and sends in a task of low priority that a notification wakes.
 *
 * The board's own files (port/boards) are used as they are. Their interrupts are called through a table in RAM, which puts the kernel's
 * three handlers in, and a wake-up of the task behind each interrupt of the board. */
#include "FreeRTOS.h"
#include "board.h"
#include "cortex_m.h"
#include "flash.h"
#include "hub.h"
#include "rtos_numbers.h"
#include "send.h"
#include "task.h"

/* A table must lie at a multiple of its size, rounded up to a power of two [DDI0403, B3.2.5]. */
#define TABLE_ENTRIES (SYSTEM_VECTORS + BOARD_INTERRUPTS)
#define TABLE_ALIGNMENT 512
#define ENTRY_SVC 11u
#define ENTRY_PENDSV 14u
#define ENTRY_SYSTICK 15u
/* Priorities of interrupts, a byte each. */
#define NVIC_PRIORITY(n) (*(volatile uint8_t *)(uintptr_t)(0xE000E400u + (n)))
/* Less urgent than configMAX_SYSCALL_INTERRUPT_PRIORITY, so that it may call the kernel. */
#define BOARD_PRIORITY 0x80u

#define HUB_PRIORITY 1u
#define BEAT_PRIORITY 3u
/* Words. README.md says what of it is used. */
#define HUB_STACK 2048u
#define BEAT_STACK 160u

typedef char table_fits_its_alignment[(TABLE_ENTRIES * sizeof(vector_t) <= TABLE_ALIGNMENT) ? 1 : -1];

/* Of the kernel's port for the Cortex-M4F. */
void vPortSVCHandler(void);
void xPortPendSVHandler(void);
void xPortSysTickHandler(void);

extern const vector_t board_vectors[TABLE_ENTRIES];
static vector_t vectors[TABLE_ENTRIES] __attribute__((aligned(TABLE_ALIGNMENT)));

static hub_t hub;
static StaticTask_t hub_memory, beat_memory, idle_memory;
static StackType_t hub_stack[HUB_STACK], beat_stack[BEAT_STACK], idle_stack[configMINIMAL_STACK_SIZE];
static TaskHandle_t hub_task;
static volatile bool waits_for_sending;

volatile rtos_numbers_t rtos_numbers;

/* --- Interrupts ------------------------------------------------------------------------------------------------------ */

/* The kernel's tick is the hub's clock: the board's own would want the same timer. */
void board_received(uint8_t byte)
{
    hub_time(&hub, (uint64_t)xTaskGetTickCountFromISR() * (1000000u / configTICK_RATE_HZ));
    hub_receive(&hub, byte);
}

/* Any interrupt of the board: does what the board's table says, and wakes the hub's task if there is something for it. */
static void board_interrupt(void)
{
    uint32_t entry = 0;
    __asm volatile("mrs %0, ipsr" : "=r"(entry));
    board_vectors[entry]();
    if (hub_waiting(&hub) || waits_for_sending) {
        BaseType_t switches = pdFALSE;
        vTaskNotifyGiveFromISR(hub_task, &switches);
        portYIELD_FROM_ISR(switches);
    }
}

static void install_vectors(void)
{
    for (uint32_t i = 0; i < TABLE_ENTRIES; i++) {
        const bool is_of_board = (i >= SYSTEM_VECTORS) && (board_vectors[i] != start_fault);
        vectors[i] = is_of_board ? board_interrupt : board_vectors[i];
    }
    vectors[ENTRY_SVC] = vPortSVCHandler;
    vectors[ENTRY_PENDSV] = xPortPendSVHandler;
    vectors[ENTRY_SYSTICK] = xPortSysTickHandler;
    for (uint32_t i = 0; i < BOARD_INTERRUPTS; i++) {
        NVIC_PRIORITY(i) = (uint8_t)BOARD_PRIORITY;
    }
    VTOR = (uint32_t)(uintptr_t)vectors;
    __asm volatile("dsb\n isb" ::: "memory");
}

/* --- Tasks ----------------------------------------------------------------------------------------------------------- */

/* Until an interrupt has something for us. One that comes between the look and the sleep leaves its notification, which ends the sleep. */
static void sleep_if_idle(void)
{
    const bool to_send = hub_send_count(&hub) > 0;
    waits_for_sending = to_send;
    if (to_send) {
        board_wake_when_sent();
    }
    if (!(to_send && board_can_send())) {
        (void)ulTaskNotifyTake(pdTRUE, portMAX_DELAY);
    }
    waits_for_sending = false;
}

static void hub_run(void *unused)
{
    (void)unused;
    for (;;) {
        const bool worked = hub_work(&hub);
        send_what_fits(&hub);
        if (!worked) {
            sleep_if_idle();
        }
    }
}

/* Stands for the rest of a firmware: comes every millisecond, between any two instructions of the hub's task, and computes with the FPU.
 * The recurrence is Archimedes' for pi; it ends at the same bits each time, or a register was lost. */
static float archimedes(void)
{
    float chord_squared = 1.0f; /* hexagon in the unit circle */
    float sides = 6.0f;
    for (int i = 0; i < 5; i++) {
        const float apothem = __builtin_sqrtf(1.0f - (0.25f * chord_squared));
        chord_squared = chord_squared / (2.0f + (2.0f * apothem));
        sides *= 2.0f;
    }
    return 0.5f * sides * __builtin_sqrtf(chord_squared);
}

static void beat_run(void *unused)
{
    (void)unused;
    const float first = archimedes();
    TickType_t last = xTaskGetTickCount();
    for (;;) {
        (void)xTaskDelayUntil(&last, 1u);
        rtos_numbers.beats++;
        if (archimedes() != first) {
            rtos_numbers.wrong_beats++;
        }
        if (rtos_numbers.beats % 1024u == 0u) {
            rtos_numbers.hub_stack_free = (uint32_t)uxTaskGetStackHighWaterMark(hub_task) * sizeof(StackType_t);
            rtos_numbers.beat_stack_free = (uint32_t)uxTaskGetStackHighWaterMark(0) * sizeof(StackType_t);
        }
    }
}

/* --- What the kernel calls ------------------------------------------------------------------------------------------- */

void vApplicationIdleHook(void);
void vApplicationIdleHook(void)
{
    rtos_numbers.sleeps++;
    __asm volatile("dsb\n wfi" ::: "memory");
}

void vApplicationGetIdleTaskMemory(StaticTask_t **task, StackType_t **stack, configSTACK_DEPTH_TYPE *words)
{
    *task = &idle_memory;
    *stack = idle_stack;
    *words = configMINIMAL_STACK_SIZE;
}

void vApplicationStackOverflowHook(TaskHandle_t task, char *name)
{
    (void)task;
    (void)name;
    rtos_failed();
}

void rtos_failed(void)
{
    start_fault();
}

int main(void)
{
    const jcal_flash_t flash = board_flash();
    hub_init(&hub);
    hub_set_flash(&hub, &flash, board_flash_is_deaf());
    rtos_numbers.hub_stack = sizeof hub_stack;
    rtos_numbers.beat_stack = sizeof beat_stack;
    hub_task = xTaskCreateStatic(hub_run, "hub", HUB_STACK, 0, HUB_PRIORITY, hub_stack, &hub_memory);
    (void)xTaskCreateStatic(beat_run, "beat", BEAT_STACK, 0, BEAT_PRIORITY, beat_stack, &beat_memory);
    /* The kernel has masked interrupts that may call it; it opens them when its first task runs. */
    install_vectors();
    board_init();
    vTaskStartScheduler();
    return 0; /* never: nothing ends the scheduler */
}

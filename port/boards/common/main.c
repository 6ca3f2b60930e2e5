/* SPDX-License-Identifier: MIT */
/* The hub on a board: receives in the UART's interrupt, works and sends in the main loop, sleeps in between. */
#include "board.h"
#include "flash.h"
#include "hub.h"
#include "send.h"

static hub_t hub;

void board_received(uint8_t byte)
{
    hub_time(&hub, board_now_us());
    hub_receive(&hub, byte);
}

static void tell_time(void)
{
    __asm volatile("cpsid i" ::: "memory");
    hub_time(&hub, board_now_us());
    __asm volatile("cpsie i" ::: "memory");
}

/* With interrupts masked, so that a byte that comes after the look still ends the sleep: a pending interrupt ends wfi even
 * while it is masked. */
static void sleep_if_idle(void)
{
    const bool to_send = hub_send_count(&hub) > 0;
    if (to_send) {
        board_wake_when_sent();
    }
    __asm volatile("cpsid i" ::: "memory");
    if (!hub_waiting(&hub) || to_send) {
        if (!(to_send && board_can_send())) {
            __asm volatile("dsb\n wfi" ::: "memory");
        }
    }
    __asm volatile("cpsie i" ::: "memory");
}

int main(void)
{
    const jcal_flash_t flash = board_flash();
    hub_init(&hub);
    hub_set_flash(&hub, &flash, board_flash_is_deaf());
    board_init();
    for (;;) {
        tell_time();
        const bool worked = hub_work(&hub);
        send_what_fits(&hub);
        if (!worked) {
            sleep_if_idle();
        }
    }
}

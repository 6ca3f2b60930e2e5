/* SPDX-License-Identifier: MIT */
/* The hub under Zephyr: receives in the UART's interrupt, works and sends in the main thread, which a semaphore wakes. */
#include "hub.h"

#include <zephyr/device.h>
#include <zephyr/drivers/uart.h>
#include <zephyr/kernel.h>

static const struct device *const uart = DEVICE_DT_GET(DT_CHOSEN(zephyr_console));
static hub_t hub;
K_SEM_DEFINE(work_waits, 0, 1);

static void received(const struct device *device, void *unused)
{
    uint8_t byte = 0;
    (void)unused;
    if (!uart_irq_update(device) || !uart_irq_rx_ready(device)) {
        return;
    }
    while (uart_fifo_read(device, &byte, 1) == 1) {
        hub_receive(&hub, byte);
    }
    if (hub_waiting(&hub)) {
        k_sem_give(&work_waits);
    }
}

/* Waits for each byte to go out: at most the time of a byte, in the thread that has nothing above idle to hold up. */
static void send_all(void)
{
    uint8_t byte = 0;
    while (hub_send(&hub, &byte)) {
        uart_poll_out(uart, byte);
    }
}

int main(void)
{
    hub_init(&hub);
    if (!device_is_ready(uart) || uart_irq_callback_user_data_set(uart, received, NULL) != 0) {
        return 1;
    }
    uart_irq_rx_enable(uart);
    for (;;) {
        const bool worked = hub_work(&hub);
        send_all();
        if (!worked && !hub_waiting(&hub)) {
            /* What came after the look has given the semaphore. */
            (void)k_sem_take(&work_waits, K_FOREVER);
        }
    }
    return 0;
}
